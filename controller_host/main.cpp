// The program that runs the controllers of some robots of an experiment: the controller host's role at the bus.
#include <CLI/CLI.hpp>

#include <fmt/format.h>
#include <array>
#include <mutex>

#include "common/bus/cluster_options.h"
#include "common/bus/replica.h"
#include "common/bus/saved_states.h"
#include "common/bus/stall_watch.h"
#include "common/bus/tick_gate.h"
#include "common/bus/worker_session.h"
#include "controller_host/cluster/robot_watch.h"
#include "controller_host/controller_host.h"
#include "engine_worker/engine_worker.h"
#include "visualiser/render.h"

namespace swarmanoid
{
namespace
{

// Steps the controllers in the threads of the bus, as soon as the state and all sensor frames of a tick are here.
class HostNode
{
public:
  HostNode(WorkerSession& session, Replica& replica, std::size_t host)
      : session_(session),
        replica_(replica),
        host_(static_cast<std::uint32_t>(host)),
        role_(*replica.space, replica.assignment, host),
        saved_(session, HostName(host), role_),
        gate_(Parts(*replica.experiment, role_.Layout()), replica.FirstTick()),
        commands_(session.GetBus(), session.Scope(CommandsCapacity(*replica.space, replica.assignment), 1)),
        watch_robots_(session, role_, host_, mutex_)
  {
    const auto& from = role_.Layout().frames_from;
    for (auto& frames : frames_) frames.resize(from.size());
    frames_here_.resize(from.size());
    replica.Restore(HostName(host), role_);
    // Nobody sends the frames of the first tick: there are none, or the engines saved them first of all.
    for (std::size_t k = 0; k < from.size(); ++k)
    {
      gate_.Arrived(1 + k, replica.FirstTick());
      if (!replica.checkpoint) continue;
      ByteReader state(replica.checkpoint->StateOf(EngineName(*replica.experiment, from[k])));
      frames_[replica.FirstTick() % 2][k].values = state.GetArray<double>();
    }
    if (!from.empty())
      frames_in_.emplace(session.GetBus(), session.Scope(FrameCapacity(replica.assignment), FrameWriters()),
                         HotSubscription<SensorFrame>::Handler{
                             [this](const MessageHeader& header) { return PlaceOfFrame(header); },
                             [this](const MessageHeader& header, SensorFrame&) { FrameArrived(header); }});
    states_in_.emplace(session.GetBus(), session.Scope(StateCapacity(*replica.space), 1),
                       HotSubscription<SpaceState>::Handler{
                           [this](const MessageHeader& header) { return PlaceOfState(header); },
                           [this](const MessageHeader& header, SpaceState& state) { StateArrived(header, state); }});
  }

  // Until all whom this host hears or speaks to are there.
  void MeetOthers()
  {
    unsigned readers = 0;
    for (const EngineLayout& engine : replica_.assignment.engines) readers += engine.commands_from.empty() ? 0 : 1;
    for (const HostLayout& host : replica_.assignment.hosts)
      if (ServerHears(host))
      {
        ++readers;
        break;
      }
    session_.WaitUntil(
        [&]
        {
          return states_in_->Writers() >= 1 && commands_.Readers() >= readers && saved_.Met() &&
                 (!frames_in_ || frames_in_->Writers() >= FrameWriters());
        },
        [&] { return std::string("the engines"); });
  }

  std::optional<std::string> Stall()
  {
    std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock)
    {
      session_.SetTick(stepping_);
      return watch_.Observe(stepping_, fmt::format("runs the controller of {}", role_.RunningRobot()));
    }
    session_.SetTick(gate_.Tick());
    return watch_.Observe(gate_.Tick(),
                          gate_.Has(0) && !gate_.Complete() ? "waits for " + Joined(gate_.Missing()) : "");
  }

  void Flush() { saved_.Flush(); }
  void Destroy() { role_.Destroy(); }

private:
  static std::vector<TickGate::Part> Parts(const Experiment& experiment, const HostLayout& layout)
  {
    std::vector<TickGate::Part> parts{{"space server"}};
    for (const std::uint32_t engine : layout.frames_from) parts.push_back({EngineName(experiment, engine), true});
    return parts;
  }

  unsigned FrameWriters() const
  {
    unsigned writers = 0;
    for (const EngineLayout& engine : replica_.assignment.engines) writers += engine.sensor_size > 0 ? 1 : 0;
    return writers;
  }

  SpaceState* PlaceOfState(const MessageHeader& header)
  {
    if (header.run != session_.World().run) return nullptr;
    const std::lock_guard lock(mutex_);
    try
    {
      // A repeated state is read too: it may say that the run ends here.
      return gate_.Offer(0, header.tick) == TickGate::Verdict::kExpected ? &state_ : &repeated_;
    }
    catch (const BusError& error)
    {
      session_.Fail(gate_.Tick(), error.what());
      return nullptr;
    }
  }

