#include "launcher/packages/package_manifest.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "common/configuration/shown_text.h"
#include "common/configuration/wording.h"

namespace swarmanoid
{
namespace
{

using Json = nlohmann::ordered_json;

constexpr const char* kPackageFormat = "swarmanoid package";
constexpr std::size_t kLongestPackageName = 40;
constexpr std::size_t kLongestPackageText = 200;

bool IsSmallLetter(char c) { return c >= 'a' && c <= 'z'; }
bool IsLetter(char c) { return IsSmallLetter(c) || (c >= 'A' && c <= 'Z'); }
bool IsDigit(char c) { return c >= '0' && c <= '9'; }

// Throws std::runtime_error with a mistake in a part of a manifest.
void Require(const char* what, const std::string& value, const std::string& mistake)
{
  if (!mistake.empty())
    throw std::runtime_error(fmt::format("its {} {} is not allowed: {}", what, Quoted(value), mistake));
}

}  // namespace

std::string PackageNameMistake(const std::string& name)
{
  const bool good = !name.empty() && name.size() <= kLongestPackageName && IsSmallLetter(name.front()) &&
                    std::ranges::all_of(name, [](char c) { return IsSmallLetter(c) || IsDigit(c) || c == '_'; });
  return good ? std::string()
              : fmt::format("use up to {} small letters, digits and '_', starting with a letter", kLongestPackageName);
}

std::string PackageReleaseMistake(const std::string& release)
{
  const bool good =
      !release.empty() && release.size() <= kLongestPackageName && IsDigit(release.front()) &&
      std::ranges::all_of(release, [](char c) { return IsLetter(c) || IsDigit(c) || c == '.' || c == '-'; });
  return good ? std::string() : "use letters, digits, '.' and '-', starting with a digit, such as 1.2";
}

std::string PackageTextMistake(const std::string& text)
{
  if (text.size() > kLongestPackageText) return fmt::format("it may have {} bytes", kLongestPackageText);
  return IsShowableLine(text) ? std::string() : "it must be one line of text";
}

std::string PackageFileMistake(const std::string& name)
{
  if (std::string mistake = MemberNameMistake(name); !mistake.empty()) return mistake;
  for (std::size_t begin = 0; begin <= name.size();)
  {
    const std::size_t end = std::min(name.find('/', begin), name.size());
    const std::string_view part = std::string_view(name).substr(begin, end - begin);
    const auto is_allowed = [](char c)
    { return IsLetter(c) || IsDigit(c) || c == '.' || c == '_' || c == '-' || c == '+'; };
    if (!std::ranges::all_of(part, is_allowed) || part.front() == '.' || part.front() == '-')
      return "names in packages have letters, digits and . _ - + only, and start with none of . and -";
    begin = end + 1;
  }
  const std::size_t slash = name.find('/');
  const bool is_text = slash == std::string::npos && std::ranges::find(kPackageTexts, name) != kPackageTexts.end();
  const bool is_in_folder =
      slash != std::string::npos && std::ranges::find(kPackageFolders, name.substr(0, slash)) != kPackageFolders.end();
  if (is_text || is_in_folder) return {};
  std::vector<std::string> folders(kPackageFolders.begin(), kPackageFolders.end());
  std::vector<std::string> texts(kPackageTexts.begin(), kPackageTexts.end());
  return fmt::format("a package has the folders {} and the texts {}", Listed(folders), Listed(texts));
}

std::string PackageManifest::Text() const
{
  Json json;
  json["format"] = kPackageFormat;
  json["version"] = kPackageVersion;
  json["swarmanoid"] = swarmanoid;
  json["name"] = name;
  json["release"] = release;
  json["author"] = author;
  json["licence"] = licence;
  json["summary"] = summary;
  json["files"] = MembersJson(files);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

PackageManifest PackageManifest::Parse(const std::string& text)
{
  try
  {
    const Json json = Json::parse(text);
    CheckFormat(json, kPackageFormat, kPackageVersion, "packages");
    PackageManifest manifest;
    manifest.swarmanoid = json.at("swarmanoid").get<std::string>();
    manifest.name = json.at("name").get<std::string>();
    manifest.release = json.at("release").get<std::string>();
    manifest.author = json.at("author").get<std::string>();
    manifest.licence = json.at("licence").get<std::string>();
    manifest.summary = json.at("summary").get<std::string>();
    Require("name", manifest.name, PackageNameMistake(manifest.name));
    Require("release", manifest.release, PackageReleaseMistake(manifest.release));
    for (const std::string* line : {&manifest.swarmanoid, &manifest.author, &manifest.licence, &manifest.summary})
      Require("text", *line, PackageTextMistake(*line));
    manifest.files = MembersOf(json.at("files"));
    if (manifest.files.size() > kMostPackageFiles)
      throw std::runtime_error(
          fmt::format("it has {} files; a package has at most {}", manifest.files.size(), kMostPackageFiles));
    std::uint64_t bytes = 0;
    for (const ArchiveMember& file : manifest.files)
    {
      Require("file", file.name, PackageFileMistake(file.name));
      bytes += file.bytes;
    }
    if (bytes > kMostPackageBytes)
      throw std::runtime_error(fmt::format("it has {} bytes; a package has at most {}", bytes, kMostPackageBytes));
    return manifest;
  }
  catch (const Json::exception& error)
  {
    throw std::runtime_error(fmt::format("its {} is no manifest of a package: {}", kPackageManifest, error.what()));
  }
}

std::map<std::string, std::set<std::string>> PackageManifest::Content() const
{
  std::map<std::string, std::set<std::string>> content;
  for (const ArchiveMember& file : files)
  {
    const std::size_t slash = file.name.find('/');
    if (slash == std::string::npos) continue;
    const std::string folder = file.name.substr(0, slash);
    const std::size_t next = file.name.find('/', slash + 1);
    const std::string part = file.name.substr(slash + 1, next == std::string::npos ? next : next - slash - 1);
    // Experiments are files; the folders beside them have what they name.
    if ((next == std::string::npos) == (folder == "experiments")) content[folder].insert(part);
  }
  return content;
}

bool PackageManifest::HasSources() const
{
  return std::ranges::any_of(files, [](const ArchiveMember& file) { return file.name.ends_with(".cpp"); });
}

}  // namespace swarmanoid
