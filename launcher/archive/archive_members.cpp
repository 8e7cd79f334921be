#include "launcher/archive/archive_members.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "common/configuration/wording.h"
#include "common/version/version.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t kMostListBytes = std::uint64_t{16} << 20U;
constexpr std::size_t kLongestMemberName = 255;
constexpr std::string_view kCodeMagic =
    "\x7f"
    "ELF";

std::string ReadWholeMember(TarReader& tar, const TarEntry& entry, std::uint64_t most_bytes)
{
  if (entry.bytes > most_bytes) throw std::runtime_error(fmt::format("'{}' in it is too long", entry.name));
  std::string text;
  for (std::span<const char> part = tar.Read(); !part.empty(); part = tar.Read()) text.append(part.data(), part.size());
  return text;
}

void UnpackMember(TarReader& tar, const ArchiveMember& member, const std::string& list, const fs::path& folder)
{
  const fs::path path = folder / member.name;
  fs::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  Sha256 digest;
  bool is_first = true;
  for (std::span<const char> part = tar.Read(); !part.empty(); part = tar.Read())
  {
    if (std::exchange(is_first, false) && IsProgramCode({part.data(), part.size()}))
      throw std::runtime_error(fmt::format("'{}' in it is program code, which no archive has", member.name));
    digest.Add(part);
    file.write(part.data(), static_cast<std::streamsize>(part.size()));
  }
  if (!file.flush())
    throw std::runtime_error(fmt::format("cannot write '{}': {}", path.string(), std::strerror(errno)));
  if (digest.Text() != member.digest)
    throw std::runtime_error(fmt::format("'{}' in it is damaged: its SHA-256 is not that of {}", member.name, list));
}

}  // namespace

bool IsProgramCode(std::string_view bytes) { return bytes.starts_with(kCodeMagic); }

std::string MemberNameMistake(const std::string& name)
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

void CheckFormat(const Json& list, const char* format, unsigned version, const char* files)
{
  if (list.at("format") != format) throw std::runtime_error("its format has another name");
  if (const std::uint64_t there = CountIn(list, "version"); there != version)
    throw std::runtime_error(
        fmt::format("it is of version {} of {}, made by Swarmanoid {}; this is Swarmanoid {}, which reads version {}{}",
                    there, files, Quoted(list.value("swarmanoid", "")), Version(), version,
                    there > version ? "; install a newer Swarmanoid" : ""));
}

std::uint64_t CountIn(const Json& json, const char* name)
{
  const Json& value = json.at(name);
  if (!value.is_number_unsigned()) throw std::runtime_error(fmt::format("'{}' is no count", name));
  return value.get<std::uint64_t>();
}

Json MembersJson(const std::vector<ArchiveMember>& members)
{
  Json json = Json::array();
  for (const ArchiveMember& member : members)
    json.push_back({{"name", member.name}, {"bytes", member.bytes}, {"sha256", member.digest}});
  return json;
}

std::vector<ArchiveMember> MembersOf(const Json& json)
{
  std::vector<ArchiveMember> members;
  for (const Json& member : json)
  {
    members.push_back(
        {member.at("name").get<std::string>(), CountIn(member, "bytes"), member.at("sha256").get<std::string>()});
    const ArchiveMember& newest = members.back();
    if (const std::string mistake = MemberNameMistake(newest.name); !mistake.empty())
      throw std::runtime_error(fmt::format("the name {} is not allowed: {}", Quoted(newest.name), mistake));
    if (members.size() > 1 && members[members.size() - 2].name >= newest.name)
      throw std::runtime_error("its members are not in the order of their names");
    // No sum of sizes can wrap around.
    if (newest.bytes >> 40U != 0) throw std::runtime_error(fmt::format("'{}' is too long", newest.name));
  }
  return members;
}

std::string ReadListMember(TarReader& tar, const std::string& list, std::string& top)
{
  const auto first = tar.Next();
  const std::size_t slash = first ? first->name.find('/') : std::string::npos;
  if (slash == std::string::npos || first->name.substr(slash + 1) != list)
    throw std::runtime_error(fmt::format("it does not begin with {}", list));
  top = first->name.substr(0, slash + 1);
  return ReadWholeMember(tar, *first, kMostListBytes);
}

void UnpackMembers(TarReader& tar, const std::vector<ArchiveMember>& members, const std::string& list,
                   const std::string& top, const fs::path& folder)
{
  std::uint64_t bytes = 0;
  for (const ArchiveMember& member : members) bytes += member.bytes;
  if (const std::uint64_t space = fs::space(folder).available; bytes > space)
    throw std::runtime_error(fmt::format("it needs {} bytes in '{}', which has {}; make space there", bytes,
                                         folder.parent_path().string(), space));
  for (const ArchiveMember& member : members)
  {
    const auto entry = tar.Next();
    if (!entry || entry->name != top + member.name || entry->bytes != member.bytes)
      throw std::runtime_error(
          fmt::format("it has {} where its list has '{}' of {} bytes",
                      entry ? fmt::format("'{}' of {} bytes", entry->name, entry->bytes) : "its end", top + member.name,
                      member.bytes));
    UnpackMember(tar, member, list, folder);
  }
  if (const auto more = tar.Next()) throw std::runtime_error(fmt::format("its list lacks '{}'", more->name));
}

}  // namespace swarmanoid
