// A package is first built up in a hidden folder beside its destination, and checked there. Then it is renamed, so that
// an error or a kill leaves no half of it.
#include "launcher/packages/install_package.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#include "common/configuration/configuration_tree.h"
#include "common/configuration/output_file.h"
#include "common/configuration/regular_file.h"
#include "common/configuration/wording.h"
#include "common/program/usage_error.h"
#include "launcher/archive/tar_file.h"
#include "launcher/packages/installed_packages.h"
#include "launcher/system/installation.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* kSearchVariable = "SWARMANOID_PACKAGES";
constexpr const char* kFileEnding = ".tar.gz";

// A new folder that is removed unless it was kept.
class NewFolder
{
public:
  explicit NewFolder(const fs::path& parent)
  {
    std::string path = parent / ".package_XXXXXX";
    if (mkdtemp(path.data()) == nullptr)
      throw UsageError(fmt::format("cannot make a folder in {}: {}", Quoted(parent.string()), std::strerror(errno)));
    path_ = path;
  }
  ~NewFolder()
  {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  const fs::path& Path() const { return path_; }

private:
  fs::path path_;
};

bool IsPackageFolder(const fs::path& path) { return fs::is_regular_file(fs::symlink_status(path / kPackageManifest)); }

// Returns the files and folders of a package of that name in the folders of SWARMANOID_PACKAGES.
std::vector<std::string> FindByName(const std::string& name)
{
  const char* list = std::getenv(kSearchVariable);
  std::vector<std::string> found;
  for (const std::string& folder : SplitWords(list == nullptr ? "" : list, ":"))
  {
    if (IsPackageFolder(fs::path(folder) / name)) found.push_back(fs::path(folder) / name);
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
    {
      const std::string file = entry.path().filename();
      const bool is_release = file.starts_with(name + "-") && file.ends_with(kFileEnding) &&
                              file.size() > name.size() + 1 + std::strlen(kFileEnding);
      if (file == name + kFileEnding || is_release) found.push_back(entry.path());
    }
  }
  std::ranges::sort(found);
  return found;
}

// A name is not the package that is installed already, of which another release is looked for.
std::string FindPackage(const std::string& package, const fs::path& into)
{
  std::error_code none;
  if (fs::exists(package, none) && !(FindByName(package).size() == 1 && fs::equivalent(package, into / package, none)))
    return package;
  if (!PackageNameMistake(package).empty()) throw UsageError(fmt::format("there is no file {}", Quoted(package)));
  const std::vector<std::string> found = FindByName(package);
  if (found.empty())
    throw UsageError(
        fmt::format("there is no file or folder {}, and no package of that name in the folders of {}, which "
                    "is {}",
                    Quoted(package), kSearchVariable,
                    std::getenv(kSearchVariable) == nullptr ? "not set" : Quoted(std::getenv(kSearchVariable))));
  if (found.size() > 1)
    throw UsageError(
        fmt::format("there are several packages {}: {}; name one of these files", Quoted(package), Listed(found)));
  return found.front();
}

PackageManifest UnpackFile(const std::string& path, const fs::path& folder)
{
  TarReader tar(path);
  std::string top;
  PackageManifest manifest = PackageManifest::Parse(ReadListMember(tar, kPackageManifest, top));
  UnpackMembers(tar, manifest.files, kPackageManifest, top, folder);
  return manifest;
}

// Copies the files of a folder that its manifest lists.
PackageManifest CopyFolder(const fs::path& from, const fs::path& folder)
{
  PackageManifest manifest = ReadPackageManifest(from);
  if (const std::vector<std::string> changed = ChangedFiles(from, manifest); !changed.empty())
    throw std::runtime_error(fmt::format("files differ from its {}: {}; its author makes it again by `swarmanoid pack`",
                                         kPackageManifest, Listed(changed)));
  for (const ArchiveMember& file : manifest.files)
  {
    const std::string bytes = ReadRegularFile(from / file.name, kMostPackageBytes);
    if (IsProgramCode(bytes))
      throw std::runtime_error(fmt::format("'{}' in it is program code, which no package has", file.name));
    fs::create_directories((folder / file.name).parent_path());
    std::ofstream stream(folder / file.name, std::ios::binary);
    if (!(stream << bytes).flush())
      throw std::runtime_error(fmt::format("cannot write '{}': {}", file.name, std::strerror(errno)));
  }
  if (!ChangedFiles(folder, manifest).empty()) throw std::runtime_error("its files changed while they were copied");
  return manifest;
}

// Adds the build files of this installation, as in any user directory.
void AddBuildFiles(const fs::path& folder, const std::string& build_files)
{
  const fs::path from =
      build_files.empty() ? fs::path(UserFilesFolder()) / "templates/user_directory" : fs::path(build_files);
  fs::copy(from, folder, fs::copy_options::recursive);
  for (const char* needed : {"controllers", "experiments"}) fs::create_directories(folder / needed);
  std::ofstream place(folder / ".swarmanoid");
  if (!(place << fs::path(OwnProgram()).parent_path().parent_path().string() << "\n").flush())
    throw std::runtime_error(fmt::format("cannot write '.swarmanoid': {}", std::strerror(errno)));
}

// Throws UsageError unless the folder may get the package.
void CheckDestination(const fs::path& folder, const PackageManifest& manifest, bool replace)
{
  if (!fs::exists(fs::symlink_status(folder))) return;
  const std::string shown = Quoted(folder.string());
  if (!IsPackageFolder(folder))
    throw UsageError(
        fmt::format("{} is there already and is no installed package; move it away, or install --into "
                    "another folder",
                    shown));
  const PackageManifest there = ReadPackageManifest(folder);
  if (!replace)
    throw UsageError(fmt::format("{} {} is installed already in {}; add --replace to put {} in its place", there.name,
                                 there.release, shown, manifest.release));
  std::vector<std::string> changed = ChangedFiles(folder, there);
  for (std::string& added : AddedFiles(folder, there)) changed.push_back(std::move(added));
  if (!changed.empty())
    throw UsageError(
        fmt::format("{} has changed or added files: {}; move the folder away first", shown, Listed(changed)));
}

}  // namespace

