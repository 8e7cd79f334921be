// Makes a kind of robot from a URDF file (http://wiki.ros.org/urdf/XML has the format). Body, mass, two driven wheels
// and mesh become a row of the table of entity kinds. The reader of experiments uses it in every process.
//
//   <entity_kinds><rover urdf="rover.urdf"/></entity_kinds>
#pragma once

#include <string>
#include <vector>

#include "common/configuration/configuration_tree.h"
#include "common/experiment/entity_kind.h"
#include "common/experiment/load_experiment.h"

namespace swarmanoid
{

struct UrdfKind
{
  std::string file;
  std::string text;
  EntityKindDescription kind;
  std::vector<std::string> collision_meshes;
  std::vector<Diagnostic> errors;  // why the kind could not be made
  std::vector<Diagnostic> notes;   // content of the file without effect, and assumptions about missing content
};

// Makes a row from the text of a file; registers nothing.
UrdfKind KindFromUrdf(const std::string& tag, const std::string& text, const std::string& file);

// Reads a file and adds its kind to the table, once a process. A tag stands for one text. The mistakes are returned.
std::vector<Diagnostic> RegisterUrdfKind(const std::string& tag, const std::string& file);
// Returns a registered kind; nullptr for kinds of libraries.
const UrdfKind* FindUrdfKind(const std::string& tag);

}  // namespace swarmanoid
