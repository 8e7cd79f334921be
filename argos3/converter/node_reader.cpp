#include "argos3/converter/node_reader.h"

#include <fmt/format.h>

namespace swarmanoid::argos3
{

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

}  // namespace swarmanoid::argos3
