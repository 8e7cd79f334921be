#include "launcher/archive/run_archive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/configuration/wording.h"
#include "common/version/version.h"
#include "launcher/archive/tar_file.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "swarmanoid archive";
constexpr std::uint64_t kMostIndexBytes = std::uint64_t{16} << 20U;
constexpr std::size_t kLongestMemberName = 255;
constexpr std::string_view kCodeMagic =
    "\x7f"
    "ELF";

// Returns why a member must not have the name; empty if it may.
std::string NameMistake(const std::string& name)
{
  if (name.empty() || name.size() > kLongestMemberName) return "its length must be 1 to 255 bytes";
  if (std::ranges::any_of(name, [](unsigned char c) { return c < ' ' || c == 0x7f || c == '\\'; }))
    return "it has a control character or a backslash";
  if (name.front() == '/') return "it is an absolute path";
  for (std::size_t begin = 0; begin <= name.size();)
  {
    const std::size_t end = std::min(name.find('/', begin), name.size());
    const std::string part = name.substr(begin, end - begin);
    if (part.empty() || part == "." || part == "..") return "it leads to another folder";
    begin = end + 1;
  }
  return {};
}

std::uint64_t CountIn(const Json& json, const char* name)
{
  const Json& value = json.at(name);
  if (!value.is_number_unsigned()) throw std::runtime_error(fmt::format("'{}' is no count", name));
  return value.get<std::uint64_t>();
}

std::string ReadWholeMember(TarReader& tar, const TarEntry& entry, std::uint64_t most_bytes)
{
  if (entry.bytes > most_bytes) throw std::runtime_error(fmt::format("'{}' in it is too long", entry.name));
  std::string text;
  for (std::span<const char> part = tar.Read(); !part.empty(); part = tar.Read()) text.append(part.data(), part.size());
  return text;
}

void UnpackMember(TarReader& tar, const ArchiveMember& member, const fs::path& folder)
{
  const fs::path path = folder / member.name;
  fs::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  Sha256 digest;
  bool is_first = true;
  for (std::span<const char> part = tar.Read(); !part.empty(); part = tar.Read())
  {
    if (std::exchange(is_first, false) && std::string_view(part.data(), part.size()).starts_with(kCodeMagic))
      throw std::runtime_error(fmt::format("'{}' in it is program code, which no archive has", member.name));
    digest.Add(part);
    file.write(part.data(), static_cast<std::streamsize>(part.size()));
  }
  if (!file.flush())
    throw std::runtime_error(fmt::format("cannot write '{}': {}", path.string(), std::strerror(errno)));
  if (digest.Text() != member.digest)
    throw std::runtime_error(
        fmt::format("'{}' in it is damaged: its SHA-256 is not that of {}", member.name, kArchiveIndex));
}

ArchiveIndex Unpack(const std::string& path, const fs::path& folder)
{
  TarReader tar(path);
  const auto first = tar.Next();
  const std::size_t slash = first ? first->name.find('/') : std::string::npos;
  if (slash == std::string::npos || first->name.substr(slash + 1) != kArchiveIndex)
    throw std::runtime_error(fmt::format("it does not begin with {}, as archives of runs do", kArchiveIndex));
  const std::string top = first->name.substr(0, slash + 1);
  ArchiveIndex index = ArchiveIndex::Parse(ReadWholeMember(tar, *first, kMostIndexBytes));

  std::uint64_t bytes = 0;
  for (const ArchiveMember& member : index.members) bytes += member.bytes;
  if (const std::uint64_t space = fs::space(folder).available; bytes > space)
    throw std::runtime_error(fmt::format("it needs {} bytes in '{}', which has {}; set TMPDIR to a folder with space",
                                         bytes, folder.parent_path().string(), space));
  for (const ArchiveMember& member : index.members)
  {
    const auto entry = tar.Next();
    if (!entry || entry->name != top + member.name || entry->bytes != member.bytes)
      throw std::runtime_error(
          fmt::format("it has {} where its list has '{}' of {} bytes",
                      entry ? fmt::format("'{}' of {} bytes", entry->name, entry->bytes) : "its end", top + member.name,
                      member.bytes));
    UnpackMember(tar, member, folder);
  }
  if (const auto more = tar.Next()) throw std::runtime_error(fmt::format("its list lacks '{}'", more->name));
  return index;
}

}  // namespace

