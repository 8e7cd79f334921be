// The program that shows an experiment through one renderer: one of the experiment's own visualisations, which every
// tick waits for, or one attached from outside, which never slows the run.
#include <CLI/CLI.hpp>

#include <fmt/format.h>
#include <filesystem>
#include <mutex>

#include "common/bus/cluster_options.h"
#include "common/bus/control_client.h"
#include "common/bus/replica.h"
#include "common/bus/tick_gate.h"
#include "common/bus/worker_session.h"
#include "common/plugins/catalogue.h"
#include "controller_host/controller_host.h"
#include "engine_worker/engine_worker.h"
#include "visualiser/visualiser.h"

namespace swarmanoid
{
namespace
{

constexpr auto kIdlePeriod = std::chrono::milliseconds(20);

// A renderer's wishes, sent to the space server.
class RemoteControl : public ExperimentControl
{
public:
  RemoteControl(Bus& bus, const std::string& experiment) : client_(bus, experiment) {}

  void Pause() override { client_.Tell("pause", "", {}); }
  void Resume() override { client_.Tell("resume", "", {}); }
  void Step(unsigned ticks) override { client_.Tell("step", "", {static_cast<double>(ticks)}); }
  void SetSpeed(double real_time_factor) override { client_.Tell("speed", "", {real_time_factor}); }
  void MoveEntity(const std::string& id, const Pose& pose) override
  {
    constexpr double kDegrees = 57.29577951308232;
    const EulerAngles angles = EulerFromQuaternion(pose.orientation);
    client_.Tell("move", id,
                 {pose.position.x(), pose.position.y(), pose.position.z(), angles.alpha * kDegrees,
                  angles.beta * kDegrees, angles.gamma * kDegrees});
  }

  void Stop() override { client_.Tell("stop", "", {}); }

private:
  ControlClient client_;
};

// Draws every tick and says so. The main thread draws; a thread of the bus brings the states.
class SynchronousNode
{
public:
  SynchronousNode(WorkerSession& session, Replica& replica, std::size_t number, Visualiser& visualiser)
      : session_(session),
        replica_(replica),
        number_(static_cast<std::uint32_t>(number)),
        visualiser_(visualiser),
        next_(replica.FirstTick()),
        drawn_(session.GetBus(), session.Scope(kDrawnCapacity, 1)),
        states_in_(session.GetBus(), session.Scope(StateCapacity(*replica.space), 1),
                   {[this](const MessageHeader& header) { return PlaceOfState(header); },
                    [this](const MessageHeader& header, SpaceState& state) { StateArrived(header, state); }})
  {
  }

  void MeetServer()
  {
    session_.WaitUntil([this] { return states_in_.Writers() >= 1 && drawn_.Readers() >= 1; },
                       [] { return std::string("the space server's topics"); });
  }

  // Called in the main thread when a state has come, and now and then.
  void Work()
  {
    std::unique_lock lock(mutex_);
    if (!fresh_)
    {
      const bool finished = finished_;
      lock.unlock();
      if (!finished) answer_.terminate |= visualiser_.Idle();
      return;
    }
    replica_.space->Apply(state_);
    const bool last = state_.last;
    const std::uint64_t tick = state_.tick;
    lock.unlock();

    answer_.terminate |= visualiser_.Draw();
    lock.lock();
    fresh_ = false;
    next_ = tick + 1;
    session_.SetTick(tick);
    finished_ |= last;
    drawn_.Write(session_.Header(tick, number_), answer_);
    if (last) session_.Finish(tick);
  }

private:
  SpaceState* PlaceOfState(const MessageHeader& header)
  {
    if (header.run != session_.World().run) return nullptr;
    const std::lock_guard lock(mutex_);
    if (header.tick > next_)
    {
      session_.Fail(next_, fmt::format("the state of the space server is of tick {}, but tick {} has to come first",
                                       header.tick, next_));
      return nullptr;
    }
    return header.tick == next_ && !fresh_ ? &state_ : &repeated_;
  }

  void StateArrived(const MessageHeader& header, SpaceState& state)
  {
    const std::lock_guard lock(mutex_);
    if (&state == &state_)
    {
      fresh_ = true;
      session_.Notify();
      return;
    }
    if (header.tick + 1 != next_ || fresh_ || finished_) return;
    // The tick that was drawn last comes again: it is the end of the run, or our answer was lost.
    if (state.last)
    {
      finished_ = true;
      session_.Finish(header.tick);
    }
    else
      drawn_.Write(session_.Header(header.tick, number_), answer_);
  }

  WorkerSession& session_;
  Replica& replica_;
  std::uint32_t number_;
  Visualiser& visualiser_;
  std::mutex mutex_;  // of what follows, except answer_.terminate while fresh_
  SpaceState state_;
  SpaceState repeated_;
  bool fresh_ = false;  // state_ is to be drawn
  bool finished_ = false;
  std::uint64_t next_;
  DrawnMessage answer_;
  HotPublisher<DrawnMessage> drawn_;
  HotSubscription<SpaceState> states_in_;
};

// Draws the newest state whenever it has time.
class AttachedNode
{
public:
  AttachedNode(WorkerSession& session, Replica& replica, Visualiser& visualiser)
      : session_(session),
        replica_(replica),
        visualiser_(visualiser),
        views_in_(session.GetBus(), session.World().experiment,
                  [this](const ViewMessage& view)
                  {
                    if (view.run != session_.World().run) return;
                    const std::lock_guard lock(mutex_);
                    snapshot_ = view.snapshot;
                    fresh_ = true;
                    session_.Notify();
                  })
  {
  }

