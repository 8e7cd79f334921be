// Makes the file of a package from a user directory. Used by `swarmanoid pack`.
#pragma once

#include <string>
#include <vector>

#include "launcher/packages/package_manifest.h"

namespace swarmanoid
{

// An empty text is that of the directory's package.json, if it has one.
struct PackRequest
{
  std::string directory = ".";
  std::string output;  // the new file; empty: NAME-RELEASE.tar.gz in the working folder
  std::string name;    // without a package.json: that of the directory
  std::string release;
  std::string author;
  std::string licence;
  std::string summary;
};

struct MadePackage
{
  std::string path;
  std::string digest;  // SHA-256 of the file
  PackageManifest manifest;
};

// Equal directories and requests give equal bytes. Hidden files and caches of Python are left out. Writes the
// directory's package.json. Throws UsageError with the cure if something in the directory cannot be in a package;
// std::runtime_error if the file cannot be written.
MadePackage MakePackage(const PackRequest& request);

}  // namespace swarmanoid
