// `swarmanoid control`: sends one request to the space server of a running experiment, and prints the reply. Words,
// options, help and completion follow from common/messages/control_verbs.h.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "common/configuration/configuration_tree.h"
#include "common/configuration/wording.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/messages/control_verbs.h"
#include "common/run/access/access_grant.h"
#include "common/run/access/cluster_options.h"
#include "common/run/run_options.h"
#include "launcher/command/control_words.h"
#include "launcher/command/run_choice.h"
#include "launcher/command/sub_command.h"
#include "launcher/supervision/bus_library.h"

namespace swarmanoid
{
namespace
{

struct ControlOptions
{
  std::vector<std::string> words;
  BusOptions bus;
  bool json = false;
  std::map<std::string, std::optional<std::uint64_t>> parameters;  // the parameters given as --name
  double patience_s = kPatience_s;
};

void PrintJson(const std::string& experiment, const ControlReplyMessage& reply)
{
  const nlohmann::ordered_json json{
      {"experiment", experiment}, {"ok", reply.ok}, {"tick", reply.tick}, {"text", reply.text}};
  fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

int Control(ControlOptions& options, bool domain_given)
{
  std::map<std::string, std::string> given;
  for (const auto& [name, value] : options.parameters)
    if (value) given[name] = std::to_string(*value);
  const ControlWords words = ParseControlWords(options.words, given);
  const auto token = TokenOfEnvironment();
  if (token) UseToken(*token, options.bus);
  const RunChoice run =
      token ? RunOf(*token, words.experiment)
            : ChooseRun(words.experiment, domain_given ? std::optional(options.bus.domain) : std::nullopt);
  // Another terminal may have started the run.
  if (words.experiment.empty() && !token && isatty(STDERR_FILENO) == 1)
    PrintError("control: the run of {} in domain {}\n", Quoted(run.experiment), run.domain);
  CheckInsecure(run, options.bus);
  options.bus.domain = run.domain;
  UseNetworkOf(run, options.bus);
  const RunAnswer answer = LoadBusLibrary().Ask(options.bus, "swarmanoid control", run.experiment, words.order,
                                                PatienceFor(words.order, options.patience_s));
  if (!answer.may_speak)
  {
    PrintError(
        "swarmanoid: no run of experiment {} in domain {} on this machine is of user {}, and no key of it is "
        "given; its owner can steer it, or give you its --key (docs/security.md)\n",
        Quoted(run.experiment), run.domain, UserName());
    return kExitProcessFailed;
  }
  const auto& reply = answer.reply;
  if (!reply)
  {
    fmt::print(
        stderr, "swarmanoid: experiment {} in domain {} does not answer{}{}\n", Quoted(run.experiment), run.domain,
        WhyNoAnswer(answer.status, answer.dropped, options.bus.insecure),
        token ? fmt::format("; the run of {} may have ended, or be on another network", token->grant.Name()) : "");
    return kExitProcessFailed;
  }
  if (options.json) PrintJson(run.experiment, *reply);
  if (!reply->ok)
  {
    PrintError("swarmanoid: {}\n", reply->text);
    return kExitUsage;
  }
  if (options.json) return kExitDone;
  fmt::print("{}: {}\n", run.experiment, reply->text.empty() ? fmt::format("tick {}", reply->tick) : reply->text);
  return kExitDone;
}

// Adds an option for each parameter that is given as --name.
void AddParameterOptions(CLI::App& command, ControlOptions& options)
{
  for (const ControlVerb& verb : ControlVerbs())
    for (const ControlParameter& parameter : verb.parameters)
      if (parameter.is_option)
        AddOptions(command, {{{.name = parameter.name,
                               .type = ParameterType::kInteger,
                               .description = fmt::format("With {}: the {}", verb.name, parameter.meaning),
                               .minimum = parameter.minimum,
                               .maximum = parameter.maximum},
                              &options.parameters[parameter.name],
                              "7"}});
}

void AddControlCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<ControlOptions>();
  CLI::App* verb =
      app.add_subcommand("control",
                         "Pause, resume, step, speed up, slow down, stop or reset a running experiment, "
                         "and\nmove, detach, add or remove entities of it; have its processes change places");
  verb->add_option("WORDS", options->words, "[EXPERIMENT] REQUEST: one of the requests below")->required();
  verb->add_flag("--json", options->json, "For programs: experiment, ok, tick and text of the answer");
  AddParameterOptions(*verb, *options);
  AddOptions(*verb,
             {{{.name = "patience",
                .type = ParameterType::kNumber,
                .unit = "s",
                .description = "How long a run may stand still without an answer; moves of workers: 600 at least",
                .minimum = 0},
               &options->patience_s,
               "60"}});
  AddOptions(*verb, BusOptionTable(options->bus));
  verb->footer("Requests:\n" + ControlVerbHelp(Asker::kMember) +
               "Examples:\n"
               "  swarmanoid control pause\n"
               "  swarmanoid control diffusion_10 step 5\n"
               "  swarmanoid control speed 2\n"
               "  swarmanoid control reset --seed 7\n"
               "  swarmanoid control move fb_0 1.5,2,0\n"
               "  swarmanoid control detach fb_0 1.5,2,0\n"
               "  swarmanoid control add prey 1.5,2,0\n"
               "  swarmanoid control remove prey_0\n"
               "  swarmanoid control move-host 1 beta\n"
               "  swarmanoid control drain alpha\n"
               "  swarmanoid control hosts +1\n"
               "  swarmanoid control diffusion_10 stop --domain 7 --interface eth0    one on another machine");
  verb->callback([options, verb, &exit_code]
                 { exit_code = Control(*options, verb->get_option("--domain")->count() > 0); });
}

const RegisterSubCommand kControl(10, "control", AddControlCommand);

}  // namespace
}  // namespace swarmanoid
