// `swarmanoid control`: asks the space server of a running experiment to pause, go on, step, change speed, stop, begin
// again, or to
// move, detach, add or remove an entity, or to have processes change places.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "common/activity/exit_codes.h"
#include "common/activity/print_error.h"
#include "common/bus/membership/cluster_options.h"
#include "common/bus/membership/control_client.h"
#include "common/bus/security/access_grant.h"
#include "common/configuration/configuration_tree.h"
#include "common/configuration/wording.h"
#include "common/messages/control_request.h"
#include "common/run/run_settings.h"
#include "launcher/command/sub_command.h"
#include "launcher/control_words.h"
#include "launcher/run_choice.h"

namespace swarmanoid
{
namespace
{

constexpr double kPatience_s = 5;
// Who takes the place of a worker does all ticks again, if that one could not be saved.
constexpr double kPatienceWithMoves_s = 600;

struct ControlOptions
{
  std::vector<std::string> words;
  BusOptions bus;
  bool json = false;
  std::optional<std::uint64_t> seed;
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
  const ControlRequest request = ParseControlRequest(options.words, options.seed);
  const auto token = TokenOfEnvironment();
  if (token) UseToken(*token, options.bus);
  const RunChoice run =
      token ? RunOf(*token, request.experiment)
            : ChooseRun(request.experiment, domain_given ? std::optional(options.bus.domain) : std::nullopt);
  CheckInsecure(run, options.bus);
  options.bus.domain = run.domain;
  UseNetworkOf(run, options.bus);
  Bus bus(options.bus, "swarmanoid control");
  if (!bus.MaySpeakTo(run.experiment))
  {
    PrintError(
        "swarmanoid: no run of experiment {} in domain {} on this machine is of user {}, and no key of it is "
        "given; whoever started it can steer it, or give you its --key (docs/security.md)\n",
        Quoted(run.experiment), run.domain, UserName());
    return kExitProcessFailed;
  }
  ControlClient client(bus, run.experiment);
  const auto reply = client.Ask(request.verb, request.entity, request.numbers,
                                std::max(options.patience_s, IsWorkerMove(request.verb) ? kPatienceWithMoves_s : 0));
  if (!reply)
  {
    fmt::print(
        stderr, "swarmanoid: experiment {} in domain {} does not answer{}{}\n", Quoted(run.experiment), run.domain,
        WhyNoAnswer(client.LatestStatus(), bus.Dropped(), options.bus.insecure),
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

void AddControlCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<ControlOptions>();
  CLI::App* verb =
      app.add_subcommand("control",
                         "Pause, resume, step, speed up, slow down, stop or reset a running experiment, and\n"
                         "move, detach, add or remove entities of it; have its processes change places");
  verb->add_option("WORDS", options->words,
                   "[EXPERIMENT] pause | resume | step [N] | speed F | stop | reset | move ENTITY X,Y,Z[,A,B,G] |\n"
                   "detach ENTITY X,Y,Z[,A,B,G] | add ENTITY X,Y,Z[,A,B,G] | remove ENTITY |\n"
                   "move-host N [MACHINE] | move-engine ID [MACHINE] | drain MACHINE | hosts +N|-N [MACHINE] |\n"
                   "hosts again | machines")
      ->required();
  verb->add_flag("--json", options->json, "For programs: experiment, ok, tick and text of the answer");
  AddOptions(*verb,
             {{{.name = "seed",
                .type = ParameterType::kInteger,
                .description = "With reset: the seed of the run that begins; otherwise that of this one",
                .minimum = 0,
                .maximum = kLargestSeed},
               &options->seed,
               "7"},
              {{.name = "patience",
                .type = ParameterType::kNumber,
                .unit = "s",
                .description = "How long a run may stand still without an answer; moves of workers: 600 at least",
                .minimum = 0},
               &options->patience_s,
               "60"}});
  AddOptions(*verb, BusOptionTable(options->bus));
  verb->footer(
      "speed is a multiple of real time, 0 is as fast as possible. Positions are in metres, angles in degrees.\n"
      "reset ends the run, and begins it again at tick 0 in a folder of its own.\n"
      "move takes along all that hold the entity or are held with it, detach moves it alone and ends these holds.\n"
      "add takes an entity that was removed, or the id of a <reserve>.\n"
      "move-host and move-engine have another process take the place of a controller host or engine, on a machine of\n"
      "the file of --hosts, or on \"here\", that of the launcher;\n"
      "drain has all workers of a machine leave it; hosts has the robots shared out by where they are among more\n"
      "controller hosts, or fewer, or again among as many; machines tells which there are, and who is there.\n"
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

const RegisterSubCommand kControl(8, AddControlCommand);

}  // namespace
}  // namespace swarmanoid
