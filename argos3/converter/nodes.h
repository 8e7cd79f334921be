// Functions that build and read elements of a converted file.
#pragma once

#include <fmt/format.h>

#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "common/configuration/configuration_tree.h"

namespace swarmanoid::argos3
{

inline constexpr double kRadians = std::numbers::pi / 180;  // in a degree

using Made = std::shared_ptr<ConfigurationNode>;

inline Made MakeNode(const std::string& name, const SourceLocation& location)
{
  auto node = std::make_shared<ConfigurationNode>();
  node->name = name;
  node->location = location;
  return node;
}

inline Made AddNode(ConfigurationNode& parent, const std::string& name, const SourceLocation& location)
{
  Made node = MakeNode(name, location);
  parent.children.push_back(node);
  return node;
}

inline void SetValue(ConfigurationNode& node, const std::string& name, const std::string& value,
                     const SourceLocation& location)
{
  node.attributes.push_back({name, value, location});
}

// Read numbers as ARGoS3 does, which ignores what follows a number: 10 for "10cm", -2.5, 0, 0 for "-2.5,,0,7". They
// return nullopt for what ARGoS3 refuses.
std::optional<double> Argos3Number(std::string_view text);
std::optional<Vector3> Argos3Vector(std::string_view text);

// Returns the note on a device that names a medium which the file does not have.
inline std::string MissingMedium(const std::string& tag, const std::string& type, const std::string& medium)
{
  return "'medium' of <" + tag + "> is '" + medium + "', and <media> has no <" + type +
         "> of this id; ARGoS3 refuses the file";
}

// Returns our text for a colour of ARGoS3, such as red, gray50 or 255,0,0,255; nullopt for one that is none.
std::optional<std::string> OurColour(const std::string& colour);

// Returns the shortest text that is read back as the same number.
inline std::string TextOf(double number) { return fmt::format("{}", number); }
inline std::string TextOf(const Vector3& v) { return fmt::format("{}, {}, {}", v.x(), v.y(), v.z()); }

inline const ConfigurationNode::Attribute* FindAttributeOf(const ConfigurationNode& node, const std::string& name)
{
  for (const ConfigurationNode::Attribute& attribute : node.attributes)
    if (attribute.name == name) return &attribute;
  return nullptr;
}

inline const ConfigurationNode* FindChild(const ConfigurationNode& node, const std::string& name)
{
  for (const auto& child : node.children)
    if (child->name == name) return child.get();
  return nullptr;
}

}  // namespace swarmanoid::argos3
