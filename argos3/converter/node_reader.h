// Reading the elements of a file of ARGoS3; what is not there, or of another form, is told. What converts parts of a
// file derives from it.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "argos3/converter/convert.h"
#include "argos3/converter/nodes.h"

namespace swarmanoid::argos3
{

class NodeReader
{
protected:
  // `result`: where mistakes and notes go; it outlives this.
  explicit NodeReader(ConvertedExperiment& result) : result_(result) {}

  void Mistake(const SourceLocation& at, const std::string& message);
  void Note(const SourceLocation& at, const std::string& message);
  const ConfigurationNode* Needed(const ConfigurationNode& node, const std::string& name);
  // Attributes. What is not there or of another form is told, if it is needed.
  std::optional<std::string> Text(const ConfigurationNode& node, const std::string& name);
  std::string NeededText(const ConfigurationNode& node, const std::string& name);
  template <class Value>
  Value Parsed(const ConfigurationNode& node, const std::string& name, const Value& fallback,
               std::optional<Value> (*parse)(std::string_view), const char* form)
  {
    const ConfigurationNode::Attribute* attribute = FindAttributeOf(node, name);
    if (attribute == nullptr) return fallback;
    if (const std::optional<Value> value = parse(attribute->value)) return *value;
    Mistake(attribute->location, "'" + name + "' of <" + node.name + "> is '" + attribute->value + "'; write " + form);
    return fallback;
  }
  double Number(const ConfigurationNode& node, const std::string& name, double fallback);
  // A number that has to be above 0.
  double Positive(const ConfigurationNode& node, const std::string& name, double fallback);
  long long Whole(const ConfigurationNode& node, const std::string& name, long long fallback);
  bool Flag(const ConfigurationNode& node, const std::string& name, bool fallback);
  static std::optional<Vector3> ParseVector(std::string_view text);
  Vector3 Vector(const ConfigurationNode& node, const std::string& name, const Vector3& fallback = Vector3::Zero());
  Vector3 NeededVector(const ConfigurationNode& node, const std::string& name);
  // Attributes that are no parameters here are told.
  void NoteOthers(const ConfigurationNode& node, const std::set<std::string>& known);

private:
  ConvertedExperiment& result_;
};

}  // namespace swarmanoid::argos3