  void Work()
  {
    std::unique_lock lock(mutex_);
    const bool draw = fresh_;
    fresh_ = false;
    if (draw) replica_.space->Apply(snapshot_);
    const bool last = draw && snapshot_.last;
    lock.unlock();
    const bool terminate = draw ? visualiser_.Draw() : visualiser_.Idle();
    if (terminate || last) session_.Finish(replica_.space->GetTick());
  }

private:
  WorkerSession& session_;
  Replica& replica_;
  Visualiser& visualiser_;
  std::mutex mutex_;
  SpaceSnapshot snapshot_;
  bool fresh_ = false;
  Subscription<ViewMessage> views_in_;
};

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

// The configuration of a renderer from "text" or "text_render" and parameters written as name=value.
RenderConfiguration AttachedConfiguration(const std::string& kind, const std::vector<std::string>& parameters)
{
  const PluginCatalogue& catalogue = PluginCatalogue::Instance();
  std::string tag = kind;
  if (catalogue.Find(PluginKind::kRenderer, tag) == nullptr) tag += "_render";
  const PluginDescription* description = catalogue.Find(PluginKind::kRenderer, tag);
  if (description == nullptr)
    throw ConfigurationError(fmt::format("no renderer is registered as '{}'; there are {}", kind,
                                         Joined(catalogue.Labels(PluginKind::kRenderer))));

  auto node = std::make_shared<ConfigurationNode>();
  node->name = tag;
  for (const std::string& parameter : parameters)
  {
    const std::size_t equals = parameter.find('=');
    const std::string name = parameter.substr(0, equals);
    std::vector<std::string> known;
    for (const ParameterSpec& spec : description->parameters) known.push_back(spec.name);
    if (equals == std::string::npos || std::find(known.begin(), known.end(), name) == known.end())
      throw ConfigurationError(fmt::format("'{}' is no parameter of {}; write NAME=VALUE with one of {}", parameter,
                                           tag, known.empty() ? "none" : Joined(known)));
    node->attributes.push_back({name, parameter.substr(equals + 1), {}});
  }
  RenderConfiguration configuration;
  configuration.tag = tag;
  configuration.id = kind;
  configuration.tree = TConfigurationTree(std::move(node));
  return configuration;
}

void RunSynchronous(WorkerSession& session, const std::string& id, const std::string& output)
{
  Replica replica(session.World(), false);
  const std::size_t number = FindVisualisation(*replica.experiment, id);
  RemoteControl control(session.GetBus(), session.World().experiment);
  Visualiser visualiser(replica.experiment->visualisations[number], *replica.space, replica.assignment, output,
                        &control, nullptr);
  replica.RestoreSpace();
  SynchronousNode node(session, replica, number, visualiser);
  node.MeetServer();
  session.SayReady();
  session.Wait(kIdlePeriod,
               [&]
               {
                 node.Work();
                 return std::nullopt;
               });
  visualiser.Finish();
}

void RunAttached(WorkerSession& session, const RenderConfiguration& configuration, const std::string& output)
{
  Replica replica(session.World(), false);
  RemoteControl control(session.GetBus(), session.World().experiment);
  Visualiser visualiser(configuration, *replica.space, replica.assignment, output, &control, nullptr);
  AttachedNode node(session, replica, visualiser);
  session.SayReady();
  session.Wait(kIdlePeriod,
               [&]
               {
                 node.Work();
                 return std::nullopt;
               });
  visualiser.Finish();
}

int Run(int argc, char** argv)
{
  CLI::App app{"Shows a Swarmanoid experiment through one renderer."};
  app.footer(
      "Examples:\n"
      "  visualiser --render text                                the visualisation 'text' of the experiment on this "
      "machine\n"
      "  visualiser --attach text --experiment diffusion_10 file=table.txt\n"
      "  visualiser --attach text --interface eth0               space server on another machine");
  std::string render;
  std::string attach;
  std::string experiment;
  std::string output = ".";
  std::vector<std::string> parameters;
  BusOptions bus;
  auto* render_option =
      app.add_option("--render", render, "id of a visualisation of the experiment file; every tick waits for it");
  auto* attach_option =
      app.add_option("--attach", attach, "kind of renderer to attach to a running experiment, which it never slows");
  render_option->excludes(attach_option);
  app.add_option("--experiment", experiment, "name of the experiment; default: the first one that is heard");
  app.add_option("--output", output, "folder for relative output files")->capture_default_str();
  app.add_option("PARAMETERS", parameters, "with --attach: the renderer's parameters, as NAME=VALUE");
  AddBusOptions(app, bus);
  if (const int code = ParseCommandLine(app, argc, argv); code >= 0) return code;
  if (render.empty() == attach.empty())
  {
    fmt::print(stderr, "visualiser: give either --render ID or --attach KIND\n");
    return kExitUsage;
  }

  CatchInterrupts();
  RegisterBuiltinEngines();
  RegisterBuiltinDevices();
  RegisterBuiltinRenderers();
  if (!attach.empty())
  {
    const RenderConfiguration configuration = AttachedConfiguration(attach, parameters);
    WorkerSession session(bus, experiment, fmt::format("attached visualiser {}", ProcessId()));
    return session.Work([&] { RunAttached(session, configuration, output); });
  }
  WorkerSession session(bus, experiment, fmt::format("visualiser '{}'", render));
  return session.Work([&] { RunSynchronous(session, render, output); });
}

}  // namespace
}  // namespace swarmanoid

int main(int argc, char** argv) { return swarmanoid::RunProgram("visualiser", swarmanoid::Run, argc, argv); }
