// The members of a tar.gz file with a list of them in front: archives of runs (run_archive.h) and packages
// (launcher/packages). Everything in such a file is checked against its list.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "launcher/archive/tar_file.h"

namespace swarmanoid
{

struct ArchiveMember
{
  std::string name;
  std::uint64_t bytes = 0;
  std::string digest;  // SHA-256

  bool operator==(const ArchiveMember&) const = default;
};

// Returns why a member must not have the name; empty if it may.
std::string MemberNameMistake(const std::string& name);

// Converts a list to JSON and back. Throws std::runtime_error with the reason, or an exception of nlohmann::json, if a
// name is not allowed, if a size is no count or 2^40 bytes and more, or if names are not in ascending order.
nlohmann::ordered_json MembersJson(const std::vector<ArchiveMember>& members);
std::vector<ArchiveMember> MembersOf(const nlohmann::ordered_json& json);
// Throws std::runtime_error, or an exception of nlohmann::json, unless a list names this format and version. `files`:
// "archives" or "packages", for the error.
void CheckFormat(const nlohmann::ordered_json& list, const char* format, unsigned version, const char* files);
// Returns a member of an object that must be a count. Throws std::runtime_error.
std::uint64_t CountIn(const nlohmann::ordered_json& json, const char* name);

// Returns the first member, which must have the name `list` below one folder; sets that folder, with its slash. Throws
// std::runtime_error with the reason.
std::string ReadListMember(TarReader& tar, const std::string& list, std::string& top);

// Unpacks exactly the listed members, which must follow in their order below the folder `top`, into an empty folder.
// Each one is checked: its place in the list, its size, its digest, and that it is no program code. Throws
// std::runtime_error with the reason.
void UnpackMembers(TarReader& tar, const std::vector<ArchiveMember>& members, const std::string& list,
                   const std::string& top, const std::filesystem::path& folder);

// Returns whether the first bytes of a file are those of program code.
bool IsProgramCode(std::string_view bytes);

}  // namespace swarmanoid
