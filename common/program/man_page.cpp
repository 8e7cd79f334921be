#include "common/program/man_page.h"

#include <fmt/format.h>
#include <cerrno>
#include <cstring>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "common/program/help_text.h"
#include "common/version/version.h"

namespace swarmanoid
{
namespace
{

// Returns the text of a line, in which troff's special characters (commands, hyphens, quotes) are escaped.
std::string Plain(std::string_view text)
{
  std::string plain;
  for (const char c : text)
  {
    if (c == '\\')
      plain += "\\e";
    else if (c == '-')
      plain += "\\-";
    else
      plain += c;
  }
  return plain.starts_with(".") || plain.starts_with("'") ? "\\&" + plain : plain;
}

std::string Upper(std::string text)
{
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::string PlainLines(std::string_view text)
{
  std::string lines;
  while (!text.empty())
  {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines += Plain(text.substr(0, end)) + "\n";
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::string Unfilled(std::string_view text) { return text.empty() ? "" : ".nf\n" + PlainLines(text) + ".fi\n"; }

std::vector<const CLI::App*> CommandsOf(const CLI::App& app)
{
  return app.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::vector<const CLI::Option*> OptionsOf(const CLI::App& app)
{
  return app.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

std::string Synopsis(const CLI::App& app, const std::string& name)
{
  std::string text = ".B " + Plain(name) + "\n";
  if (!CommandsOf(app).empty()) return text + ".I COMMAND\n.RI [ options ]\n";
  for (const CLI::Option* option : OptionsOf(app))
  {
    if (!option->get_positional()) continue;
    const std::string word = Plain(option->get_name());
    text += option->get_required() ? ".I " + word + "\n" : ".RI [ " + word + " ]\n";
  }
  return text + ".RI [ options ]\n";
}

std::string Options(const CLI::App& app)
{
  std::string text;
  for (const CLI::Option* option : OptionsOf(app))
  {
    const std::string type = option->get_type_name();
    const std::string name = option->get_positional() ? option->get_name() : option->get_name(false, true);
    text += ".TP\n.B " + Plain(name) + (type.empty() || option->get_positional() ? "" : " \\fI" + Plain(type) + "\\fR");
    std::string description = option->get_description();
    if (!description.empty() && !description.ends_with('.')) description += '.';
    text += "\n" + PlainLines(description);
    if (const std::string standard = option->get_default_str(); !standard.empty())
      text += Plain("Default: " + standard) + ".\n";
  }
  return text;
}

// Returns the text of a sub-command, or of the whole page without its head.
std::string Body(const CLI::App& app, const std::string& name, bool whole)
{
  const auto [notes, examples] = SplitFooter(app.get_footer());
  const auto section = [&](const std::string& title, const std::string& text)
  {
    if (text.empty()) return std::string();
    return whole ? ".SH " + title + "\n" + text : text;
  };
  std::string text;
  text += section("SYNOPSIS", Synopsis(app, name));
  text += section("DESCRIPTION", (whole ? "" : ".PP\n") + PlainLines(app.get_description() + "."));
  text += section("OPTIONS", Options(app));
  text += section("NOTES", Unfilled(notes));
  text += section("EXAMPLES", Unfilled(examples));
  return text;
}

// Returns the page of the program, or of one of its commands.
std::string Page(const CLI::App& program, const CLI::App* command)
{
  const CLI::App& app = command == nullptr ? program : *command;
  const std::string& own = program.get_name();
  const std::string title = command == nullptr ? own : own + "-" + app.get_name();
  const std::string name = command == nullptr ? own : own + " " + app.get_name();
  std::string brief = app.get_description();
  std::ranges::replace(brief, '\n', ' ');
  std::string text = fmt::format(".TH {} 1 \"\" \"Swarmanoid {}\" \"Swarmanoid\"\n.SH NAME\n{} \\- {}\n", Upper(title),
                                 Version(), Plain(title), Plain(brief));
  text += Body(app, name, true);
  std::vector<std::string> others;
  if (command != nullptr) others.push_back(own);
  const auto commands = CommandsOf(app);
  if (!commands.empty()) text += ".SH COMMANDS\n";
  for (const CLI::App* each : commands)
  {
    if (command == nullptr)
    {
      text += ".TP\n.B " + Plain(each->get_name()) + "\n" + PlainLines(each->get_description());
      others.push_back(title + "-" + each->get_name());
    }
    else
    {
      text += ".SS " + Plain(each->get_name()) + "\n" + Body(*each, name + " " + each->get_name(), false);
    }
  }
  text += ".SH SEE ALSO\n";
  for (const std::string& other : others) text += ".BR " + Plain(other) + " (1),\n";
  return text + "the pages in share/doc/swarmanoid\n";
}

void Write(const std::string& path, const std::string& text)
{
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw std::runtime_error("cannot write '" + path + "': " + std::strerror(errno));
}

}  // namespace

void WriteManPages(const CLI::App& program, const std::string& folder)
{
  const std::string start = folder + "/" + program.get_name();
  Write(start + ".1", Page(program, nullptr));
  for (const CLI::App* command : CommandsOf(program))
    Write(start + "-" + command->get_name() + ".1", Page(program, command));
}

}  // namespace swarmanoid
