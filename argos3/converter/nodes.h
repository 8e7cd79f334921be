// Functions that build and read elements of a converted file.
#pragma once

#include <fmt/format.h>

#include <memory>
#include <numbers>
#include <optional>
#include <string>
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
