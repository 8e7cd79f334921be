#include "launcher/archive/run_archive.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "common/configuration/wording.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "swarmanoid archive";

ArchiveIndex Unpack(const std::string& path, const fs::path& folder)
{
  TarReader tar(path);
  std::string top;
  ArchiveIndex index = ArchiveIndex::Parse(ReadListMember(tar, kArchiveIndex, top));
  UnpackMembers(tar, index.members, kArchiveIndex, top, folder);
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
  json["members"] = MembersJson(members);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

ArchiveIndex ArchiveIndex::Parse(const std::string& text)
{
  try
  {
    const Json json = Json::parse(text);
    CheckFormat(json, kFormat, kArchiveVersion, "archives");
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
    index.members = MembersOf(json.at("members"));
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