InstalledPackage InstallPackage(const InstallRequest& request)
{
  const fs::path into = request.into.empty() ? FolderOfPackages() : fs::absolute(request.into).lexically_normal();
  if (!fs::is_directory(into)) throw UsageError(fmt::format("--into: there is no folder {}", Quoted(into.string())));
  if (const std::string mistake = OutputFolderMistake(into); !mistake.empty())
    throw UsageError(fmt::format("--into: {}: {}", Quoted(into.string()), mistake));

  const std::string source = FindPackage(request.package, into);
  const NewFolder made(into);
  const fs::path unpacked = made.Path() / "new";
  fs::create_directory(unpacked);
  PackageManifest manifest;
  try
  {
    manifest = fs::is_directory(source) ? CopyFolder(source, unpacked) : UnpackFile(source, unpacked);
  }
  catch (const std::runtime_error& error)
  {
    throw PackageError(fmt::format("the package {} cannot be installed: {}", Quoted(source), error.what()));
  }
  const fs::path folder = into / manifest.name;
  CheckDestination(folder, manifest, request.replace);
  AddBuildFiles(unpacked, request.build_files);
  WritePackageManifest(unpacked, manifest);
  // The replaced directory is removed with `made`, once the new one stands.
  const fs::path old = made.Path() / "old";
  const bool replaces = fs::exists(fs::symlink_status(folder));
  if (replaces) fs::rename(folder, old);
  std::error_code error;
  fs::rename(unpacked, folder, error);
  if (error)
  {
    if (replaces) fs::rename(old, folder);
    throw UsageError(fmt::format("--into: cannot make {}: {}", Quoted(folder.string()), error.message()));
  }
  return {folder, std::move(manifest), source};
}

}  // namespace swarmanoid
