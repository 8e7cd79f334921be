// Reads the elements of a world file, and reports missing, malformed and unsupported content with its place. The
// readers of the formats derive from it.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "launcher/worlds/imported_world.h"

namespace swarmanoid
{

class WorldReader
{
protected:
  // `world` gets the bodies, mistakes and notes; it must outlive the object. `is_xml`: texts name parts as <elements>.
  WorldReader(World& world, bool is_xml) : world_(world), is_xml_(is_xml) {}

  void Mistake(const SourceLocation& at, std::string message);
  void Note(const SourceLocation& at, std::string message);

  // Returns the first child or attribute of that name; nullptr if there is none.
  static const ConfigurationNode* Child(const ConfigurationNode& node, std::string_view name);
  static const ConfigurationNode::Attribute* Attribute(const ConfigurationNode& node, std::string_view name);
  // Returns the value of an attribute, or an empty text.
  static std::string TextOf(const ConfigurationNode& node, std::string_view name);

  // Converts a text to so many finite numbers. Another text is a mistake at `at`, and the fallback is returned.
  // `what` names the value: "<size> of <box>".
  std::vector<double> Numbers(const SourceLocation& at, const std::string& text, const std::string& what,
                              std::vector<double> fallback);
  Vector3 Vector(const SourceLocation& at, const std::string& text, const std::string& what, const Vector3& fallback);
  double Number(const SourceLocation& at, const std::string& text, const std::string& what, double fallback);
  // Returns whether all lengths are more than 0 and at most kMostWorldMetres; reports a mistake if not.
  bool AreLengths(const SourceLocation& at, std::span<const double> lengths, const std::string& what);

  // Returns the position, or 0 with a mistake if it is farther away than kMostWorldMetres.
  Vector3 Near(const SourceLocation& at, const Vector3& position, const std::string& what);
  // Returns the mass in kg, or 1 with a mistake if it is not more than 0 and at most kMostWorldMass.
  double Mass(const SourceLocation& at, double mass_kg);
  // Sets the gravity of the world, at most kMostWorldGravity in each direction.
  void SetGravity(const SourceLocation& at, const Vector3& gravity);

  // Adds a note for each attribute and child that is not among the known ones.
  void NoteOthers(const ConfigurationNode& node, const std::set<std::string_view>& known);

  // Returns 0xRRGGBB for channels of 0 to 1.
  static std::uint32_t ColourOf(std::span<const double> channels);

  World& world_;

private:
  bool is_xml_;
};

// The limits of experiments.
inline constexpr double kMostWorldMetres = 1e6;
inline constexpr double kMostWorldMass = 1e9;     // kg
inline constexpr double kMostWorldGravity = 1e3;  // m/s²
inline constexpr double kMostIntensity = 1e9;

}  // namespace swarmanoid
