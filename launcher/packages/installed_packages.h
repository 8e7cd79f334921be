// The packages in a folder, each in a folder of its own. Used by `swarmanoid list packages` and `install`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "launcher/packages/package_manifest.h"

namespace swarmanoid
{

// Reads and writes package.json of a folder. Throw PackageError with its path.
PackageManifest ReadPackageManifest(const std::filesystem::path& folder);
void WritePackageManifest(const std::filesystem::path& folder, const PackageManifest& manifest);

// Returns the files of a package that differ from its manifest: changed ones and missing ones.
std::vector<std::string> ChangedFiles(const std::filesystem::path& folder, const PackageManifest& manifest);
// Returns the files in the folders of a package that its manifest does not list. Hidden ones do not count.
std::vector<std::string> AddedFiles(const std::filesystem::path& folder, const PackageManifest& manifest);
// Returns whether packages leave a file or folder of that name out: hidden ones and caches of Python.
bool IsLeftOut(const std::string& name);

struct PackageInFolder
{
  std::string folder;        // absolute
  PackageManifest manifest;  // empty if there is a mistake
  std::string mistake;       // its package.json cannot be read
  std::vector<std::string> changed;
  std::vector<std::string> added;
  bool is_built = false;  // for the simulator
};

// Returns the packages in a folder, ascending by the names of their folders.
std::vector<PackageInFolder> PackagesIn(const std::filesystem::path& folder);

// Returns where packages are installed: beside the user directory around the working folder; outside of one, the
// working folder.
std::filesystem::path FolderOfPackages();

}  // namespace swarmanoid
