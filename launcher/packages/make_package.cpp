#include "launcher/packages/make_package.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <utility>

#include "common/configuration/regular_file.h"
#include "common/configuration/wording.h"
#include "common/program/usage_error.h"
#include "common/run/access/digest.h"
#include "common/version/version.h"
#include "launcher/archive/tar_file.h"
#include "launcher/packages/installed_packages.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

// Collects the files of a user directory by their names in the package.
class PackedFiles
{
public:
  explicit PackedFiles(fs::path directory) : directory_(std::move(directory)) {}

  std::map<std::string, std::string> Take()
  {
    for (const std::string_view folder : kPackageFolders)
      if (fs::exists(fs::symlink_status(directory_ / folder))) Add(directory_ / folder);
    for (const std::string_view text : kPackageTexts)
      if (fs::exists(fs::symlink_status(directory_ / text))) Add(directory_ / text);
    return std::move(contents_);
  }

private:
  [[noreturn]] void Refuse(const fs::path& path, const std::string& why) const
  {
    throw UsageError(fmt::format("{}: {}", Quoted(path.lexically_relative(directory_).string()), why));
  }

  void Add(const fs::path& path)
  {
    if (IsLeftOut(path.filename())) return;
    const fs::file_status status = fs::symlink_status(path);
    if (fs::is_directory(status))
    {
      for (const fs::directory_entry& entry : fs::directory_iterator(path)) Add(entry.path());
      return;
    }
    if (fs::is_symlink(status)) Refuse(path, "it is a link; put the file itself there");
    AddFile(path);
  }

  void AddFile(const fs::path& path)
  {
    const std::string name = path.lexically_relative(directory_).generic_string();
    if (const std::string mistake = PackageFileMistake(name); !mistake.empty()) Refuse(path, mistake);
    std::string bytes;
    try
    {
      bytes = ReadRegularFile(path, kMostPackageBytes);
    }
    catch (const FileError& error)
    {
      Refuse(path, error.what());
    }
    if (IsProgramCode(bytes)) Refuse(path, "it is program code; a package has sources only. Take it out");
    bytes_ += bytes.size();
    if (bytes_ > kMostPackageBytes || contents_.size() >= kMostPackageFiles)
      Refuse(path, fmt::format("with it the package has more than {} bytes or {} files", kMostPackageBytes,
                               kMostPackageFiles));
    contents_[name] = std::move(bytes);
  }

  fs::path directory_;
  std::map<std::string, std::string> contents_;
  std::uint64_t bytes_ = 0;
};

std::string DigestOf(const std::string& bytes)
{
  Sha256 digest;
  digest.Add(bytes);
  return digest.Text();
}

// Returns the manifest of a request, without files.
PackageManifest ManifestFor(const PackRequest& request, const fs::path& directory)
{
  PackageManifest manifest;
  if (fs::exists(fs::symlink_status(directory / kPackageManifest))) manifest = ReadPackageManifest(directory);
  const auto choose = [](std::string& value, const std::string& asked, const char* option, auto mistake_of)
  {
    if (!asked.empty()) value = asked;
    if (value.empty())
      throw UsageError(
          fmt::format("{}: the package needs it; {} keeps it for the next time", option, kPackageManifest));
    if (const std::string mistake = mistake_of(value); !mistake.empty())
      throw UsageError(fmt::format("{}: {}: {}", option, Quoted(value), mistake));
  };
  if (manifest.name.empty()) manifest.name = directory.filename();
  choose(manifest.name, request.name, "--name", PackageNameMistake);
  choose(manifest.release, request.release, "--release", PackageReleaseMistake);
  choose(manifest.author, request.author, "--author", PackageTextMistake);
  choose(manifest.licence, request.licence, "--licence", PackageTextMistake);
  if (!request.summary.empty()) choose(manifest.summary, request.summary, "--summary", PackageTextMistake);
  manifest.swarmanoid = Version();
  manifest.files.clear();
  return manifest;
}

}  // namespace

MadePackage MakePackage(const PackRequest& request)
{
  const fs::path directory = fs::absolute(request.directory).lexically_normal() / "";
  if (!fs::is_directory(directory)) throw UsageError(fmt::format("there is no folder {}", Quoted(request.directory)));
  const fs::path home = directory.parent_path();
  PackageManifest manifest = ManifestFor(request, home);
  const std::map<std::string, std::string> contents = PackedFiles(home).Take();
  for (const auto& [name, bytes] : contents) manifest.files.push_back({name, bytes.size(), DigestOf(bytes)});
  if (manifest.Content().empty())
    throw UsageError(
        fmt::format("{} has no controller, experiment or anything else to share; make a user directory by: "
                    "swarmanoid new user NAME",
                    Quoted(request.directory)));

  const std::string path =
      request.output.empty() ? fmt::format("{}-{}.tar.gz", manifest.name, manifest.release) : request.output;
  const std::string text = manifest.Text();
  TarWriter tar("--output", path);
  const auto write = [&](const std::string& name, const std::string& bytes)
  {
    tar.Begin(manifest.name + "/" + name, bytes.size());
    tar.Write(bytes);
    tar.End();
  };
  write(kPackageManifest, text);
  for (const auto& [name, bytes] : contents) write(name, bytes);
  WritePackageManifest(home, manifest);
  return {path, tar.Close(), std::move(manifest)};
}

}  // namespace swarmanoid
