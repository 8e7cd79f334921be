// TConfigurationTree: a handle to one element of an experiment file. Controllers, devices, engines and renderers get
// their subtree. The tree is immutable, and copies share the element. It does not depend on the simulator.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/math/pose.h"

namespace swarmanoid
{

// An element or attribute stands at this place of its file. Line and column count from 1, and are 0 if unknown.
struct SourceLocation
{
  std::shared_ptr<const std::string> file;
  int line = 0;
  int column = 0;

  // Returns "file:line:col", or the part of it that is known.
  std::string Text() const;
};

// A user's mistake in an experiment file is thrown as this error. what() is "file:line:col: " and the mistake, with its
// cure.
class ConfigurationError : public std::runtime_error
{
public:
  ConfigurationError(const SourceLocation& location, const std::string& message);
  explicit ConfigurationError(const std::string& message) : ConfigurationError(SourceLocation{}, message) {}

  const SourceLocation& Location() const { return location_; }
  const std::string& Message() const { return message_; }  // without the file, line and column

private:
  SourceLocation location_;
  std::string message_;
};

// A node is one element as parsed. The reader of the file builds it; the element that contains it owns it.
struct ConfigurationNode
{
  struct Attribute
  {
    std::string name;
    std::string value;
    SourceLocation location;
  };

  std::string name;
  std::string text;  // character data, trimmed at both ends
  std::vector<Attribute> attributes;
  std::vector<std::shared_ptr<const ConfigurationNode>> children;
  SourceLocation location;
};

class ConfigurationReads;

class TConfigurationTree
{
public:
  TConfigurationTree() = default;
  explicit TConfigurationTree(std::shared_ptr<const ConfigurationNode> node) : node_(std::move(node)) {}
  // Returns a handle to the same element that records all reads of it and of handles made from it
  // (configuration_reads.h).
  TConfigurationTree RecordedIn(std::shared_ptr<ConfigurationReads> reads) const;

  // Returns false for the handle of an element that is not in the file; every getter of such a handle yields its
  // default.
  bool Exists() const { return node_ != nullptr; }
  const std::string& Name() const;
  const std::string& Text() const;
  SourceLocation Location() const;

  // Returns the child elements in the order of the file.
  std::vector<TConfigurationTree> Children() const;
  // Returns the first child of that name, or a handle that does not exist.
  TConfigurationTree Child(std::string_view name) const;
  bool HasAttribute(std::string_view name) const;
  std::string Attribute(std::string_view name) const;  // empty if absent

  // Returns the value of a parameter, written as a child element (<speed>3</speed>) or an attribute (speed="3").
  // Returns nullopt if neither exists.
  std::optional<std::string> Value(std::string_view name) const;
  SourceLocation ValueLocation(std::string_view name) const;

  // Typed values. The forms with a default return it if the parameter is absent; the others throw ConfigurationError
  // then. Both throw if the text is not of the type. Controllers and experiment functions that declare their parameters
  // get a tree with all declared defaults, and need no default here.
  double GetNumber(std::string_view name) const;
  double GetNumber(std::string_view name, double fallback) const;
  long long GetInteger(std::string_view name) const;
  long long GetInteger(std::string_view name, long long fallback) const;
  bool GetBoolean(std::string_view name) const;
  bool GetBoolean(std::string_view name, bool fallback) const;
  std::string GetText(std::string_view name) const;
  std::string GetText(std::string_view name, const std::string& fallback) const;
  Vector2 GetVector2(std::string_view name) const;
  Vector2 GetVector2(std::string_view name, const Vector2& fallback) const;
  Vector3 GetVector3(std::string_view name) const;
  Vector3 GetVector3(std::string_view name, const Vector3& fallback) const;
  std::uint32_t GetColour(std::string_view name) const;  // 0xRRGGBB
  std::uint32_t GetColour(std::string_view name, std::uint32_t fallback) const;

  const ConfigurationNode* Node() const;

private:
  TConfigurationTree(std::shared_ptr<const ConfigurationNode> node, std::shared_ptr<ConfigurationReads> reads)
      : node_(std::move(node)), reads_(std::move(reads))
  {
  }

  // Returns the text of the parameter; throws if it is absent.
  std::string Required(std::string_view name) const;

  std::shared_ptr<const ConfigurationNode> node_;
  std::shared_ptr<ConfigurationReads> reads_;  // records the reads; usually nullptr
};

// Convert whole texts, with blanks allowed around them. They return nullopt if the text is of another form.
std::optional<double> ParseNumber(std::string_view text);
std::optional<long long> ParseInteger(std::string_view text);
std::optional<bool> ParseBoolean(std::string_view text);                 // true/false, yes/no, on/off, 1/0
std::optional<std::vector<double>> ParseNumbers(std::string_view text);  // separated by commas or blanks
// Returns 0xRRGGBB. "red", "#ff0000" and "255,0,0" are the same colour.
std::optional<std::uint32_t> ParseColour(std::string_view text);
std::string_view TrimBlanks(std::string_view text);
inline constexpr std::string_view kBlanks = " \t\r\n";
// Returns the texts between the separators, without surrounding blanks. Empty texts are skipped.
std::vector<std::string> SplitWords(std::string_view text, std::string_view separators = kBlanks);

}  // namespace swarmanoid

using swarmanoid::TConfigurationTree;
