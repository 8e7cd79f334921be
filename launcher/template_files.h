// Files made from templates, in which @name@ and @class@ stand for the names that a user chose.
#pragma once

#include <filesystem>
#include <string>

namespace swarmanoid
{

struct TemplateNames
{
  std::string name;        // wall_follower
  std::string class_name;  // CWallFollower
};

// Small letters, digits and '_', a letter first.
bool IsIdentifier(const std::string& name);
// "CWallFollower" for "wall_follower".
std::string ClassName(const std::string& name);
std::string FilledIn(std::string text, const TemplateNames& names);

// Throws UsageError where there is something already.
void RefuseExisting(const std::filesystem::path& path);
// Writes `to`, and its folder where needed. Throws std::runtime_error.
void WriteFromTemplate(const std::filesystem::path& from, const std::filesystem::path& to, const TemplateNames& names);

}  // namespace swarmanoid
