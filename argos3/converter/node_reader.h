// Reads the elements of a file of ARGoS3, and reports missing and malformed content. The classes that convert parts of
// a file derive from it.
#pragma once

#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>

#include "argos3/converter/convert.h"
#include "argos3/converter/nodes.h"

namespace swarmanoid::argos3
{

class NodeReader
{
protected:
  // `result` gets mistakes and notes; it must outlive the object.
  explicit NodeReader(ConvertedExperiment& result) : result_(result) {}

  void Mistake(const SourceLocation& at, const std::string& message);
  void Note(const SourceLocation& at, const std::string& message);
  const ConfigurationNode* Needed(const ConfigurationNode& node, const std::string& name);
  // Read attributes. Missing required ones and malformed ones are reported.
  std::optional<std::string> Text(const ConfigurationNode& node, const std::string& name);
  std::string NeededText(const ConfigurationNode& node, const std::string& name);
  template <class Value>
  Value Parsed(const ConfigurationNode& node, const std::string& name, const Value& fallback,
               std::optional<Value> (*parse)(std::string_view), const char* form)
  {
    const ConfigurationNode::Attribute* attribute = FindAttributeOf(node, name);
    if (attribute == nullptr) return fallback;
    if (const std::optional<Value> value = parse(attribute->value)) return *value;
    if (const std::optional<Value> value = Forgiven<Value>(*attribute, node.name)) return *value;
    Mistake(attribute->location, "'" + name + "' of <" + node.name + "> is '" + attribute->value + "'; write " + form);
    return fallback;
  }
  // Returns the value of a text that ARGoS3 reads, although it is malformed, with a note.
  template <class Value>
  std::optional<Value> Forgiven(const ConfigurationNode::Attribute& attribute, const std::string& tag)
  {
    const auto note = [&](const std::string& value)
    {
      Note(attribute.location, "'" + attribute.name + "' of <" + tag + "> is '" + attribute.value +
                                   "', which is read as " + value + ", as in ARGoS3");
    };
    if constexpr (std::is_same_v<Value, Vector3>)
    {
      const auto vector = Argos3Vector(attribute.value);
      if (vector) note(TextOf(*vector));
      return vector;
    }
    else if constexpr (std::is_same_v<Value, double> || std::is_same_v<Value, long long>)
    {
      const auto number = Argos3Number(attribute.value);
      constexpr double kMost = 9e15;
      if (!number || !(std::abs(*number) < kMost)) return std::nullopt;
      const auto value = static_cast<Value>(*number);
      note(fmt::format("{}", value));
      return value;
    }
    else
      return std::nullopt;
  }
  double Number(const ConfigurationNode& node, const std::string& name, double fallback);
  double NeededNumber(const ConfigurationNode& node, const std::string& name);
  // Reads a number that must be above 0.
  double Positive(const ConfigurationNode& node, const std::string& name, double fallback);
  long long Whole(const ConfigurationNode& node, const std::string& name, long long fallback);
  bool Flag(const ConfigurationNode& node, const std::string& name, bool fallback);
  static std::optional<Vector3> ParseVector(std::string_view text);
  Vector3 Vector(const ConfigurationNode& node, const std::string& name, const Vector3& fallback = Vector3::Zero());
  Vector3 NeededVector(const ConfigurationNode& node, const std::string& name);
  // Reports attributes that are no parameters here.
  void NoteOthers(const ConfigurationNode& node, const std::set<std::string>& known);
  // Reports elements that are not read here.
  void NoteOtherChildren(const ConfigurationNode& node, const std::set<std::string>& known);

private:
  ConvertedExperiment& result_;
};

}  // namespace swarmanoid::argos3
