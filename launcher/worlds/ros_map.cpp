// The files are flat: a line has a key and a value, which is a word or a list in brackets. A list may also stand in the
// lines below, each with a hyphen. This is all of YAML that map servers write.
#include "launcher/worlds/ros_map.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "common/configuration/configuration_tree.h"
#include "common/configuration/wording.h"

namespace swarmanoid
{
namespace
{

constexpr std::string_view kBlanks = " \t\r";

std::string_view Trimmed(std::string_view text)
{
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

// Returns the text before a comment, which begins the line or follows a blank.
std::string_view WithoutComment(std::string_view line)
{
  char quote = 0;
  for (std::size_t k = 0; k < line.size(); ++k)
  {
    if (quote != 0)
      quote = line[k] == quote ? 0 : quote;
    else if (line[k] == '"' || line[k] == '\'')
      quote = line[k];
    else if (line[k] == '#' && (k == 0 || kBlanks.find(line[k - 1]) != std::string_view::npos))
      return line.substr(0, k);
  }
  return line;
}

std::string Unquoted(std::string_view text)
{
  const bool is_quoted =
      text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front();
  return std::string(is_quoted ? text.substr(1, text.size() - 2) : text);
}

class MapReader
{
public:
  MapReader(std::string_view text, const std::string& file) : file_(std::make_shared<const std::string>(file))
  {
    std::string* list = nullptr;  // of the key before, if it has no value in its line
    for (int line = 1; !text.empty(); ++line)
    {
      const std::size_t end = std::min(text.find('\n'), text.size());
      const std::string_view content = Trimmed(WithoutComment(text.substr(0, end)));
      text.remove_prefix(std::min(end + 1, text.size()));
      if (content.empty() || content == "---" || content == "..." || content.front() == '%') continue;
      if (list != nullptr && content.starts_with("- "))
      {
        *list += fmt::format("{} ", Trimmed(content.substr(2)));
        continue;
      }
      const std::size_t colon = content.find(": ");
      const bool is_open = colon == std::string_view::npos && content.ends_with(':');
      if (colon == std::string_view::npos && !is_open)
        throw ConfigurationError(At(line), fmt::format("{} is no line of a map: write a key, a colon and a value",
                                                       Quoted(std::string(content.substr(0, 60)))));
      const std::string key(Trimmed(content.substr(0, is_open ? content.size() - 1 : colon)));
      Entry& entry = entries_[key];
      if (entry.line != 0)
        throw ConfigurationError(At(line), fmt::format("{} stands in line {} already", key, entry.line));
      entry = {line, is_open ? std::string() : Unquoted(Trimmed(content.substr(colon + 1)))};
      list = is_open ? &entry.value : nullptr;
    }
  }

  std::string Text(const std::string& key, const std::optional<std::string>& without = std::nullopt) const
  {
    const auto found = entries_.find(key);
    if (found != entries_.end() && !found->second.value.empty()) return found->second.value;
    if (without) return *without;
    throw ConfigurationError(At(1), fmt::format("the map has no {}", key));
  }

  std::vector<double> Numbers(const std::string& key, std::size_t count, const std::string& without) const
  {
    std::string text = Text(key, without.empty() ? std::nullopt : std::optional(without));
    if (text.front() == '[' && text.back() == ']') text = text.substr(1, text.size() - 2);
    const auto numbers = ParseNumbers(text);
    if (!numbers || numbers->size() != count)
      throw ConfigurationError(LineOf(key), fmt::format("{} is {}; it must be {}", key, Quoted(text),
                                                        count == 1 ? "a number" : fmt::format("{} numbers", count)));
    return *numbers;
  }

  double Number(const std::string& key, const std::string& without, double least, double most) const
  {
    const double number = Numbers(key, 1, without)[0];
    if (!(number >= least && number <= most))
      throw ConfigurationError(LineOf(key),
                               fmt::format("{} is {:g}; it must be {:g} to {:g}", key, number, least, most));
    return number;
  }

  SourceLocation LineOf(const std::string& key) const
  {
    const auto found = entries_.find(key);
    return At(found == entries_.end() ? 1 : found->second.line);
  }

private:
  struct Entry
  {
    int line = 0;
    std::string value;
  };

  SourceLocation At(int line) const { return {file_, line, 1}; }

  std::shared_ptr<const std::string> file_;
  std::map<std::string, Entry> entries_;
};

}  // namespace

bool IsRosMapFile(const std::string& path)
{
  const std::string ending = std::filesystem::path(path).extension();
  return ending == ".yaml" || ending == ".yml";
}

RosMap ReadRosMap(std::string_view text, const std::string& file)
{
  const MapReader reader(text, file);
  RosMap map;
  map.image = reader.Text("image");
  map.resolution_m = reader.Number("resolution", "", 1e-6, 1e3);
  const std::vector<double> origin = reader.Numbers("origin", 3, "0 0 0");
  map.origin = {origin[0], origin[1], origin[2]};
  map.occupied_threshold = reader.Number("occupied_thresh", "0.65", 0, 1);
  map.is_negated = reader.Number("negate", "0", 0, 1) != 0;
  const std::string mode = reader.Text("mode", "trinary");
  if (mode != "trinary" && mode != "scale")
    throw ConfigurationError(reader.LineOf("mode"), fmt::format("the mode {} is not read: use trinary", Quoted(mode)));
  return map;
}

}  // namespace swarmanoid
