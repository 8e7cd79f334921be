// `swarmanoid control`: asks the space server of a running experiment to pause, go on, step, change speed, stop or move
// an entity.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "common/bus/cluster_options.h"
#include "common/bus/control_client.h"
#include "common/configuration/configuration_tree.h"
#include "common/configuration/wording.h"
#include "launcher/commands.h"
#include "launcher/control_request.h"
#include "launcher/exit_codes.h"
#include "launcher/run_choice.h"

namespace swarmanoid
{
namespace
{

constexpr double kPatience_s = 5;

struct ControlOptions
{
  std::vector<std::string> words;
  BusOptions bus;
};

int Control(ControlOptions& options, bool domain_given)
{
  const ControlRequest request = ParseControlRequest(options.words);
  const RunChoice run = ChooseRun(request.experiment, domain_given ? std::optional(options.bus.domain) : std::nullopt);
  options.bus.domain = run.domain;
  Bus bus(options.bus, "swarmanoid control");
  ControlClient client(bus, run.experiment);
  const auto reply = client.Ask(request.verb, request.entity, request.numbers, kPatience_s);
  if (!reply)
  {
    fmt::print(stderr, "swarmanoid: experiment {} in domain {} does not answer\n", Quoted(run.experiment), run.domain);
    return kProcessFailed;
  }
  if (!reply->ok)
  {
    fmt::print(stderr, "swarmanoid: {}\n", reply->text);
    return kUsage;
  }
  fmt::print("{}: {}\n", run.experiment, reply->text.empty() ? fmt::format("tick {}", reply->tick) : reply->text);
  return kDone;
}

}  // namespace

void AddControlCommand(CLI::App& app, int& exit_code)
{
  auto options = std::make_shared<ControlOptions>();
  CLI::App* verb =
      app.add_subcommand("control", "Pause, resume, step, speed up, slow down or stop a running experiment");
  verb->add_option("WORDS", options->words,
                   "[EXPERIMENT] pause | resume | step [N] | speed F | stop | move ENTITY X,Y,Z[,A,B,G]")
      ->required();
  AddBusOptions(*verb, options->bus);
  verb->footer(
      "speed is a multiple of real time, 0 is as fast as possible. Positions are in metres, angles in degrees.\n"
      "Examples:\n"
      "  swarmanoid control pause\n"
      "  swarmanoid control diffusion_10 step 5\n"
      "  swarmanoid control speed 2\n"
      "  swarmanoid control move fb_0 1.5,2,0\n"
      "  swarmanoid control diffusion_10 stop --domain 7 --interface eth0    one on another machine");
  verb->callback([options, verb, &exit_code]
                 { exit_code = Control(*options, verb->get_option("--domain")->count() > 0); });
}

}  // namespace swarmanoid
