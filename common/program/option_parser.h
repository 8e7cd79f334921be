// The options of a program, declared once each. Parsing, checks, errors, --help, and the words that start another
// program with the same settings follow from these tables. Every program uses them before its work starts.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "common/configuration/parameter.h"

namespace CLI
{
class App;
}

namespace swarmanoid
{

// The variable that an option sets. A flag sets its bool to the opposite of its default.
using OptionTarget = std::variant<bool*, int*, unsigned*, std::uint64_t*, double*, std::string*, std::optional<int>*,
                                  std::optional<std::uint64_t>*, std::vector<std::string>*>;

struct OptionSpec
{
  // It has name, type, unit, description, range and choices. The default is the present value of the target. A name in
  // capitals is that of a positional word, as in `run EXPERIMENT`.
  ParameterSpec value;
  OptionTarget target;
  std::string example{};  // a value
  std::string form{};     // the form of a text: "PATH=VALUE"
  // Returns the mistake of a text of the right type as "it must be …", or an empty text.
  std::function<std::string(const std::string&)> mistake{};
  bool required = false;
  bool joined = false;  // several values are written as A,B instead of one after the other
  std::string group{};  // the heading of the help that it stands under; empty: "Options"
};

// Return the value of an option.
inline ParameterSpec Flag(std::string name, std::string description)
{
  return {std::move(name), ParameterType::kBoolean, "", {}, std::move(description)};
}
inline ParameterSpec Text(std::string name, std::string description)
{
  return {std::move(name), ParameterType::kText, "", {}, std::move(description)};
}
inline ParameterSpec Path(std::string name, std::string description)
{
  return {std::move(name), ParameterType::kPath, "", {}, std::move(description)};
}
inline ParameterSpec Whole(std::string name, std::string description, double minimum, double maximum)
{
  return {std::move(name), ParameterType::kInteger, "", {}, std::move(description), minimum, maximum};
}
inline ParameterSpec Number(std::string name, std::string unit, std::string description, double minimum, double maximum)
{
  return {std::move(name), ParameterType::kNumber, std::move(unit), {}, std::move(description), minimum, maximum};
}

// Adds the options to a command line, with their help. Bad values throw UsageError from its parse function.
void AddOptions(CLI::App& app, const std::vector<OptionSpec>& options);

// Returns the reason, with the cure, why the option's target cannot hold the text; empty if it can.
std::string MistakeIn(const OptionSpec& option, const std::string& text);

// Returns the command line that sets the options whose values differ from those of `defaults`, the same table with
// unchanged settings.
std::vector<std::string> WordsOf(const std::vector<OptionSpec>& options, const std::vector<OptionSpec>& defaults);

}  // namespace swarmanoid
