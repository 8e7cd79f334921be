// Files made from templates, in which @name@, @class@ and similar marks are replaced by the names that a user chose.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace swarmanoid
{

// The text of each mark of a template: {"name", "wall_follower"} for @name@.
using TemplateValues = std::map<std::string, std::string>;

// Returns whether the name consists of small letters, digits and '_', and begins with a letter.
bool IsIdentifier(const std::string& name);
// Returns whether the name consists of letters, digits and '_', and begins with a capital letter.
bool IsClassName(const std::string& name);
// Returns "CWallFollower" for "wall_follower".
std::string ClassName(const std::string& name);
// Returns "CBTFootbotStop" for "bt_footbot_stop", and "CBTStop" for "stop".
std::string BehaviorClassName(const std::string& name);
std::string FilledIn(std::string text, const TemplateValues& values);

// Throws UsageError if a file or folder of that name exists.
void RefuseExisting(const std::filesystem::path& path);
// Writes `to`, and its folder if needed. Throws std::runtime_error.
void WriteFromTemplate(const std::filesystem::path& from, const std::filesystem::path& to,
                       const TemplateValues& values);

}  // namespace swarmanoid
