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

// Where the value of an option goes. A flag turns its bool to the opposite of its default.
using OptionTarget = std::variant<bool*, int*, unsigned*, std::uint64_t*, double*, std::string*, std::optional<int>*,
                                  std::optional<std::uint64_t>*, std::vector<std::string>*>;

struct OptionSpec
{
  // Name, type, unit, description, range and choices; the default is what the target holds. A name in capitals is that
  // of a word that stands for itself, as in `run EXPERIMENT`.
  ParameterSpec value;
  OptionTarget target;
  std::string example{};  // a value
  std::string form{};     // of a text: "PATH=VALUE"
  // What is wrong with a text of the right type, as "it must be …"; empty if it is right.
  std::function<std::string(const std::string&)> mistake{};
  bool required = false;
  bool joined = false;  // several values are written as A,B instead of one after the other
  std::string group{};  // the heading of the help that it stands under; empty: "Options"
};

// Adds them to a command line, with their help. Bad values throw UsageError from its parse function.
void AddOptions(CLI::App& app, const std::vector<OptionSpec>& options);

// Whether the option's target may hold the text; empty, or the whole sentence with the cure.
std::string MistakeIn(const OptionSpec& option, const std::string& text);

// The command line that gives `options` their values where those of `defaults`, the same table of settings that nobody
// touched, differ.
std::vector<std::string> WordsOf(const std::vector<OptionSpec>& options, const std::vector<OptionSpec>& defaults);

}  // namespace swarmanoid
