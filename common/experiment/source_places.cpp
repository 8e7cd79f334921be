#include "common/experiment/source_places.h"

#include <charconv>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "common/configuration/xml_reader.h"

namespace swarmanoid
{
namespace
{

// <?swarmanoid-places FILE FILE … | PLACE PLACE …?> holds first the names of the files. Then each element and each of
// its attributes, in the order of the text, has "file,line,column" with the file's number from 0. An empty field
// repeats the value of the previous place.
constexpr std::string_view kStart = "<?swarmanoid-places ";
constexpr std::string_view kEnd = "?>";
constexpr std::string_view kNoFile = "%";
constexpr std::string_view kHexDigits = "0123456789abcdef";

bool IsPlain(char c)
{
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '/' || c == '.' ||
         c == '_' || c == '-';
}

std::string Escaped(const std::string& text)
{
  std::string escaped;
  for (const char c : text)
  {
    if (IsPlain(c))
    {
      escaped += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    escaped += {'%', kHexDigits[byte >> 4U], kHexDigits[byte & 15U]};
  }
  return escaped;
}

std::string Unescaped(std::string_view text)
{
  std::string plain;
  if (text == kNoFile) return plain;
  for (std::size_t k = 0; k < text.size(); ++k)
  {
    unsigned byte = 0;
    if (text[k] != '%' || k + 2 >= text.size() ||
        std::from_chars(text.data() + k + 1, text.data() + k + 3, byte, 16).ptr != text.data() + k + 3)
    {
      plain += text[k];
      continue;
    }
    plain += static_cast<char>(byte);
    k += 2;
  }
  return plain;
}

// Visits all places of a tree in the order of its text.
template <class Visit>
void ForEachPlace(const ConfigurationNode& node, const Visit& visit)
{
  visit(node.location);
  for (const ConfigurationNode::Attribute& attribute : node.attributes) visit(attribute.location);
  for (const auto& child : node.children) ForEachPlace(*child, visit);
}

class PlaceReader
{
public:
  explicit PlaceReader(std::string_view text)
  {
    const std::size_t bar = std::min(text.find('|'), text.size());
    for (std::string_view files = text.substr(0, bar); !files.empty();)
      if (const std::string_view file = Word(files); !file.empty())
        files_.push_back(std::make_shared<const std::string>(Unescaped(file)));
    text.remove_prefix(std::min(bar + 1, text.size()));
    rest_ = text;
  }

  // Returns the next place; nullopt at the end, or for a text that no writer writes.
  std::optional<SourceLocation> Next()
  {
    while (rest_.starts_with(' ')) rest_.remove_prefix(1);
    std::string_view word = Word(rest_);
    if (word.empty() || !Take(word, file_) || !Take(word, line_) || !Take(word, column_) || !word.empty())
      return std::nullopt;
    if (file_ < 0 || file_ >= static_cast<int>(files_.size())) return std::nullopt;
    return SourceLocation{files_[static_cast<std::size_t>(file_)], line_, column_};
  }
  bool AtEnd() const { return rest_.empty(); }

private:
  static std::string_view Word(std::string_view& text)
  {
    const std::size_t blank = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, blank);
    text.remove_prefix(std::min(blank + 1, text.size()));
    return word;
  }
  // Reads a number up to the next comma; an empty one leaves the value as it is.
  static bool Take(std::string_view& word, int& value)
  {
    const std::size_t comma = std::min(word.find(','), word.size());
    const std::string_view digits = word.substr(0, comma);
    word.remove_prefix(std::min(comma + 1, word.size()));
    if (digits.empty()) return true;
    const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    return result.ec == std::errc() && result.ptr == digits.data() + digits.size() && value >= 0;
  }

  std::vector<std::shared_ptr<const std::string>> files_;
  std::string_view rest_;
  int file_ = 0, line_ = 0, column_ = 0;
};

// Returns the tree with its places; nullptr if the places do not fit it.
std::shared_ptr<const ConfigurationNode> Placed(const ConfigurationNode& node, PlaceReader& places)
{
  auto placed = std::make_shared<ConfigurationNode>(node);
  const auto own = places.Next();
  if (!own) return nullptr;
  placed->location = *own;
  for (ConfigurationNode::Attribute& attribute : placed->attributes)
  {
    const auto place = places.Next();
    if (!place) return nullptr;
    attribute.location = *place;
  }
  for (auto& child : placed->children)
  {
    child = Placed(*child, places);
    if (child == nullptr) return nullptr;
  }
  return placed;
}

}  // namespace

std::string WritePlaces(const ConfigurationNode& root)
{
  std::map<const std::string*, int> numbers;
  std::string files;
  std::string places;
  SourceLocation before;
  int file_before = 0;
  const std::string none;
  ForEachPlace(root,
               [&](const SourceLocation& place)
               {
                 const std::string* name = place.file ? place.file.get() : &none;
                 const auto [file, is_new] = numbers.emplace(name, static_cast<int>(numbers.size()));
                 if (is_new) files += (name->empty() ? std::string(kNoFile) : Escaped(*name)) + " ";
                 places += ' ';
                 if (file->second != file_before) places += std::to_string(file->second);
                 places += ',';
                 if (place.line != before.line) places += std::to_string(place.line);
                 places += ',';
                 if (place.column != before.column) places += std::to_string(place.column);
                 before = place;
                 file_before = file->second;
               });
  return std::string(kStart) + files + "|" + places + std::string(kEnd) + "\n";
}

std::string_view WithoutPlaces(std::string_view text) { return text.substr(0, text.rfind(kStart)); }

std::shared_ptr<const ConfigurationNode> ReadXmlWithPlaces(const std::string& text, const std::string& file_name)
{
  const std::size_t start = text.rfind(kStart);
  std::string_view rest = start == std::string::npos ? std::string_view() : std::string_view(text).substr(start);
  const std::size_t end = rest.find(kEnd);
  const bool is_last = end != std::string_view::npos && TrimBlanks(rest.substr(end + kEnd.size())).empty();
  if (!is_last) return ReadXml(text, file_name);

  const auto root = ReadXml(text.substr(0, start), file_name);
  PlaceReader places(rest.substr(kStart.size(), end - kStart.size()));
  const auto placed = Placed(*root, places);
  return placed != nullptr && places.AtEnd() ? placed : root;
}

}  // namespace swarmanoid
