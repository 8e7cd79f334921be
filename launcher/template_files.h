// Files made from templates, in which @name@, @class@ and similar marks are replaced by the names that a user chose.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace swarmanoid
{

// The text of each mark of a template: {"name", "wall_follower"} for @name@.
using TemplateValues = std::map<std::string, std::string>;

// Small letters, digits and '_', a letter first.
bool IsIdentifier(const std::string& name);
// Letters, digits and '_', a capital letter first.
bool IsClassName(const std::string& name);
// "CWallFollower" for "wall_follower".
std::string ClassName(const std::string& name);
// "CBTFootbotStop" for "bt_footbot_stop", "CBTStop" for "stop".
std::string BehaviorClassName(const std::string& name);
std::string FilledIn(std::string text, const TemplateValues& values);

// Throws UsageError if there is something already.
void RefuseExisting(const std::filesystem::path& path);
// Writes `to`, and its folder if needed. Throws std::runtime_error.
void WriteFromTemplate(const std::filesystem::path& from, const std::filesystem::path& to,
                       const TemplateValues& values);

}  // namespace swarmanoid
