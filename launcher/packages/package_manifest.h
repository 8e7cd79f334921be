// A package is what a user shares of a user directory: controllers with their behaviours, kinds, devices, engines,
// functions, renderers and experiments, as sources. Its file is a tar.gz with these members below one folder:
//
//   package.json       the name, release, author and licence, and the list of the other members with their digests
//   controllers/…      as in a user directory, as are devices, engines, entities, experiments, functions and renderers
//   README.md …        texts
//
// An installed package is a user directory of its own, with the build files of the installation.
#pragma once

#include <array>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "launcher/archive/archive_members.h"

namespace swarmanoid
{

// Change the version with each change that a reader of the version before does not understand.
inline constexpr unsigned kPackageVersion = 1;

inline constexpr const char* kPackageManifest = "package.json";
inline constexpr std::array<std::string_view, 7> kPackageFolders{"controllers", "devices",   "engines",  "entities",
                                                                 "experiments", "functions", "renderers"};
inline constexpr std::array<std::string_view, 6> kPackageTexts{"CHANGELOG.md", "CITATION.cff", "LICENSE",
                                                               "LICENSE.md",   "README",       "README.md"};
inline constexpr std::uint64_t kMostPackageBytes = std::uint64_t{256} << 20U;
inline constexpr std::size_t kMostPackageFiles = 10'000;

// what() names the package and the reason.
class PackageError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

// The content of package.json.
struct PackageManifest
{
  std::string name;
  std::string release;  // "1.2"
  std::string author;
  std::string licence;
  std::string summary;               // may be empty
  std::string swarmanoid;            // the version of the program that made it
  std::vector<ArchiveMember> files;  // ascending by name

  std::string Text() const;
  // Throws std::runtime_error with the reason if the text is no manifest, or if something in it is not allowed.
  static PackageManifest Parse(const std::string& text);

  // Returns what is in each folder: "forager" of controllers/forager/forager.cpp, "forage.xml" of
  // experiments/forage.xml.
  std::map<std::string, std::set<std::string>> Content() const;
  // Returns whether something must be compiled.
  bool HasSources() const;
};

// Return why a package must not have the name, the release, another text of one line, or a file of the name; empty if
// it may. Names of files may have letters, digits and . _ - + only, since the build reads them.
std::string PackageNameMistake(const std::string& name);
std::string PackageReleaseMistake(const std::string& release);
std::string PackageTextMistake(const std::string& text);
std::string PackageFileMistake(const std::string& name);

}  // namespace swarmanoid
