// The program that shows an experiment through one renderer: one of the experiment's own visualisations, which every
// tick waits for, or one attached from outside, which never slows the run.
#include <fmt/format.h>
#include <thread>

#include "common/bus/membership/control_client.h"
#include "common/bus/membership/recovery.h"
#include "common/bus/membership/tick_gate.h"
#include "common/bus/membership/worker_program.h"
#include "common/bus/membership/worker_session.h"
#include "common/bus/membership/worker_world.h"
#include "common/configuration/output_file.h"
#include "common/logging/log.h"
#include "common/plugin_descriptions/describe_builtins.h"
#include "common/program/interrupts.h"
#include "common/program/usage_error.h"
#include "common/run/access/access_grant.h"
#include "visualiser/cluster/attached_node.h"
#include "visualiser/cluster/synchronous_node.h"
#include "visualiser/control_by_requests.h"
#include "visualiser/renderer_options.h"

namespace swarmanoid
{
namespace
{

constexpr auto kIdlePeriod = std::chrono::milliseconds(15);

// Returns the first tick to draw. A process that replaces another one draws all earlier ticks again, so that its files
// equal those of an undisturbed run. A window or page skips them.
std::uint64_t Begin(WorkerSession& session, WorkerWorld& replica, Visualiser& visualiser)
{
  if (!session.TakesAPlace())
  {
    replica.RestoreSpace();
    return replica.FirstTick();
  }
  RecoverySteps steps;
  steps.begin = [&] { replica.RestoreSpace(); };
  if (!visualiser.IsInteractive()) steps.step = [&](const TickRecord&, const TickRecord*) { visualiser.Draw(); };
  return Recover(session, replica, steps);
}

void Send(const ControlOrder& order, ControlClient& client, RemoteMonitor& monitor)
{
  const std::string error = client.Send(order);
  if (!error.empty()) monitor.NoteRefusal(error);
}

void RunSynchronous(WorkerSession& session, const std::string& id, const std::string& output)
{
  WorkerWorld replica(session.World(), false);
  const std::vector<RenderConfiguration>& visualisations = replica.experiment->visualisations;
  const std::size_t number = NumberOf(*replica.experiment, visualisations, "visualisation", id);
  ControlClient client(session.GetBus(), session.World().experiment, session.World().run);
  RemoteMonitor monitor(session.GetBus(), session.World(), true);
  ControlByRequests control([&](const ControlOrder& order) { Send(order, client, monitor); });
  Visualiser visualiser(visualisations[number], *replica.space, replica.assignment, output, &control, &monitor);
  SynchronousNode node(session, replica, number, visualiser, control, monitor, Begin(session, replica, visualiser));
  node.WaitForServer();
  session.ReportReady();
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

// Shows the run until it ends or the user closes the renderer. Returns true if the run began again with another seed,
// in which case entities may have other start positions.
bool Show(WorkerSession& session, const WorkerSettings& settings, const RenderConfiguration& configuration)
{
  WorkerWorld replica(session.World(), false);
  ControlClient client(session.GetBus(), session.World().experiment, session.World().run);
  RemoteMonitor monitor(session.GetBus(), session.World(), false);
  ControlByRequests control([&](const ControlOrder& order) { Send(order, client, monitor); });
  Visualiser visualiser(configuration, *replica.space, replica.assignment, settings.output,
                        settings.read_only ? nullptr : &control, &monitor);
  AttachedNode node(session, replica, visualiser, monitor, settings.rate);
  session.ReportReady();
  std::optional<BusError> over;
  while ((over = session.Follow(kIdlePeriod, [&] { node.Work(); })))
  {
    monitor.ServerIsLost();
    const std::uint64_t seed = session.World().seed;
    if (!session.FollowNext([&] { return visualiser.Idle(); })) break;
    if (session.World().seed != seed)
    {
      visualiser.Finish();
      return true;
    }
    monitor.FollowRun(session.World().run);
    node.FollowRun(session.World().run);
    client.FollowRun(session.World().run);
  }
  if (over && session.RunHasEnded())
  {
    // The last state may have come with the word that it is the last.
    node.Work();
    over.reset();
  }
  monitor.RunIsOver(over ? over->what() : "");
  // A window stays for those who look at it.
  if (visualiser.IsInteractive() && !node.Terminated())
    while (!visualiser.Idle() && !Interrupted()) std::this_thread::sleep_for(kIdlePeriod);
  visualiser.Finish();
  if (over && !visualiser.IsInteractive()) throw BusError(*over);
  return false;
}

void RunAttached(WorkerSession& session, const WorkerSettings& settings, const RenderConfiguration& configuration)
{
  while (Show(session, settings, configuration))
  {
  }
}

// The kind after --attach, so that the renderer's own options are known when the words are read.
std::string AttachedKind(int argc, char** argv)
{
  for (int i = 1; i + 1 < argc; ++i)
    if (std::string_view(argv[i]) == "--attach") return argv[i + 1];
  return {};
}

// Uses the token of a grant if the environment has one. Its holder observes that run; only an operator may also control
// it.
void UseTokenOfEnvironment(WorkerSettings& settings, BusOptions& bus)
{
  const auto token = TokenOfEnvironment();
  if (!token) return;
  UseToken(*token, bus);
  settings.experiment = token->experiment;
  settings.read_only |= token->grant.role != GrantRole::kOperator;
}

int Run(WorkerSettings settings, const std::vector<std::string>& parameters, BusOptions bus)
{
  if (settings.render.empty() == settings.attach.empty())
    throw UsageError("give either --render ID or --attach KIND; for example --attach text");
  if (!settings.attach.empty())
  {
    const RenderConfiguration configuration = ConfigureRenderer(FindRenderer(settings.attach), parameters);
    UseTokenOfEnvironment(settings, bus);
    LetUserNameFiles();
    WorkerSession session(bus, settings.experiment,
                          fmt::format("attached {} visualiser {}", configuration.id, ProcessId()), settings.server);
    session.ObserveOnly();
    return session.Work([&] { RunAttached(session, settings, configuration); });
  }
  // Actions of users at a window go to the run's logs.
  OpenLog({.process = "visualiser", .stderr_level = LogLevel::kInfo});
  WorkerSession session(bus, settings.experiment, fmt::format("visualiser '{}'", settings.render), {},
                        settings.incarnation, settings.machine);
  return session.Work([&] { RunSynchronous(session, settings.render, settings.output); });
}

}  // namespace
}  // namespace swarmanoid

int main(int count, char** arguments)
{
  using namespace swarmanoid;

  std::vector<std::string> parameters;
  const ProgramDescription program{
      "visualiser",
      "Shows a Swarmanoid experiment through one renderer.",
      "Examples:\n"
      "  visualiser --render text                                the visualisation 'text' of the experiment on this "
      "machine\n"
      "  visualiser --attach text --experiment diffusion_10 --file table.txt\n"
      "  visualiser --attach text --interface eth0               space server on another machine",
      []
      {
        DescribeBuiltins();
        RegisterBuiltinRenderers();
      },
      true,
      true};
  return RunWorker(
      program, count, arguments, VisualiserOptionTable,
      [&](const WorkerSettings& settings, const BusOptions& bus) { return Run(settings, parameters, bus); },
      [&](CLI::App& app) { AddParametersOf(AttachedKind(count, arguments), app, parameters); });
}
