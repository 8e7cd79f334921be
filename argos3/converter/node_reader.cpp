#include "argos3/converter/node_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <locale>
#include <sstream>

namespace swarmanoid::argos3
{
namespace
{

// Reads a number at the start of a text like a stream of C++; nullopt if there is none.
std::optional<double> NumberOfStream(std::string_view text)
{
  std::istringstream stream{std::string(text)};
  stream.imbue(std::locale::classic());
  double number = 0;
  return stream >> number ? std::optional(number) : std::nullopt;
}

}  // namespace

std::optional<double> Argos3Number(std::string_view text) { return NumberOfStream(text); }

// A field without a number is 0.
std::optional<Vector3> Argos3Vector(std::string_view text)
{
  Vector3 vector = Vector3::Zero();
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::size_t comma = text.find(',');
    if (text.empty() || (comma == std::string_view::npos && axis < 2)) return std::nullopt;
    vector[axis] = NumberOfStream(text.substr(0, comma)).value_or(0);
    text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
  }
  return vector;
}

std::optional<std::string> OurColour(const std::string& colour)
{
  constexpr std::array<std::string_view, 11> kNames{"black", "white",  "red",    "green", "blue",  "magenta",
                                                    "cyan",  "yellow", "orange", "brown", "purple"};
  constexpr std::array<int, 9> kGrays{26, 51, 77, 102, 127, 153, 179, 204, 229};
  if (std::ranges::find(kNames, colour) != kNames.end()) return colour;
  const auto hexadecimal = [](double red, double green, double blue)
  {
    const auto byte = [](double channel) { return static_cast<int>(std::clamp(channel, 0.0, 255.0)); };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(red), byte(green), byte(blue));
  };
  if (colour.size() == 6 && colour.starts_with("gray") && colour[4] >= '1' && colour[4] <= '9' && colour[5] == '0')
  {
    const int gray = kGrays[static_cast<std::size_t>(colour[4] - '1')];
    return hexadecimal(gray, gray, gray);
  }
  const auto channels = ParseNumbers(colour);
  if (!channels || channels->size() < 3) return std::nullopt;
  return hexadecimal((*channels)[0], (*channels)[1], (*channels)[2]);
}

void NodeReader::Mistake(const SourceLocation& at, const std::string& message)
{
  result_.mistakes.push_back({at, message});
}

void NodeReader::Note(const SourceLocation& at, const std::string& message) { result_.notes.push_back({at, message}); }

const ConfigurationNode* NodeReader::Needed(const ConfigurationNode& node, const std::string& name)
{
  const ConfigurationNode* child = FindChild(node, name);
  if (child == nullptr) Mistake(node.location, "<" + node.name + "> has no <" + name + ">; add it");
  return child;
}

std::optional<std::string> NodeReader::Text(const ConfigurationNode& node, const std::string& name)
{
  const ConfigurationNode::Attribute* attribute = FindAttributeOf(node, name);
  return attribute == nullptr ? std::nullopt : std::optional(attribute->value);
}

std::string NodeReader::NeededText(const ConfigurationNode& node, const std::string& name)
{
  const auto text = Text(node, name);
  if (!text) Mistake(node.location, "<" + node.name + "> has no '" + name + "'; add it");
  return text.value_or("");
}

double NodeReader::Number(const ConfigurationNode& node, const std::string& name, double fallback)
{
  return Parsed<double>(node, name, fallback, ParseNumber, "a number");
}

double NodeReader::NeededNumber(const ConfigurationNode& node, const std::string& name)
{
  NeededText(node, name);
  return Number(node, name, 0);
}

double NodeReader::Positive(const ConfigurationNode& node, const std::string& name, double fallback)
{
  const double number = Number(node, name, fallback);
  if (number > 0) return number;
  Mistake(FindAttributeOf(node, name)->location,
          fmt::format("'{}' of <{}> is {}; it must be above 0", name, node.name, number));
  return fallback;
}

long long NodeReader::Whole(const ConfigurationNode& node, const std::string& name, long long fallback)
{
  return Parsed<long long>(node, name, fallback, ParseInteger, "a whole number");
}

bool NodeReader::Flag(const ConfigurationNode& node, const std::string& name, bool fallback)
{
  return Parsed<bool>(node, name, fallback, ParseBoolean, "true or false");
}

std::optional<Vector3> NodeReader::ParseVector(std::string_view text)
{
  const auto numbers = ParseNumbers(text);
  if (!numbers || numbers->size() != 3) return std::nullopt;
  return Vector3((*numbers)[0], (*numbers)[1], (*numbers)[2]);
}

Vector3 NodeReader::Vector(const ConfigurationNode& node, const std::string& name, const Vector3& fallback)
{
  return Parsed<Vector3>(node, name, fallback, ParseVector, "three numbers with commas between them");
}

Vector3 NodeReader::NeededVector(const ConfigurationNode& node, const std::string& name)
{
  NeededText(node, name);
  return Vector(node, name);
}

void NodeReader::NoteOthers(const ConfigurationNode& node, const std::set<std::string>& known)
{
  for (const ConfigurationNode::Attribute& attribute : node.attributes)
    if (!known.contains(attribute.name))
      Note(attribute.location, "'" + attribute.name + "' of <" + node.name + "> has no effect here");
}

void NodeReader::NoteOtherChildren(const ConfigurationNode& node, const std::set<std::string>& known)
{
  for (const auto& child : node.children)
    if (!known.contains(child->name))
      Note(child->location, "<" + child->name + "> of <" + node.name + "> has no effect here");
}

}  // namespace swarmanoid::argos3
