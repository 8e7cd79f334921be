#include "launcher/worlds/world_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/configuration/wording.h"

namespace swarmanoid
{

void WorldReader::Mistake(const SourceLocation& at, std::string message)
{
  world_.mistakes.push_back({at, std::move(message)});
}

void WorldReader::Note(const SourceLocation& at, std::string message)
{
  world_.notes.push_back({at, std::move(message)});
}

const ConfigurationNode* WorldReader::Child(const ConfigurationNode& node, std::string_view name)
{
  for (const auto& child : node.children)
    if (child->name == name) return child.get();
  return nullptr;
}

const ConfigurationNode::Attribute* WorldReader::Attribute(const ConfigurationNode& node, std::string_view name)
{
  const auto found = std::ranges::find(node.attributes, name, &ConfigurationNode::Attribute::name);
  return found == node.attributes.end() ? nullptr : &*found;
}

std::string WorldReader::TextOf(const ConfigurationNode& node, std::string_view name)
{
  const ConfigurationNode::Attribute* attribute = Attribute(node, name);
  return attribute == nullptr ? std::string() : attribute->value;
}

std::vector<double> WorldReader::Numbers(const SourceLocation& at, const std::string& text, const std::string& what,
                                         std::vector<double> fallback)
{
  const auto numbers = ParseNumbers(text);
  const bool are_right = numbers && numbers->size() == fallback.size() &&
                         std::ranges::all_of(*numbers, [](double number) { return std::isfinite(number); });
  if (are_right) return *numbers;
  Mistake(at, fallback.size() == 1
                  ? fmt::format("{} is {}; it must be a number", what, Quoted(text))
                  : fmt::format("{} is {}; it must be {} numbers", what, Quoted(text), fallback.size()));
  return fallback;
}

Vector3 WorldReader::Vector(const SourceLocation& at, const std::string& text, const std::string& what,
                            const Vector3& fallback)
{
  const auto numbers = Numbers(at, text, what, {fallback.x(), fallback.y(), fallback.z()});
  return {numbers[0], numbers[1], numbers[2]};
}

double WorldReader::Number(const SourceLocation& at, const std::string& text, const std::string& what, double fallback)
{
  return Numbers(at, text, what, {fallback})[0];
}

bool WorldReader::AreLengths(const SourceLocation& at, std::span<const double> lengths, const std::string& what)
{
  const auto is_length = [](double length) { return length > 0 && length <= kMostWorldMetres; };
  const auto wrong = std::ranges::find_if_not(lengths, is_length);
  if (wrong == lengths.end()) return true;
  Mistake(at, fmt::format("{} has {:g} m; a length must be more than 0 and at most {:g} m", what, *wrong,
                          kMostWorldMetres));
  return false;
}

Vector3 WorldReader::Near(const SourceLocation& at, const Vector3& position, const std::string& what)
{
  if (position.cwiseAbs().maxCoeff() <= kMostWorldMetres) return position;
  Mistake(at, fmt::format("{} is farther away than {:g} m", what, kMostWorldMetres));
  return Vector3::Zero();
}

double WorldReader::Mass(const SourceLocation& at, double mass_kg)
{
  if (mass_kg > 0 && mass_kg <= kMostWorldMass) return mass_kg;
  Mistake(at, fmt::format("a mass is {:g} kg; it must be more than 0 and at most {:g} kg", mass_kg, kMostWorldMass));
  return 1;
}

void WorldReader::SetGravity(const SourceLocation& at, const Vector3& gravity)
{
  if (gravity.cwiseAbs().maxCoeff() > kMostWorldGravity)
    return Mistake(at, fmt::format("the gravity is more than {:g} m/s2", kMostWorldGravity));
  world_.gravity = gravity;
}

void WorldReader::NoteOthers(const ConfigurationNode& node, const std::set<std::string_view>& known)
{
  const auto note = [&](const SourceLocation& at, const std::string& name, bool is_element)
  {
    if (known.contains(name)) return;
    const std::string part = !is_xml_     ? fmt::format("{} of {}", name, node.name)
                             : is_element ? fmt::format("<{}> of <{}>", name, node.name)
                                          : fmt::format("'{}' of <{}>", name, node.name);
    Note(at, part + " has no counterpart: it is left out");
  };
  for (const ConfigurationNode::Attribute& attribute : node.attributes) note(attribute.location, attribute.name, false);
  for (const auto& child : node.children) note(child->location, child->name, true);
}

std::uint32_t WorldReader::ColourOf(std::span<const double> channels)
{
  std::uint32_t colour = 0;
  for (const double channel : channels.first(3))
    colour = colour << 8U | static_cast<std::uint32_t>(std::lround(255 * std::clamp(channel, 0.0, 1.0)));
  return colour;
}

}  // namespace swarmanoid
