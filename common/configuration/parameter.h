// A parameter of the configuration is declared once. Parsing, defaults, checks, error messages, the reference page and
// the XSD follow from the declaration. Plug-ins declare their parameters when they register.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "common/configuration/configuration_tree.h"

namespace swarmanoid
{

enum class ParameterType
{
  kBoolean,
  kInteger,
  kNumber,
  kText,
  kChoice,   // one of `choices`
  kVector2,  // "x, y"
  kVector3,  // "x, y, z"
  kPath,     // a file; relative ones are taken from the folder of the experiment file
  kColour,   // a name (red) or #rrggbb
  kTree      // free content, not checked
};

struct ParameterSpec
{
  // A name that ends in "_n" stands for a family: camera_view_XYZ_n for camera_view_XYZ_0, camera_view_XYZ_1 and so on.
  // A family is never required. A member that is not given has the default, if a default exists.
  std::string name;
  ParameterType type = ParameterType::kNumber;
  std::string unit{};                          // SI symbol, empty for none
  std::optional<std::string> default_value{};  // the text in a file; nullopt makes the parameter required
  std::string description{};                   // one plain sentence: meaning and consequence
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices{};
};

// Returns whether a name in a file is the parameter or a member of its family.
bool Matches(const ParameterSpec& spec, std::string_view name);
bool IsNumbered(const ParameterSpec& spec);
// Returns "a number in m, at least 0", and its range alone (empty for no range).
std::string AllowedText(const ParameterSpec& spec);
std::string RangeText(const ParameterSpec& spec);
// Returns the mistake in a value, as "<subject> is …; it must be …"; empty if the value is right.
std::string MistakeIn(const ParameterSpec& spec, std::string_view text, const std::string& subject);

// Typed reading of the parameters that a table declares. Reading a name outside the table is a programming error.
class Parameters
{
public:
  Parameters(TConfigurationTree tree, std::vector<ParameterSpec> specs)
      : tree_(std::move(tree)), specs_(std::move(specs))
  {
  }

  bool Boolean(std::string_view name) const;
  long long Integer(std::string_view name) const;
  double Number(std::string_view name) const;
  std::string Text(std::string_view name) const;
  Vector2 Vector2Of(std::string_view name) const;
  Vector3 Vector3Of(std::string_view name) const;
  std::uint32_t Colour(std::string_view name) const;  // 0xRRGGBB
  bool IsGiven(std::string_view name) const { return tree_.Value(name).has_value(); }
  const TConfigurationTree& Tree() const { return tree_; }

private:
  std::string ValueOf(std::string_view name) const;
  const ParameterSpec& SpecOf(std::string_view name) const;

  TConfigurationTree tree_;
  std::vector<ParameterSpec> specs_;
};

}  // namespace swarmanoid