bool ArchiveIndex::Has(const std::string& name) const
{
  return std::ranges::any_of(members, [&](const ArchiveMember& member) { return member.name == name; });
}

std::string ArchiveIndex::Text() const
{
  Json json;
  json["format"] = kFormat;
  json["version"] = kArchiveVersion;
  json["swarmanoid"] = version;
  json["revision"] = revision;
  json["experiment"] = experiment;
  json["seed"] = seed;
  json["first_tick"] = first_tick;
  json["last_tick"] = last_tick;
  json["has_ended"] = has_ended;
  json["libraries"] = Json::object();
  for (const LibraryBuild& build : builds) json["libraries"][build.name] = build.build;
  json["moved"] = Json::object();
  for (const auto& [path, member] : moved) json["moved"][path] = member;
  json["members"] = Json::array();
  for (const ArchiveMember& member : members)
    json["members"].push_back({{"name", member.name}, {"bytes", member.bytes}, {"sha256", member.digest}});
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

ArchiveIndex ArchiveIndex::Parse(const std::string& text)
{
  try
  {
    const Json json = Json::parse(text);
    if (json.at("format") != kFormat) throw std::runtime_error("its format has another name");
    if (const std::uint64_t version = CountIn(json, "version"); version != kArchiveVersion)
      throw std::runtime_error(fmt::format(
          "it is of version {} of archives, made by Swarmanoid {}; this is Swarmanoid {}, which reads version {}{}",
          version, Quoted(json.value("swarmanoid", "")), Version(), kArchiveVersion,
          version > kArchiveVersion ? "; install a newer Swarmanoid" : ""));
    ArchiveIndex index;
    index.version = json.at("swarmanoid").get<std::string>();
    index.revision = json.at("revision").get<std::string>();
    index.experiment = json.at("experiment").get<std::string>();
    index.seed = CountIn(json, "seed");
    index.first_tick = CountIn(json, "first_tick");
    index.last_tick = CountIn(json, "last_tick");
    index.has_ended = json.at("has_ended").get<bool>();
    for (const auto& [name, build] : json.at("libraries").items())
      index.builds.push_back({name, build.get<std::string>()});
    for (const Json& member : json.at("members"))
    {
      index.members.push_back(
          {member.at("name").get<std::string>(), CountIn(member, "bytes"), member.at("sha256").get<std::string>()});
      const ArchiveMember& newest = index.members.back();
      if (const std::string mistake = NameMistake(newest.name); !mistake.empty())
        throw std::runtime_error(fmt::format("the name {} is not allowed: {}", Quoted(newest.name), mistake));
      if (index.members.size() > 1 && index.members[index.members.size() - 2].name >= newest.name)
        throw std::runtime_error("its members are not in the order of their names");
      // No sum of sizes can wrap around.
      if (newest.bytes >> 40U != 0) throw std::runtime_error(fmt::format("'{}' is too long", newest.name));
    }
    for (const auto& [path, member] : json.at("moved").items())
      if (!index.Has(index.moved[path] = member.get<std::string>()))
        throw std::runtime_error(fmt::format("its list lacks {}", Quoted(index.moved[path])));
    for (const char* needed : {"experiment.xml", kArchivedHashes})
      if (!index.Has(needed)) throw std::runtime_error(fmt::format("its list lacks '{}'", needed));
    return index;
  }
  catch (const Json::exception& error)
  {
    throw std::runtime_error(fmt::format("its {} is no index of an archive: {}", kArchiveIndex, error.what()));
  }
}

ArchiveIndex UnpackArchive(const std::string& path, const std::string& folder)
{
  try
  {
    return Unpack(path, folder);
  }
  catch (const std::runtime_error& error)
  {
    throw ArchiveError(fmt::format("the archive '{}' cannot be used: {}", path, error.what()));
  }
}

}  // namespace swarmanoid
