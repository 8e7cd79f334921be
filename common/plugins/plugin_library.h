// Loads the libraries of controllers and other plug-ins. A library registers its content while it is loaded, and stays
// loaded until the process ends. Called before roles start, from one thread.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/plugins/catalogue.h"

namespace swarmanoid
{

struct PluginLibrary
{
  std::string path;   // the file; empty if none was found
  std::string error;  // empty: it is loaded. Otherwise the reason, with the searched paths
  PluginCatalogue::Registrations registrations;
};

// Finds and loads a library. `name` is searched as lib<name>.so, <name>.so or, if it ends in .so, unchanged, in each
// folder and its .libs. A name with a '/' is a path. Loading a library again returns the first result. The result stays
// valid until the program ends. It refers to none of the arguments; they are views, so that no compiler warns of that.
const PluginLibrary& LoadPluginLibrary(std::string_view name, std::span<const std::string> folders);

// Sets a function that is called with the path of each library before it is loaded. It returns why the library must not
// be loaded, or an empty text. An experiment from another user must not make this user run its code.
void SetLibraryCheck(std::function<std::string(const std::string& path)> check);

// Returns the file that LoadPluginLibrary would load, without links; empty if it does not exist.
std::string FindPluginLibrary(std::string_view name, std::span<const std::string> folders);

// Returns the folders of a list separated by colons. Backslashes at the ends of lines and blanks around the entries are
// dropped. Relative folders start at `base`.
std::vector<std::string> SplitSearchPath(const std::string& list, const std::string& base);

// Returns the folders that are searched after those of the experiment. First come those of the environment variable
// SWARMANOID_PLUGIN_PATH. The folder of our own libraries follows, with its subfolders swarmanoid and
// swarmanoid/controllers.
std::vector<std::string> StandardPluginFolders();

// Returns the folder of our own libraries, such as libswarmanoid_space.so.
std::string OwnLibraryFolder();

}  // namespace swarmanoid