  void StateArrived(const MessageHeader& header, SpaceState& state)
  {
    const std::lock_guard lock(mutex_);
    if (&state == &repeated_ && header.tick + 1 < gate_.Tick()) return;
    if (state.last) return session_.Finish(header.tick);
    if (&state == &state_)
    {
      replica_.space->Apply(state_);
      if (gate_.Arrived(0, header.tick)) Step();
    }
    else if (header.tick + 1 == gate_.Tick() && answer_ != nullptr)
      Answer(true);
  }

  SensorFrame* PlaceOfFrame(const MessageHeader& header)
  {
    const auto& from = role_.Layout().frames_from;
    const auto engine = std::find(from.begin(), from.end(), header.source);
    if (header.run != session_.World().run || engine == from.end()) return nullptr;
    const auto k = static_cast<std::size_t>(engine - from.begin());
    const std::lock_guard lock(mutex_);
    try
    {
      return gate_.Offer(1 + k, header.tick) == TickGate::Verdict::kExpected ? &frames_[header.tick % 2][k] : nullptr;
    }
    catch (const BusError& error)
    {
      session_.Fail(gate_.Tick(), error.what());
      return nullptr;
    }
  }

  void FrameArrived(const MessageHeader& header)
  {
    const auto& from = role_.Layout().frames_from;
    const auto k = static_cast<std::size_t>(std::find(from.begin(), from.end(), header.source) - from.begin());
    const std::lock_guard lock(mutex_);
    if (gate_.Arrived(1 + k, header.tick)) Step();
  }

  void Step()
  {
    try
    {
      stepping_ = gate_.Tick();
      for (std::size_t k = 0; k < frames_here_.size(); ++k) frames_here_[k] = &frames_[gate_.Tick() % 2][k];
      const bool first = gate_.Tick() == 0;
      answer_ = &role_.Step(first ? std::span<const SensorFrame* const>()
                                  : std::span<const SensorFrame* const>(frames_here_));
      gate_.Next();
      saved_.Ready(gate_.Tick(), role_);
      Answer(false);
      watch_robots_.Stepped();
    }
    catch (const std::exception& error)
    {
      session_.Fail(gate_.Tick(), error.what());
    }
  }

  void Answer(bool repeated)
  {
    MessageHeader header = session_.Header(answer_->tick, host_);
    header.repeated = repeated;
    commands_.Write(header, *answer_);
  }

  WorkerSession& session_;
  Replica& replica_;
  std::uint32_t host_;
  std::mutex mutex_;  // of what follows
  ControllerHost role_;
  SavedStates saved_;
  TickGate gate_;
  SpaceState state_;
  SpaceState repeated_;
  std::array<std::vector<SensorFrame>, 2> frames_;  // of even and odd ticks: engines may be one ahead
  std::vector<const SensorFrame*> frames_here_;
  const ControlCommands* answer_ = nullptr;
  std::atomic<std::uint64_t> stepping_ = 0;
  StallWatch watch_;  // main thread
  HotPublisher<ControlCommands> commands_;
  RobotWatch watch_robots_;
  std::optional<HotSubscription<SensorFrame>> frames_in_;
  std::optional<HotSubscription<SpaceState>> states_in_;
};

int Run(int argc, char** argv)
{
  CLI::App app{"Runs the controllers of some robots of a Swarmanoid experiment."};
  app.footer(
      "Examples:\n"
      "  controller_host                                    host 0 of the experiment that runs on this machine\n"
      "  controller_host --host 1 --experiment diffusion_10 --domain 7\n"
      "  controller_host --host 1 --interface eth0          space server on another machine");
  std::size_t host = 0;
  std::string experiment;
  BusOptions bus;
  app.add_option("--host", host,
                 "number of this host, from 0; the space server's --controller-hosts says how many there are")
      ->capture_default_str();
  app.add_option("--experiment", experiment, "name of the experiment; default: the first one that is heard");
  AddBusOptions(app, bus);
  if (const int code = ParseCommandLine(app, argc, argv); code >= 0) return code;

  CatchInterrupts();
  RegisterBuiltinEngines();
  RegisterBuiltinDevices();
  RegisterBuiltinRenderers();
  WorkerSession session(bus, experiment, HostName(host));
  return session.Work(
      [&]
      {
        Replica replica(session.World(), true);
        const std::size_t hosts = replica.assignment.hosts.size();
        if (host >= hosts)
          throw ConfigurationError(fmt::format("experiment '{}' has {} controller host{}, numbered from 0",
                                               replica.experiment->name, hosts, hosts == 1 ? "" : "s"));
        HostNode node(session, replica, host);
        node.MeetOthers();
        session.SayReady();
        session.Wait(std::chrono::milliseconds(500), [&] { return node.Stall(); });
        node.Flush();
        node.Destroy();
      });
}

}  // namespace
}  // namespace swarmanoid

int main(int argc, char** argv) { return swarmanoid::RunProgram("controller_host", swarmanoid::Run, argc, argv); }
