#include "launcher/templates/template_files.h"

#include <fmt/format.h>
#include <cerrno>
#include <cstring>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "common/program/usage_error.h"

namespace swarmanoid
{

bool IsIdentifier(const std::string& name)
{
  const auto small = [](char c) { return c >= 'a' && c <= 'z'; };
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  return !name.empty() && small(name[0]) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return small(c) || digit(c) || c == '_'; });
}

bool IsClassName(const std::string& name)
{
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  return !name.empty() && name[0] >= 'A' && name[0] <= 'Z' &&
         std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || digit(c) || c == '_'; });
}

std::string ClassName(const std::string& name)
{
  std::string result = "C";
  bool first = true;
  for (const char c : name)
  {
    if (c != '_') result += first ? static_cast<char>(std::toupper(c)) : c;
    first = c == '_';
  }
  return result;
}

std::string BehaviorClassName(const std::string& name)
{
  const std::string prefix = "bt_";
  return "CBT" + ClassName(name.starts_with(prefix) ? name.substr(prefix.size()) : name).substr(1);
}

std::string FilledIn(std::string text, const TemplateValues& values)
{
  for (const auto& [key, value] : values)
  {
    const std::string mark = "@" + key + "@";
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + value.size()))
      text.replace(at, mark.size(), value);
  }
  return text;
}

void RefuseExisting(const std::filesystem::path& path)
{
  if (std::filesystem::exists(path))
    throw UsageError(fmt::format("'{}' is there already; choose another name", path.string()));
}

void WriteFromTemplate(const std::filesystem::path& from, const std::filesystem::path& to, const TemplateValues& values)
{
  std::ifstream input(from);
  std::ostringstream text;
  if (!(text << input.rdbuf()))
    throw std::runtime_error(fmt::format("cannot read the template '{}': {}", from.string(), std::strerror(errno)));
  std::filesystem::create_directories(to.parent_path());
  std::ofstream output(to);
  output << FilledIn(text.str(), values);
  if (!output.flush())
    throw std::runtime_error(fmt::format("cannot write '{}': {}", to.string(), std::strerror(errno)));
}

}  // namespace swarmanoid
