// `swarmanoid attach`: opens a visualiser on a running experiment, in the place of this process.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>

#include "common/bus/cluster_options.h"
#include "common/configuration/wording.h"
#include "common/plugins/catalogue.h"
#include "launcher/commands.h"
#include "launcher/installation.h"
#include "launcher/run_choice.h"

namespace swarmanoid
{
namespace
{

struct AttachOptions
{
  std::string kind;
  std::vector<std::string> words;  // the experiment's name and the renderer's parameters
  std::string output;
  BusOptions bus;
};

// "text" for the renderer text_render.
std::vector<std::string> Kinds()
{
  const std::string ending = "_render";
  std::vector<std::string> kinds;
  for (const std::string& label : PluginCatalogue::Instance().Labels(PluginKind::kRenderer))
    kinds.push_back(label.ends_with(ending) ? label.substr(0, label.size() - ending.size()) : label);
  return kinds;
}

void Attach(const AttachOptions& options, const CLI::App& verb)
{
  RegisterBuiltins();
  const std::vector<std::string> kinds = Kinds();
  if (std::find(kinds.begin(), kinds.end(), options.kind) == kinds.end())
    throw UsageError(fmt::format("there is no visualiser {}; this build has {}{}", Quoted(options.kind), Listed(kinds),
                                 DidYouMean(options.kind, kinds)));

  std::string name;
  std::vector<std::string> parameters;
  for (const std::string& word : options.words)
  {
    if (word.find('=') != std::string::npos)
      parameters.push_back(word);
    else if (name.empty())
      name = word;
    else
      throw UsageError(fmt::format(
          "two names are given, '{}' and '{}'; options of the visualiser are written name=value", name, word));
  }
  const bool domain_given = verb.get_option("--domain")->count() > 0;
  const RunChoice run = ChooseRun(name, domain_given ? std::optional(options.bus.domain) : std::nullopt);

  std::vector<std::string> command{(std::filesystem::path(ProgramFolder()) / "visualiser").string(),
                                   "--attach",
                                   options.kind,
                                   "--experiment",
                                   run.experiment,
                                   "--domain",
                                   std::to_string(run.domain)};
  for (const CLI::Option* option : verb.get_options())
  {
    const std::string option_name = option->get_name();
    if (!option_name.starts_with("--") || option_name == "--domain" || option_name == "--help") continue;
    for (const std::string& value : option->results()) command.insert(command.end(), {option_name, value});
  }
  command.insert(command.end(), parameters.begin(), parameters.end());

  std::vector<char*> arguments;
  for (std::string& argument : command) arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  execv(arguments[0], arguments.data());
  throw std::runtime_error(fmt::format("cannot start '{}': {}", command[0], std::strerror(errno)));
}

}  // namespace

void AddAttachCommand(CLI::App& app, int&)
{
  auto options = std::make_shared<AttachOptions>();
  CLI::App* verb = app.add_subcommand("attach", "Look at a running experiment; it is not slowed");
  verb->add_option("KIND", options->kind, "text, image, opengl, ogre or web, as far as they are part of this build")
      ->required();
  verb->add_option("WORDS", options->words,
                   "Name of the experiment (may be left out where one runs), and name=value for the visualiser");
  verb->add_option("--output", options->output, "Folder for the visualiser's files (default: this one)");
  AddBusOptions(*verb, options->bus);
  verb->footer(
      "Examples:\n"
      "  swarmanoid attach text                        the experiment that runs on this machine\n"
      "  swarmanoid attach text diffusion_10 precision=4 file=watched.txt\n"
      "  swarmanoid attach text diffusion_10 --domain 7 --interface eth0     one on another machine");
  verb->callback([options, verb] { Attach(*options, *verb); });
}

}  // namespace swarmanoid
