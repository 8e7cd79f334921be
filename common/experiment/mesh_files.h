// Where the mesh files of users are, which entities and kinds are drawn as. The visualisers read what is in them;
// nobody else does: a mesh is only seen.
#pragma once

#include <string>
#include <vector>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

// Why it cannot be a mesh that is read, by its name and its kind of file; empty if it can.
std::string MeshFileMistake(const std::string& path);

// The file that a URDF file names: "arm.stl" and "meshes/arm.stl" from its folder, "file:///…", and "package://NAME/…"
// in the folder NAME that holds the URDF file or stands beside one of the folders that do. Empty if it is not there.
std::string FindUrdfMesh(const std::string& name, const std::string& urdf_file);

// The file that a row of the table of kinds names: from the folder of the experiment, or one of its plugin_path; the
// former if it is in none.
std::string FindMeshOfKind(const std::string& name, const Experiment& experiment);

// The attribute "mesh" of an entity, from the folder of the experiment; empty if it has none.
std::string MeshOfEntity(const EntityConfiguration& entity, const std::string& experiment_folder);

}  // namespace swarmanoid
