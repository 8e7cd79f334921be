// The code and files, beside the experiment file, that determine the state of a run. They are the builds of Swarmanoid
// and of the libraries of kinds, controllers, devices, engines and experiment functions. They are also the contents of
// the files that these read: terrains, pictures of the floor, scripts. Checkpoints store them, since the state that one
// build saved may mean something else to another.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

struct LibraryBuild
{
  // The name of a library without folder, kSwarmanoidBuild, or a file as the experiment names it.
  std::string name;
  // The build as BuildOfLibrary returns it, or the hash of a file; empty: it does not exist on the machine that
  // computed it.
  std::string build;
};
inline constexpr const char* kSwarmanoidBuild = "Swarmanoid";

// Calls `take` with each library that an experiment names and the file that would be loaded, which is empty if none
// exists. `computes` is false for libraries of visualisations, which do not affect the state.
void ForEachLibrary(const Experiment& experiment,
                    const std::function<void(const std::string& name, const std::string& file, bool computes)>& take);

// Returns the builds of Swarmanoid's own libraries, as this process first found them.
const std::string& OwnBuild();

// Returns the builds ordered by name, each once. The libraries are searched where they would be loaded from, and not
// loaded. Call it when a run starts, since a file may be built again while the run uses the old one.
std::vector<LibraryBuild> LibraryBuildsOf(const Experiment& experiment);

// Returns the name for messages: "Swarmanoid", "the library 'libx.so'", "the file 'hills.png'".
std::string NameInText(const LibraryBuild& build);

// Returns the difference, such as "another build of the library 'libx.so'" or "another content of the file
// 'hills.png'"; empty if there is no difference. A build that is unknown on either side counts as equal.
std::string DifferenceOfBuilds(const std::vector<LibraryBuild>& saved, const std::vector<LibraryBuild>& here);

}  // namespace swarmanoid
