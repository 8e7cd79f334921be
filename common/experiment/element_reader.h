// Checks one element against its table and reads its values. A missing or wrong value is reported once and read as its
// default, so that reading continues and finds all other mistakes too.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/experiment/diagnostics.h"
#include "common/experiment/schema.h"

namespace swarmanoid
{

class ElementReader
{
public:
  // `plugin`: adds the parameters of the plug-in that the element stands for; nullptr for none. With `open`, further
  // content is allowed (the plug-in is unknown, which is reported elsewhere). The arguments must outlive the reader.
  ElementReader(const TConfigurationTree& tree, const ElementSpec& spec, Diagnostics& diagnostics,
                const std::vector<ParameterSpec>* plugin = nullptr, bool open = false);

  // Returns the value, its default, or zero.
  std::string Text(std::string_view name) const;
  double Number(std::string_view name) const;
  long long Integer(std::string_view name) const;
  bool Boolean(std::string_view name) const;
  Vector3 Vector(std::string_view name) const;  // z is 0 for a vector of two components
  std::uint32_t Colour(std::string_view name) const;

  // Returns whether the file has a valid value.
  bool IsGood(std::string_view name) const;
  bool IsGiven(std::string_view name) const { return tree_.Value(name).has_value(); }
  const TConfigurationTree& Tree() const { return tree_; }
  SourceLocation Place(std::string_view name) const { return tree_.ValueLocation(name); }
  void Fail(std::string_view name, std::string message) { diagnostics_.Add(Place(name), std::move(message)); }

private:
  const ParameterSpec* Find(std::string_view name) const;
  std::string ValueOf(std::string_view name) const;
  void CheckAttributes();
  void CheckChildren();
  void CheckParameterElement(const ConfigurationNode& child, const ParameterSpec& parameter);
  void CheckValues(const std::vector<ParameterSpec>& parameters);
  void CheckRequiredChildren();
  std::vector<std::string> ParameterNames() const;
  std::vector<std::string> ChildNames() const;

  const TConfigurationTree& tree_;
  const ElementSpec& spec_;
  Diagnostics& diagnostics_;
  const std::vector<ParameterSpec>* plugin_;
  bool open_;
  std::vector<const ParameterSpec*> wrong_;
};

}  // namespace swarmanoid
