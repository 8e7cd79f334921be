#include "common/program/help_text.h"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>
#include <vector>

#include "common/program/standard_output.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kWidthOfFiles = 100;
constexpr std::size_t kLeastWidth = 60;
constexpr std::size_t kMostWidth = 120;
constexpr std::size_t kColumn = 27;  // where descriptions begin

// One row of a list: the name, and the description in a column beside it.
std::string Row(const std::string& name, std::string description, std::size_t width)
{
  std::replace(description.begin(), description.end(), '\n', ' ');
  std::string row = "  " + name;
  const std::string text = Wrapped(description, width - kColumn);
  if (text.empty()) return row + "\n";
  row += row.size() + 2 > kColumn ? "\n" + std::string(kColumn, ' ') : std::string(kColumn - row.size(), ' ');
  for (const char letter : text) row += letter == '\n' ? "\n" + std::string(kColumn, ' ') : std::string(1, letter);
  return row + "\n";
}

std::string Row(const CLI::Option& option, std::size_t width)
{
  const bool is_argument = option.get_positional();
  std::string name = is_argument ? option.get_name() : option.get_name(false, true);
  std::replace(name.begin(), name.end(), ',', ' ');
  if (!is_argument && !option.get_type_name().empty()) name += " " + option.get_type_name();
  std::string description = option.get_description();
  if (const std::string standard = option.get_default_str(); !standard.empty())
    description += fmt::format(" [{}]", standard);
  return Row(name, description, width);
}

class HelpFormatter : public CLI::FormatterBase
{
public:
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode) const override
  {
    const std::size_t width = std::clamp(TerminalWidth(STDOUT_FILENO).value_or(kWidthOfFiles), kLeastWidth, kMostWidth);
    const auto commands = app->get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
    const auto options = app->get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
    const auto [notes, examples] = SplitFooter(app->get_footer());

    std::string purpose = app->get_description() + (app->get_description().ends_with('.') ? "" : ".");
    std::replace(purpose.begin(), purpose.end(), '\n', ' ');
    std::string text = Wrapped(purpose, width);
    text += "\n\nUsage: " + name;
    std::string arguments;
    for (const CLI::Option* option : options)
    {
      if (!option->get_positional()) continue;
      text += option->get_required() ? " " + option->get_name() : " [" + option->get_name() + "]";
      arguments += Row(*option, width);
    }
    text += commands.empty() ? " [OPTIONS]\n" : " COMMAND [OPTIONS]\n";
    if (!examples.empty()) text += "\nExamples:\n" + examples + (examples.ends_with('\n') ? "" : "\n");
    if (!arguments.empty()) text += "\nArguments:\n" + arguments;

    const auto groups =
        [&text](const auto& members, const std::string& usual, const std::string& title, const auto& row)
    {
      std::vector<std::string> names;
      for (const auto* member : members)
        if (std::find(names.begin(), names.end(), member->get_group()) == names.end())
          names.push_back(member->get_group());
      for (const std::string& group : names)
      {
        text += fmt::format("\n{}:\n", group == usual ? title : group);
        for (const auto* member : members)
          if (member->get_group() == group) text += row(*member);
      }
    };
    groups(commands, CLI::App("").get_group(), "Commands",
           [&](const CLI::App& command) { return Row(command.get_name(), command.get_description(), width); });
    std::vector<const CLI::Option*> named;
    for (const CLI::Option* option : options)
      if (!option->get_positional()) named.push_back(option);
    groups(named, app->get_help_ptr() == nullptr ? "Options" : app->get_help_ptr()->get_group(), "Options",
           [&](const CLI::Option& option) { return Row(option, width); });
    if (!notes.empty()) text += "\n" + Wrapped(notes, width) + (notes.ends_with('\n') ? "" : "\n");
    return text;
  }
};

}  // namespace

std::shared_ptr<CLI::FormatterBase> MakeHelpFormatter() { return std::make_shared<HelpFormatter>(); }

std::pair<std::string, std::string> SplitFooter(const std::string& footer)
{
  for (const std::string head : {"Examples:\n", "Example:\n"})
    if (const std::size_t at = footer.find(head); at != std::string::npos)
      return {footer.substr(0, at), footer.substr(at + head.size())};
  return {footer, ""};
}

std::string Wrapped(const std::string& text, std::size_t width)
{
  std::string wrapped;
  std::string_view rest = text;
  while (!rest.empty())
  {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    const bool is_fixed = line.starts_with(' ');
    while (!is_fixed && line.size() > width)
    {
      std::size_t cut = line.rfind(' ', width);
      if (cut == std::string_view::npos || cut == 0) cut = line.find(' ');
      if (cut == std::string_view::npos) break;
      wrapped.append(line.substr(0, cut)).append("\n");
      line.remove_prefix(cut + 1);
    }
    wrapped.append(line);
    if (end < text.size() && (!rest.empty() || text.ends_with('\n'))) wrapped += '\n';
  }
  return wrapped;
}

}  // namespace swarmanoid
