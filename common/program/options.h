// The options of a program, declared once each: parsing, checks, errors, --help, and the words that start another
// program with the same settings all come from these tables. Used by every program, before its work starts.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
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
  // Name, type, unit, description, range and choices. The default is the present value of the target. A name in
  // capitals is that of a positional word, as in `run EXPERIMENT`.
  ParameterSpec value;
  OptionTarget target;
  std::string example{};  // a value
  std::string form{};     // of a text: "PATH=VALUE"
  // Returns the mistake of a text of the right type as "it must be …", or an empty text.
  std::function<std::string(const std::string&)> mistake{};
  bool required = false;
  bool joined = false;  // several values are written as A,B instead of one after the other
  std::string group{};  // the heading of the help that it stands under; empty: "Options"
};

// Adds them to a command line, with their help. Bad values throw UsageError from its parse function.
void AddOptions(CLI::App& app, const std::vector<OptionSpec>& options);

// Whether the option's target may hold the text; empty, or the whole sentence with the cure.
std::string MistakeIn(const OptionSpec& option, const std::string& text);

// Returns the command line that sets the options whose values differ from those of `defaults`, the same table with
// unchanged settings.
std::vector<std::string> WordsOf(const std::vector<OptionSpec>& options, const std::vector<OptionSpec>& defaults);

}  // namespace swarmanoid
