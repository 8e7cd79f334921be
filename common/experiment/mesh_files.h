// Finds the mesh files with which entities and kinds are drawn. Only visualisers read their content, since a mesh is
// only seen.
#pragma once

#include <string>
#include <vector>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

// Returns why a file cannot be a readable mesh, by its name and extension; empty if it can.
std::string MeshFileMistake(const std::string& path);

// Returns the file that a URDF file names. "arm.stl" and "meshes/arm.stl" start at its folder. "file:///…" is absolute.
// "package://NAME/…" starts at the folder NAME that holds the URDF file or is beside one of its parent folders. The
// path is empty if the file does not exist.
std::string FindUrdfMesh(const std::string& name, const std::string& urdf_file);

// Returns the file that a row of the table of kinds names, from the folder of the experiment or one of its plugin_path.
// If it is in none, the path in the experiment's folder is returned.
std::string FindMeshOfKind(const std::string& name, const Experiment& experiment);

// Returns the attribute "mesh" of an entity, from the folder of the experiment; empty if it has none.
std::string MeshOfEntity(const EntityConfiguration& entity, const std::string& experiment_folder);

}  // namespace swarmanoid
