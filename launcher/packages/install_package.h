// Installs packages of other users. Used by `swarmanoid install`.
#pragma once

#include <string>

#include "launcher/packages/package_manifest.h"

namespace swarmanoid
{

struct InstallRequest
{
  std::string package;  // a file, a folder, or a name that is looked for in the folders of SWARMANOID_PACKAGES
  std::string into;     // the folder that gets the folder of the package; empty: FolderOfPackages()
  bool replace = false;
  std::string build_files = {};  // the folder that has them; empty: that of this installation
};

struct InstalledPackage
{
  std::string folder;
  PackageManifest manifest;
  std::string source;  // the file or folder
};

// Installs a package as a user directory of its name. Nothing of the package is believed: names, sizes and digests of
// all files are checked before the directory appears. With `replace`, a package of that name is replaced if its files
// are unchanged. Throws UsageError with the cure for a mistake of the user, PackageError for one of the package.
InstalledPackage InstallPackage(const InstallRequest& request);

}  // namespace swarmanoid
