// What computes the state of a run beside its experiment file: the builds of Swarmanoid itself and of the libraries of
// kinds of entities, controllers, devices, engines and experiment functions, and the content of the files that they
// read: terrains, pictures of the floor, scripts. Checkpoints keep it, since the state that one build saved means
// nothing sure to another.
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
  // As BuildOfLibrary says, or the hash of a file; empty: it is not on the machine that looked.
  std::string build;
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

// What it is in messages: "Swarmanoid", "the library 'libx.so'", "the file 'hills.png'".
std::string NameInText(const LibraryBuild& build);

// What differs: "another build of the library 'libx.so'", "another content of the file 'hills.png'"; empty if nothing
// does. What is unknown on either side differs in nothing.
std::string DifferenceOfBuilds(const std::vector<LibraryBuild>& saved, const std::vector<LibraryBuild>& here);

}  // namespace swarmanoid
