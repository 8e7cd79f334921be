// The builds of what computes the state of a run: Swarmanoid itself and the libraries of kinds of entities,
// controllers, devices, engines and experiment functions. Checkpoints keep them, since the state that one build saved
// means nothing sure to another.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

struct LibraryBuild
{
  std::string name;   // the name of the file without folder, or kSwarmanoidBuild
  std::string build;  // as BuildOfLibrary says; empty: the file is not on the machine that looked
};
inline constexpr const char* kSwarmanoidBuild = "Swarmanoid";

// Calls `take` with each library that an experiment names and the file that would be loaded, empty if there is none;
// `computes` is false for those of visualisations, on which no state depends.
void ForEachLibrary(const Experiment& experiment,
                    const std::function<void(const std::string& name, const std::string& file, bool computes)>& take);

// Of Swarmanoid's own libraries, as this process first found them.
const std::string& OwnBuild();

// In the order of their names, each once. They are looked for where they would be loaded from, and not loaded. Taken
// when a run starts: a file may be built anew while the run goes on with the old one.
std::vector<LibraryBuild> LibraryBuildsOf(const Experiment& experiment);

// Whose build differs: "Swarmanoid", "the library 'libx.so'"; empty if none does. Libraries that are unknown on
// either side differ in nothing.
std::string DifferenceOfBuilds(const std::vector<LibraryBuild>& saved, const std::vector<LibraryBuild>& here);

}  // namespace swarmanoid
