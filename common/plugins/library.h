// Loading the libraries of controllers and other plug-ins. A library registers what it holds while it is loaded, and
// stays loaded until the process ends. Called before roles start, from one thread.
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
  std::string path;   // of the file; empty if none was found
  std::string error;  // empty: it is loaded. Otherwise why not, with the paths that were searched
  PluginCatalogue::Registrations registrations;
};

// Finds `name` as lib<name>.so, <name>.so or, if it ends in .so, as it stands, in each folder and its .libs, and
// loads it. A name with a '/' is a path. Loading a library again yields what the first time yielded. The result stays
// until the program ends. It refers to none of the arguments; they are views, so that no compiler warns of that.
const PluginLibrary& LoadPluginLibrary(std::string_view name, std::span<const std::string> folders);

// Called with the path of each library before it is loaded from now on: why it must not be, or an empty text. What an
// experiment names that somebody else sent is not code of this user.
void SetLibraryCheck(std::function<std::string(const std::string& path)> check);

// The file that LoadPluginLibrary would load, without links; empty if there is none.
std::string FindPluginLibrary(std::string_view name, std::span<const std::string> folders);

// The folders of a list separated by colons: backslashes at the ends of lines and blanks around the entries are
// dropped, relative ones start at `base`.
std::vector<std::string> SplitSearchPath(const std::string& list, const std::string& base);

// Searched after those of the experiment: those of the environment variable SWARMANOID_PLUGIN_PATH, then the folder
// of our own libraries with its subfolders swarmanoid and swarmanoid/controllers.
std::vector<std::string> StandardPluginFolders();

// The folder of our own libraries, such as libswarmanoid_space.so.
std::string OwnLibraryFolder();

}  // namespace swarmanoid
