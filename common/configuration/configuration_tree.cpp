#include "common/configuration/configuration_tree.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "common/configuration/configuration_reads.h"
#include "common/configuration/wording.h"

namespace swarmanoid
{
namespace
{

const std::string kNothing;

struct NamedColour
{
  std::string_view name;
  std::uint32_t rgb;
};

constexpr std::array<NamedColour, 14> kColours{{{"black", 0x000000},
                                                {"white", 0xffffff},
                                                {"red", 0xff0000},
                                                {"green", 0x00ff00},
                                                {"blue", 0x0000ff},
                                                {"yellow", 0xffff00},
                                                {"cyan", 0x00ffff},
                                                {"magenta", 0xff00ff},
                                                {"orange", 0xff8c00},
                                                {"purple", 0xa020f0},
                                                {"brown", 0xa52a2a},
                                                {"gray", 0x808080},
                                                {"grey", 0x808080},
                                                {"silver", 0xc0c0c0}}};

const ConfigurationNode::Attribute* FindAttribute(const ConfigurationNode* node, std::string_view name)
{
  if (node == nullptr) return nullptr;
  for (const auto& attribute : node->attributes)
  {
    if (attribute.name == name) return &attribute;
  }
  return nullptr;
}

const std::shared_ptr<const ConfigurationNode>* FindChild(const ConfigurationNode* node, std::string_view name)
{
  if (node == nullptr) return nullptr;
  for (const auto& child : node->children)
  {
    if (child->name == name) return &child;
  }
  return nullptr;
}

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// Returns the error for a missing parameter, with the name that was perhaps meant.
ConfigurationError Missing(const TConfigurationTree& tree, const ConfigurationNode* node, std::string_view name)
{
  std::vector<std::string> given;
  if (node != nullptr)
  {
    for (const auto& attribute : node->attributes) given.push_back(attribute.name);
    for (const auto& child : node->children) given.push_back(child->name);
  }
  std::string message = "<" + tree.Name() + "> lacks the parameter '" + std::string(name) + "'";
  const std::string near = NearestName(name, given);
  if (!near.empty()) message += "; it has '" + near + "': is that meant?";
  return {near.empty() ? tree.Location() : tree.ValueLocation(near), message};
}

ConfigurationError NotA(const TConfigurationTree& tree, std::string_view name, const char* what)
{
  return {tree.ValueLocation(name),
          "'" + std::string(name) + "' is " + Quoted(tree.Value(name).value_or("")) + "; it must be " + what};
}

constexpr const char* kNumberText = "a number";
constexpr const char* kIntegerText = "a whole number";
constexpr const char* kBooleanText = "true or false";
constexpr const char* kPairText = "two numbers \"x, y\"";
constexpr const char* kColourText = "a colour: a name such as red, or #rrggbb, or \"r, g, b\" from 0 to 255";
constexpr const char* kVectorText = "three numbers \"x, y, z\"";

}  // namespace

std::string SourceLocation::Text() const
{
  std::string text = file ? *file : std::string();
  if (line <= 0) return text;
  if (!text.empty()) text += ':';
  text += std::to_string(line);
  if (column > 0) text += ":" + std::to_string(column);
  return text;
}

ConfigurationError::ConfigurationError(const SourceLocation& location, const std::string& message)
    : std::runtime_error(location.Text().empty() ? message : location.Text() + ": " + message),
      location_(location),
      message_(message)
{
}

const std::string& TConfigurationTree::Name() const { return node_ ? node_->name : kNothing; }

const std::string& TConfigurationTree::Text() const
{
  if (reads_ && node_) reads_->ReadText(*node_);
  return node_ ? node_->text : kNothing;
}

SourceLocation TConfigurationTree::Location() const { return node_ ? node_->location : SourceLocation{}; }

TConfigurationTree TConfigurationTree::RecordedIn(std::shared_ptr<ConfigurationReads> reads) const
{
  return {node_, std::move(reads)};
}

const ConfigurationNode* TConfigurationTree::Node() const
{
  if (reads_ && node_) reads_->ReadAll(*node_);
  return node_.get();
}

std::vector<TConfigurationTree> TConfigurationTree::Children() const
{
  std::vector<TConfigurationTree> children;
  if (!node_) return children;
  if (reads_) reads_->ReadChildren(*node_);
  children.reserve(node_->children.size());
  for (const auto& child : node_->children) children.push_back({child, reads_});
  return children;
}

TConfigurationTree TConfigurationTree::Child(std::string_view name) const
{
  if (reads_ && node_) reads_->AskFor(*node_, name);
  const auto* child = FindChild(node_.get(), name);
  return child != nullptr ? TConfigurationTree(*child, reads_) : TConfigurationTree();
}

bool TConfigurationTree::HasAttribute(std::string_view name) const
{
  if (reads_ && node_) reads_->AskFor(*node_, name);
  return FindAttribute(node_.get(), name) != nullptr;
}

std::string TConfigurationTree::Attribute(std::string_view name) const
{
  if (reads_ && node_) reads_->AskFor(*node_, name);
  const auto* attribute = FindAttribute(node_.get(), name);
  return attribute != nullptr ? attribute->value : std::string();
}

std::optional<std::string> TConfigurationTree::Value(std::string_view name) const
{
  if (reads_ && node_) reads_->AskFor(*node_, name);
  if (const auto* child = FindChild(node_.get(), name))
  {
    if (reads_) reads_->ReadText(**child);
    return (*child)->text;
  }
  if (const auto* attribute = FindAttribute(node_.get(), name)) return std::string(TrimBlanks(attribute->value));
  return std::nullopt;
}

SourceLocation TConfigurationTree::ValueLocation(std::string_view name) const
{
  if (const auto* child = FindChild(node_.get(), name)) return (*child)->location;
  if (const auto* attribute = FindAttribute(node_.get(), name)) return attribute->location;
  return Location();
}

std::string TConfigurationTree::Required(std::string_view name) const
{
  auto text = Value(name);
  if (!text) throw Missing(*this, node_.get(), name);
  return *std::move(text);
}

double TConfigurationTree::GetNumber(std::string_view name) const
{
  const auto number = ParseNumber(Required(name));
  if (!number) throw NotA(*this, name, kNumberText);
  return *number;
}

double TConfigurationTree::GetNumber(std::string_view name, double fallback) const
{
  return Value(name) ? GetNumber(name) : fallback;
}

long long TConfigurationTree::GetInteger(std::string_view name) const
{
  const auto number = ParseInteger(Required(name));
  if (!number) throw NotA(*this, name, kIntegerText);
  return *number;
}

long long TConfigurationTree::GetInteger(std::string_view name, long long fallback) const
{
  return Value(name) ? GetInteger(name) : fallback;
}

bool TConfigurationTree::GetBoolean(std::string_view name) const
{
  const auto boolean = ParseBoolean(Required(name));
  if (!boolean) throw NotA(*this, name, kBooleanText);
  return *boolean;
}

bool TConfigurationTree::GetBoolean(std::string_view name, bool fallback) const
{
  return Value(name) ? GetBoolean(name) : fallback;
}

std::string TConfigurationTree::GetText(std::string_view name) const { return Required(name); }

std::string TConfigurationTree::GetText(std::string_view name, const std::string& fallback) const
{
  return Value(name).value_or(fallback);
}

Vector2 TConfigurationTree::GetVector2(std::string_view name) const
{
  const auto numbers = ParseNumbers(Required(name));
  if (!numbers || numbers->size() != 2) throw NotA(*this, name, kPairText);
  return {(*numbers)[0], (*numbers)[1]};
}

Vector2 TConfigurationTree::GetVector2(std::string_view name, const Vector2& fallback) const
{
  return Value(name) ? GetVector2(name) : fallback;
}

Vector3 TConfigurationTree::GetVector3(std::string_view name) const
{
  const auto numbers = ParseNumbers(Required(name));
  if (!numbers || numbers->size() != 3) throw NotA(*this, name, kVectorText);
  return {(*numbers)[0], (*numbers)[1], (*numbers)[2]};
}

Vector3 TConfigurationTree::GetVector3(std::string_view name, const Vector3& fallback) const
{
  return Value(name) ? GetVector3(name) : fallback;
}

std::uint32_t TConfigurationTree::GetColour(std::string_view name) const
{
  const auto colour = ParseColour(Required(name));
  if (!colour) throw NotA(*this, name, kColourText);
  return *colour;
}

std::uint32_t TConfigurationTree::GetColour(std::string_view name, std::uint32_t fallback) const
{
  return Value(name) ? GetColour(name) : fallback;
}

std::string_view TrimBlanks(std::string_view text)
{
  while (!text.empty() && IsBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && IsBlank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string> SplitWords(std::string_view text, std::string_view separators)
{
  std::vector<std::string> words;
  for (std::size_t at = 0; at <= text.size();)
  {
    const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
    const std::string_view word = TrimBlanks(text.substr(at, end - at));
    if (!word.empty()) words.emplace_back(word);
    at = end + 1;
  }
  return words;
}

std::optional<double> ParseNumber(std::string_view text)
{
  text = TrimBlanks(text);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double number = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = result.ec == std::errc() && result.ptr == text.data() + text.size();
  // Neither "inf" nor "nan" is a value that an experiment can use.
  if (!whole || text.empty() || !std::isfinite(number)) return std::nullopt;
  return number;
}

std::optional<long long> ParseInteger(std::string_view text)
{
  text = TrimBlanks(text);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  long long number = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || result.ec != std::errc() || result.ptr != text.data() + text.size()) return std::nullopt;
  return number;
}

std::optional<bool> ParseBoolean(std::string_view text)
{
  text = TrimBlanks(text);
  constexpr std::array<std::string_view, 4> kTrue{"true", "yes", "on", "1"};
  constexpr std::array<std::string_view, 4> kFalse{"false", "no", "off", "0"};
  if (std::find(kTrue.begin(), kTrue.end(), text) != kTrue.end()) return true;
  if (std::find(kFalse.begin(), kFalse.end(), text) != kFalse.end()) return false;
  return std::nullopt;
}

std::optional<std::vector<double>> ParseNumbers(std::string_view text)
{
  text = TrimBlanks(text);
  std::vector<double> numbers;
  while (true)
  {
    std::size_t end = 0;
    while (end < text.size() && text[end] != ',' && !IsBlank(text[end])) ++end;
    const auto number = ParseNumber(text.substr(0, end));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    text = TrimBlanks(text.substr(end));
    if (text.empty()) return numbers;
    if (text.front() == ',') text = TrimBlanks(text.substr(1));
  }
}

std::optional<std::uint32_t> ParseColour(std::string_view text)
{
  text = TrimBlanks(text);
  for (const NamedColour& colour : kColours)
  {
    if (colour.name == text) return colour.rgb;
  }
  if (text.size() == 7 && text.front() == '#')
  {
    std::uint32_t rgb = 0;
    const auto result = std::from_chars(text.data() + 1, text.data() + text.size(), rgb, 16);
    const bool whole = result.ec == std::errc() && result.ptr == text.data() + text.size();
    return whole ? std::optional(rgb) : std::nullopt;
  }
  const auto numbers = ParseNumbers(text);
  if (!numbers || numbers->size() != 3) return std::nullopt;
  std::uint32_t rgb = 0;
  for (const double part : *numbers)
  {
    if (part < 0 || part > 255 || part != std::floor(part)) return std::nullopt;
    rgb = rgb * 256 + static_cast<std::uint32_t>(part);
  }
  return rgb;
}

}  // namespace swarmanoid
