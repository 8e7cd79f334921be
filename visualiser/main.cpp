// The program that shows an experiment through one renderer: one of the experiment's own visualisations, which every
// tick waits for, or one attached from outside, which never slows the run.
#include <CLI/CLI.hpp>

#include <fmt/format.h>
#include <thread>

#include "common/bus/cluster_options.h"
#include "common/bus/control_client.h"
#include "common/bus/replica.h"
#include "common/bus/tick_gate.h"
#include "common/bus/worker_session.h"
#include "common/logging/log.h"
#include "controller_host/controller_host.h"
#include "engine_worker/engine_worker.h"
#include "visualiser/cluster/attached_node.h"
#include "visualiser/cluster/synchronous_node.h"
#include "visualiser/renderer_options.h"
#include "visualiser/request_control.h"

namespace swarmanoid
{
namespace
{

constexpr auto kIdlePeriod = std::chrono::milliseconds(15);
constexpr double kMostViews = 30;  // a second

std::size_t FindVisualisation(const Experiment& experiment, const std::string& id)
{
  std::vector<std::string> known;
  for (std::size_t v = 0; v < experiment.visualisations.size(); ++v)
  {
    if (experiment.visualisations[v].id == id) return v;
    known.push_back(fmt::format("'{}'", experiment.visualisations[v].id));
  }
  throw ConfigurationError(fmt::format("experiment '{}' has no visualisation '{}'; it has {}", experiment.name, id,
                                       known.empty() ? "none" : Joined(known)));
}

void RunSynchronous(WorkerSession& session, const std::string& id, const std::string& output)
{
  Replica replica(session.World(), false);
  const std::size_t number = FindVisualisation(*replica.experiment, id);
  ControlClient client(session.GetBus(), session.World().experiment);
  RequestControl control([&](const ControlRequestMessage& r) { client.Tell(r.verb, r.entity, r.numbers); });
  RemoteMonitor monitor(session.GetBus(), session.World(), true);
  Visualiser visualiser(replica.experiment->visualisations[number], *replica.space, replica.assignment, output,
                        &control, &monitor);
  replica.RestoreSpace();
  SynchronousNode node(session, replica, number, visualiser, control, monitor);
  node.MeetServer();
  session.SayReady();
  try
  {
    const std::optional<BusError> over = session.Follow(kIdlePeriod, [&] { node.Work(); });
    // Films and tables of a run that failed are finished too.
    visualiser.Finish();
    if (over) session.GiveUp(*over);
  }
  catch (const std::exception& error)
  {
    session.GiveUp(error);
  }
}

struct AttachedOptions
{
  RenderConfiguration configuration;
  std::string output = ".";
  double rate = kMostViews;
  bool read_only = false;
};

void RunAttached(WorkerSession& session, const AttachedOptions& options)
{
  Replica replica(session.World(), false);
  ControlClient client(session.GetBus(), session.World().experiment);
  RequestControl control([&](const ControlRequestMessage& r) { client.Tell(r.verb, r.entity, r.numbers); });
  RemoteMonitor monitor(session.GetBus(), session.World(), false);
  Visualiser visualiser(options.configuration, *replica.space, replica.assignment, options.output,
                        options.read_only ? nullptr : &control, &monitor);
  AttachedNode node(session, replica, visualiser, monitor, options.rate);
  session.SayReady();
  const std::optional<BusError> over = session.Follow(kIdlePeriod, [&] { node.Work(); });
  monitor.RunIsOver(over ? over->what() : "");
  // A window stays for those who look at it.
  if (visualiser.IsInteractive() && !node.Terminated())
    while (!visualiser.Idle() && !Interrupted()) std::this_thread::sleep_for(kIdlePeriod);
  visualiser.Finish();
  if (over && !visualiser.IsInteractive()) throw BusError(*over);
}

// The kind after --attach, so that the renderer's own options are known when the words are read.
std::string AttachedKind(int argc, char** argv)
{
  for (int i = 1; i + 1 < argc; ++i)
    if (std::string_view(argv[i]) == "--attach") return argv[i + 1];
  return {};
}

int Run(int argc, char** argv)
{
  RegisterBuiltinEngines();
  RegisterBuiltinDevices();
  RegisterBuiltinRenderers();
  CLI::App app{"Shows a Swarmanoid experiment through one renderer."};
  app.footer(
      "Examples:\n"
      "  visualiser --render text                                the visualisation 'text' of the experiment on this "
      "machine\n"
      "  visualiser --attach text --experiment diffusion_10 --file table.txt\n"
      "  visualiser --attach text --interface eth0               space server on another machine");
  std::string render;
  std::string attach;
  std::string experiment;
  AttachedOptions attached;
  std::vector<std::string> parameters;
  BusOptions bus;
  auto* render_option =
      app.add_option("--render", render, "id of a visualisation of the experiment file; every tick waits for it");
  auto* attach_option =
      app.add_option("--attach", attach, "kind of renderer to attach to a running experiment, which it never slows");
  render_option->excludes(attach_option);
  app.add_option("--experiment", experiment, "name of the experiment; default: the first one that is heard");
  app.add_option("--output", attached.output, "folder for relative output files")->capture_default_str();
  app.add_option("PARAMETERS", parameters, "with --attach: the renderer's parameters, as NAME=VALUE");
  app.add_option("--hz", attached.rate, "with --attach: states a second at most")
      ->check(CLI::Range(0.01, kMostViews))
      ->capture_default_str();
  app.add_flag("--read-only", attached.read_only, "with --attach: nothing can be asked of the run through it");
  AddBusOptions(app, bus);
  if (const std::string kind = AttachedKind(argc, argv); !kind.empty())
    AddRendererOptions(app, FindRenderer(kind), parameters);
  if (const int code = ParseCommandLine(app, argc, argv); code >= 0) return code;
  if (render.empty() == attach.empty())
  {
    fmt::print(stderr, "visualiser: give either --render ID or --attach KIND\n");
    return kExitUsage;
  }

  CatchInterrupts();
  if (!attach.empty())
  {
    attached.configuration = ConfigureRenderer(FindRenderer(attach), parameters);
    WorkerSession session(bus, experiment,
                          fmt::format("attached {} visualiser {}", attached.configuration.id, ProcessId()));
    return session.Work([&] { RunAttached(session, attached); });
  }
  // What people do at a window is for the run's logs.
  OpenLog({.process = "visualiser", .stderr_level = LogLevel::kInfo});
  WorkerSession session(bus, experiment, fmt::format("visualiser '{}'", render));
  return session.Work([&] { RunSynchronous(session, render, attached.output); });
}

}  // namespace
}  // namespace swarmanoid

int main(int argc, char** argv) { return swarmanoid::RunProgram("visualiser", swarmanoid::Run, argc, argv); }
