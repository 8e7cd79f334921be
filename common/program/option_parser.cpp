#include "common/program/option_parser.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>

#include "common/configuration/wording.h"
#include "common/program/usage_error.h"

namespace swarmanoid
{
namespace
{

constexpr int kMostJoined = 1000;

template <class... Functions>
struct Overloaded : Functions...
{
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

bool IsPositional(const OptionSpec& option)
{
  return std::isupper(static_cast<unsigned char>(option.value.name[0])) != 0;
}

std::string NameOf(const OptionSpec& option)
{
  return IsPositional(option) ? option.value.name : "--" + option.value.name;
}

// Returns the values of the target as texts, one for each time that the option is to be written.
std::vector<std::string> TextsOf(const OptionTarget& target)
{
  using Texts = std::vector<std::string>;
  const auto optional = [](const auto* value) { return *value ? Texts{fmt::format("{}", **value)} : Texts(); };
  return std::visit(Overloaded{[](const bool* value) { return Texts{*value ? "true" : "false"}; },
                               [](const std::string* value) { return value->empty() ? Texts() : Texts{*value}; },
                               [](const std::vector<std::string>* value) { return *value; },
                               [&](const std::optional<int>* value) { return optional(value); },
                               [&](const std::optional<std::uint64_t>* value) { return optional(value); },
                               [](const auto* value) { return Texts{fmt::format("{}", *value)}; }},
                    target);
}

// Stores a text that has passed the checks.
void Store(const OptionTarget& target, const std::string& text)
{
  const auto whole = [&] { return ParseInteger(text).value(); };
  std::visit(Overloaded{[](bool*) {}, [&](std::string* value) { *value = text; },
                        [&](std::vector<std::string>* value) { value->push_back(text); },
                        [&](double* value) { *value = ParseNumber(text).value(); },
                        [&](std::optional<int>* value) { *value = static_cast<int>(whole()); },
                        [&](std::optional<std::uint64_t>* value) { *value = static_cast<std::uint64_t>(whole()); },
                        [&]<class Number>(Number* value) { *value = static_cast<Number>(whole()); }},
             target);
}

std::string TypeText(const OptionSpec& option)
{
  if (!option.form.empty()) return option.form;
  if (!option.value.choices.empty()) return fmt::format("{}", fmt::join(option.value.choices, "|"));
  if (option.value.type == ParameterType::kPath) return "FILE";
  if (!option.value.unit.empty()) return option.value.unit;
  if (option.value.type == ParameterType::kInteger) return "N";
  return option.value.type == ParameterType::kNumber ? "NUMBER" : "NAME";
}

std::string HelpText(const OptionSpec& option)
{
  std::string text = option.value.description;
  if (const std::string range = RangeText(option.value); !range.empty()) text += fmt::format(" ({})", range);
  const bool is_flag = std::holds_alternative<bool*>(option.target);
  if (!option.example.empty() && !is_flag && !IsPositional(option))
    text += fmt::format(", for example {} {}", NameOf(option), option.example);
  return text;
}

std::string WithExample(const OptionSpec& option, const std::string& mistake)
{
  if (option.example.empty()) return mistake;
  const std::string name = IsPositional(option) ? "" : NameOf(option) + " ";
  return fmt::format("{}; for example {}{}", mistake, name, option.example);
}

CLI::Option* AddFlag(CLI::App& app, const OptionSpec& option, bool* target)
{
  return app.add_flag_callback(
      NameOf(option), [target, to = !*target] { *target = to; }, HelpText(option));
}

CLI::Option* AddValue(CLI::App& app, const OptionSpec& option)
{
  const auto take = [option](const CLI::results_t& results)
  {
    if (auto* const* list = std::get_if<std::vector<std::string>*>(&option.target)) (*list)->clear();
    for (const std::string& text : results)
    {
      const std::string mistake = MistakeIn(option, text);
      if (!mistake.empty()) throw UsageError(mistake);
      Store(option.target, text);
    }
    return true;
  };
  CLI::Option* added = app.add_option(NameOf(option), take, HelpText(option));
  added->type_name(TypeText(option))->expected(1);
  if (std::holds_alternative<std::vector<std::string>*>(option.target))
  {
    added->take_all();
    if (option.joined) added->expected(1, kMostJoined)->delimiter(',');  // A,B or A B
  }
  else if (const auto texts = TextsOf(option.target); !texts.empty())
  {
    added->default_str(texts[0]);
  }
  if (option.required) added->required();
  return added;
}

// Appends an option and its value. A value that begins with a dash is written in the same word as its option, so that
// it is not read as another option.
void Append(std::vector<std::string>& words, const OptionSpec& option, const std::string& value)
{
  if (IsPositional(option))
    words.push_back(value);
  else if (value.starts_with('-'))
    words.push_back(NameOf(option) + "=" + value);
  else
    words.insert(words.end(), {NameOf(option), value});
}

}  // namespace

void AddOptions(CLI::App& app, const std::vector<OptionSpec>& options)
{
  for (const OptionSpec& option : options)
  {
    bool* const* flag = std::get_if<bool*>(&option.target);
    CLI::Option* added = flag != nullptr ? AddFlag(app, option, *flag) : AddValue(app, option);
    if (!option.group.empty()) added->group(option.group);
  }
}

std::string MistakeIn(const OptionSpec& option, const std::string& text)
{
  std::string mistake = MistakeIn(option.value, text, NameOf(option));
  if (mistake.empty() && option.mistake)
    if (const std::string wrong = option.mistake(text); !wrong.empty())
      mistake = fmt::format("{} is {}; {}", NameOf(option), Quoted(text), wrong);
  return mistake.empty() ? mistake : WithExample(option, mistake);
}

std::vector<std::string> WordsOf(const std::vector<OptionSpec>& options, const std::vector<OptionSpec>& defaults)
{
  std::vector<std::string> words;
  for (std::size_t i = 0; i < options.size(); ++i)
  {
    const OptionSpec& option = options[i];
    const std::vector<std::string> texts = TextsOf(option.target);
    if (texts == TextsOf(defaults[i].target)) continue;
    if (std::holds_alternative<bool*>(option.target))
    {
      words.push_back(NameOf(option));
      continue;
    }
    if (option.joined)
    {
      Append(words, option, fmt::format("{}", fmt::join(texts, ",")));
      continue;
    }
    for (const std::string& text : texts) Append(words, option, text);
  }
  return words;
}

}  // namespace swarmanoid
