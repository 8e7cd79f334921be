// `swarmanoid attach`: opens a visualiser on a running experiment; the visualiser replaces this process. With --follow
// it is a child instead, and each start of the experiment has one.
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>

#include "common/configuration/wording.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/program/interrupts.h"
#include "common/run/access/access_grant.h"
#include "common/run/access/cluster_options.h"
#include "launcher/command/renderer_words.h"
#include "launcher/command/run_choice.h"
#include "launcher/command/sub_command.h"
#include "launcher/system/installation.h"
#include "launcher/system/network_namespace.h"
#include "visualiser/renderer_options.h"

namespace swarmanoid
{
namespace
{

constexpr double kWaitOfPages_s = 60;

struct AttachOptions
{
  std::string kind;
  std::vector<std::string> words;       // the experiment's name and the renderer's parameters
  std::vector<std::string> parameters;  // the parameters given as --name value, as "name=value"
  std::optional<double> wait_s;
  bool follow = false;
  WorkerSettings visualiser;
  BusOptions bus;
};

// Replaces this process by the visualiser of a run.
[[noreturn]] void Become(AttachOptions options, const RunChoice& run, const std::vector<std::string>& parameters)
{
  CheckInsecure(run, options.bus);
  options.visualiser.attach = options.kind;
  options.visualiser.experiment = run.experiment;
  options.visualiser.server = run.server;
  options.bus.domain = run.domain;
  UseNetworkOf(run, options.bus);
  std::vector<std::string> command{(std::filesystem::path(ProgramFolder()) / "visualiser").string()};
  for (const std::vector<std::string>& words :
       {WorkerWords(VisualiserOptionTable, options.visualiser), BusWords(options.bus), parameters})
    command.insert(command.end(), words.begin(), words.end());

  std::vector<char*> arguments;
  for (std::string& argument : command) arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  execv(arguments[0], arguments.data());
  throw std::runtime_error(fmt::format("cannot start '{}': {}", command[0], std::strerror(errno)));
}

// The visualiser of a run as a child. Returns its exit code.
int Watch(const AttachOptions& options, const RunChoice& run, const std::vector<std::string>& parameters)
{
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error(fmt::format("cannot start a process: {}", std::strerror(errno)));
  if (child == 0)
  {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    try
    {
      Become(options, run, parameters);
    }
    catch (const std::exception& error)
    {
      PrintError("swarmanoid: {}\n", error.what());
      _exit(kExitProcessFailed);
    }
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR)
    if (Interrupted()) kill(child, SIGTERM);
  return WIFEXITED(status) ? WEXITSTATUS(status) : static_cast<int>(kExitProcessFailed);
}

// Watches each start of the experiment until the user ends it. Returns the exit code of the last visualiser.
int Follow(const AttachOptions& options, RunChoice run, const std::vector<std::string>& parameters)
{
  if (!run.server) throw UsageError("--follow: the run must be on this machine, where its next start can be found");
  CatchInterrupts();
  while (true)
  {
    const int exit_code = Watch(options, run, parameters);
    if (Interrupted() || exit_code == kExitUsage) return exit_code;
    PrintError("the run of {} has ended; waiting for its next start, until Ctrl-C\n", Quoted(run.experiment));
    const auto next = AwaitNextRun(run);
    if (!next) return exit_code;
    run = *next;
    PrintError("{} was started again\n", Quoted(run.experiment));
  }
}

int Attach(AttachOptions& options, const CLI::App& verb)
{
  std::string name;
  std::vector<std::string> parameters = options.parameters;
  for (const std::string& word : options.words)
  {
    if (word.find('=') != std::string::npos)
      parameters.push_back(word);
    else if (name.empty())
      name = word;
    else
      throw UsageError(fmt::format(
          "two names are given, '{}' and '{}'; options of the visualiser are written --name value or name=value", name,
          word));
  }
  try
  {
    ConfigureRenderer(FindRenderer(options.kind), parameters);
  }
  catch (const ConfigurationError& error)
  {
    throw UsageError(error.what());
  }
  const bool domain_given = verb.get_option("--domain")->count() > 0;
  const double wait_s = options.wait_s.value_or(options.kind.starts_with("web") ? kWaitOfPages_s : 0);
  // The visualiser reads the token itself: no word of it stands in a command line.
  const auto token = TokenOfEnvironment();
  const RunChoice run = token ? RunOf(*token, name)
                              : AwaitRun(name, domain_given ? std::optional(options.bus.domain) : std::nullopt, wait_s);

  if (run.server && !options.bus.Spread() && IsInAnotherNetwork(*run.server))
  {
    const char* const why = options.kind.starts_with("web")        ? "no browser could reach a page"
                            : options.kind.starts_with("foxglove") ? "no program could connect"
                            : options.kind.starts_with("ros2")     ? "no node of ROS 2 could hear it"
                                                                   : nullptr;
    if (why != nullptr)
      throw UsageError(
          fmt::format("{} runs in a network of its own (--isolated), where {}", Quoted(run.experiment), why));
  }
  CheckInsecure(run, options.bus);
  if (options.follow) return Follow(options, run, parameters);
  Become(options, run, parameters);
}

void AddAttachCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<AttachOptions>();
  CLI::App* verb = app.add_subcommand("attach", "Look at a running experiment; it is not slowed");
  verb->add_option("KIND", options->kind,
                   "text, image, figure, opengl, ogre, web, ros2 or foxglove, as far as they are part of this build, "
                   "or a library "
                   "with a renderer "
                   "of your own: its path, or its name where SWARMANOID_PLUGIN_PATH holds its folder")
      ->required();
  verb->add_option("WORDS", options->words,
                   "Name of the experiment (may be left out where one runs), and name=value for the visualiser");
  for (const OptionSpec& option : VisualiserOptionTable(options->visualiser))
    if (const std::string& name = option.value.name; name == "output" || name == "hz" || name == "read-only")
      AddOptions(*verb, {option});
  verb->add_option("--wait", options->wait_s,
                   "Seconds for which an experiment that does not run yet is waited for (default: 60 for web, else 0)")
      ->check(CLI::Range(0.0, 1e6));
  verb->add_flag("--follow", options->follow,
                 "Go on with each next start of the experiment on this machine, until Ctrl-C");
  AddOptions(*verb, BusOptionTable(options->bus));
  AddOptionsOfKind(*verb, 0, options->parameters);
  verb->footer(
      "`swarmanoid attach KIND --help` lists the options of that kind too. An attached visualiser never slows the "
      "run.\n"
      "Examples:\n"
      "  swarmanoid attach text                        the experiment that runs on this machine\n"
      "  swarmanoid attach text diffusion_10 --precision 4 --file watched.txt\n"
      "  swarmanoid attach text --csv --hz 1 --follow\n"
      "  swarmanoid attach text diffusion_10 --domain 7 --interface eth0     one on another machine");
  verb->callback([options, verb, &exit_code] { exit_code = Attach(*options, *verb); });
}

const RegisterSubCommand kAttach(9, "attach", AddAttachCommand);

}  // namespace
}  // namespace swarmanoid
