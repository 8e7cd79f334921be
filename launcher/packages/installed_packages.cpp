#include "launcher/packages/installed_packages.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>
#include <utility>

#include "common/configuration/output_file.h"
#include "common/configuration/regular_file.h"
#include "common/configuration/wording.h"
#include "common/run/access/digest.h"
#include "launcher/templates/new_files.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr std::uint64_t kMostManifestBytes = std::uint64_t{16} << 20U;

bool IsPlainFile(const fs::path& path)
{
  std::error_code none;
  return fs::is_regular_file(fs::symlink_status(path, none));
}

}  // namespace

PackageManifest ReadPackageManifest(const fs::path& folder)
{
  const std::string path = folder / kPackageManifest;
  try
  {
    return PackageManifest::Parse(ReadRegularFile(path, kMostManifestBytes));
  }
  catch (const std::runtime_error& error)
  {
    throw PackageError(fmt::format("{} cannot be used: {}", Quoted(path), error.what()));
  }
}

void WritePackageManifest(const fs::path& folder, const PackageManifest& manifest)
{
  const std::string path = folder / kPackageManifest;
  std::FILE* file = OpenOutputFile(path);
  const std::string text = manifest.Text();
  const bool is_written = file != nullptr && std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const int error = errno;
  if (file != nullptr && std::fclose(file) == 0 && is_written) return;
  throw PackageError(fmt::format("{} cannot be written: {}", Quoted(path), std::strerror(is_written ? errno : error)));
}

std::vector<std::string> ChangedFiles(const fs::path& folder, const PackageManifest& manifest)
{
  std::vector<std::string> changed;
  for (const ArchiveMember& file : manifest.files)
    if (!IsPlainFile(folder / file.name) || DigestOfFile(folder / file.name) != file.digest)
      changed.push_back(file.name);
  return changed;
}

bool IsLeftOut(const std::string& name)
{
  return name.starts_with(".") || name == "__pycache__" || name.ends_with(".pyc");
}

std::vector<std::string> AddedFiles(const fs::path& folder, const PackageManifest& manifest)
{
  std::set<std::string> listed;
  for (const ArchiveMember& file : manifest.files) listed.insert(file.name);
  std::vector<std::string> added;
  std::error_code none;
  for (const std::string_view part : kPackageFolders)
    for (fs::recursive_directory_iterator at(folder / part, none), end; at != end; at.increment(none))
    {
      const bool is_left_out = IsLeftOut(at->path().filename());
      const bool is_folder = fs::is_directory(at->symlink_status(none));
      if (is_left_out && is_folder) at.disable_recursion_pending();
      if (is_left_out || is_folder) continue;
      std::string name = at->path().lexically_relative(folder).generic_string();
      if (!listed.contains(name)) added.push_back(std::move(name));
    }
  std::ranges::sort(added);
  return added;
}

std::vector<PackageInFolder> PackagesIn(const fs::path& folder)
{
  std::vector<PackageInFolder> packages;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
  {
    if (entry.path().filename().string().starts_with(".") || !IsPlainFile(entry.path() / kPackageManifest)) continue;
    PackageInFolder package;
    package.folder = fs::absolute(entry.path()).lexically_normal();
    try
    {
      package.manifest = ReadPackageManifest(entry.path());
      package.changed = ChangedFiles(entry.path(), package.manifest);
      package.added = AddedFiles(entry.path(), package.manifest);
    }
    catch (const PackageError& error)
    {
      package.mistake = error.what();
    }
    package.is_built = fs::is_directory(entry.path() / "simulation_build", none);
    packages.push_back(std::move(package));
  }
  std::ranges::sort(packages, {}, &PackageInFolder::folder);
  return packages;
}

fs::path FolderOfPackages()
{
  const fs::path own = UserDirectoryHere();
  return own.empty() ? fs::current_path() : own.parent_path();
}

}  // namespace swarmanoid
