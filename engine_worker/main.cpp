// The program that runs one physics engine of an experiment: the engine worker's role at the bus.
#include <CLI/CLI.hpp>

#include <fmt/format.h>
#include <mutex>

#include "common/bus/cluster_options.h"
#include "common/bus/replica.h"
#include "common/bus/saved_states.h"
#include "common/bus/stall_watch.h"
#include "common/bus/tick_gate.h"
#include "common/bus/worker_session.h"
#include "controller_host/controller_host.h"
#include "engine_worker/engine_worker.h"
#include "visualiser/render.h"

namespace swarmanoid
{
namespace
{

// Steps the engine in the threads of the bus, as soon as the state and all commands of a tick are here.
class EngineNode
{
public:
  EngineNode(WorkerSession& session, Replica& replica, std::size_t engine)
      : session_(session),
        replica_(replica),
        engine_(static_cast<std::uint32_t>(engine)),
        role_(*replica.space, replica.assignment, engine),
        saved_(session, EngineName(*replica.experiment, engine), role_),
        gate_(Parts(role_.Layout()), replica.FirstTick()),
        commands_(role_.Layout().commands_from.size()),
        updates_(session.GetBus(), session.Scope(UpdateCapacity(*replica.space, replica.assignment), 1))
  {
    replica.Restore(EngineName(*replica.experiment, engine), role_);
    for (const ControlCommands& commands : commands_) commands_here_.push_back(&commands);
    const auto hosts = static_cast<unsigned>(replica.assignment.hosts.size());
    if (role_.Layout().sensor_size > 0)
      frames_.emplace(session.GetBus(), session.Scope(FrameCapacity(replica.assignment), 1));
    if (!commands_.empty())
      commands_in_.emplace(session.GetBus(), session.Scope(CommandsCapacity(*replica.space, replica.assignment), hosts),
                           HotSubscription<ControlCommands>::Handler{
                               [this](const MessageHeader& header) { return PlaceOfCommands(header); },
                               [this](const MessageHeader& header, ControlCommands&) { CommandsArrived(header); }});
    states_in_.emplace(session.GetBus(), session.Scope(StateCapacity(*replica.space), 1),
                       HotSubscription<SpaceState>::Handler{
                           [this](const MessageHeader& header) { return PlaceOfState(header); },
                           [this](const MessageHeader& header, SpaceState& state) { StateArrived(header, state); }});
  }

  // Until all whom this engine hears or speaks to are there.
  void MeetOthers()
  {
    const auto hosts = static_cast<unsigned>(replica_.assignment.hosts.size());
    unsigned frame_readers = 0;
    for (const HostLayout& host : replica_.assignment.hosts) frame_readers += host.frames_from.empty() ? 0 : 1;
    session_.WaitUntil(
        [&]
        {
          return states_in_->Writers() >= 1 && updates_.Readers() >= 1 && saved_.Met() &&
                 (!commands_in_ || commands_in_->Writers() >= hosts) &&
                 (!frames_ || frames_->Readers() >= frame_readers);
        },
        [&]
        {
          const unsigned here = commands_in_ ? commands_in_->Writers() : hosts;
          return here < hosts ? fmt::format("{} of {} controller hosts", hosts - here, hosts)
                              : std::string("the space server's topics");
        });
  }

  std::optional<std::string> Stall()
  {
    std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock)
    {
      session_.SetTick(stepping_);
      return watch_.Observe(stepping_, "runs its engine");
    }
    session_.SetTick(gate_.Tick());
    return watch_.Observe(gate_.Tick(), !commands_.empty() && gate_.Has(0) && !gate_.Complete()
                                            ? "waits for " + Joined(gate_.Missing())
                                            : "");
  }

  void Flush() { saved_.Flush(); }

private:
  static std::vector<TickGate::Part> Parts(const EngineLayout& layout)
  {
    std::vector<TickGate::Part> parts{{"space server"}};
    for (const std::uint32_t host : layout.commands_from) parts.push_back({HostName(host)});
    return parts;
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
    else if (header.tick + 1 == gate_.Tick())
      Answer(true);
  }

  ControlCommands* PlaceOfCommands(const MessageHeader& header)
  {
    const auto& from = role_.Layout().commands_from;
    const auto host = std::find(from.begin(), from.end(), header.source);
    if (header.run != session_.World().run || host == from.end()) return nullptr;
    const auto k = static_cast<std::size_t>(host - from.begin());
    const std::lock_guard lock(mutex_);
    try
    {
      return gate_.Offer(1 + k, header.tick) == TickGate::Verdict::kExpected ? &commands_[k] : nullptr;
    }
    catch (const BusError& error)
    {
      session_.Fail(gate_.Tick(), error.what());
      return nullptr;
    }
  }

  void CommandsArrived(const MessageHeader& header)
  {
    const auto& from = role_.Layout().commands_from;
    const auto k = static_cast<std::size_t>(std::find(from.begin(), from.end(), header.source) - from.begin());
    const std::lock_guard lock(mutex_);
    if (gate_.Arrived(1 + k, header.tick)) Step();
  }

  void Step()
  {
    try
    {
      stepping_ = gate_.Tick();
      role_.Step(state_.moved, commands_here_);
      gate_.Next();
      saved_.Ready(gate_.Tick(), role_);
      Answer(false);
    }
    catch (const std::exception& error)
    {
      session_.Fail(gate_.Tick(), error.what());
    }
  }

  void Answer(bool repeated)
  {
    MessageHeader header = session_.Header(gate_.Tick(), engine_);
    header.repeated = repeated;
    updates_.Write(header, role_.Update());
    if (frames_) frames_->Write(header, role_.Sensors());
  }

  WorkerSession& session_;
  Replica& replica_;
  std::uint32_t engine_;
  std::mutex mutex_;  // of what follows
  EngineWorker role_;
  SavedStates saved_;
  TickGate gate_;
  SpaceState state_;
  SpaceState repeated_;
  std::vector<ControlCommands> commands_;
  std::vector<const ControlCommands*> commands_here_;
  std::atomic<std::uint64_t> stepping_ = 0;
  StallWatch watch_;  // main thread
  HotPublisher<EngineUpdate> updates_;
  std::optional<HotPublisher<SensorFrame>> frames_;
  std::optional<HotSubscription<ControlCommands>> commands_in_;
  std::optional<HotSubscription<SpaceState>> states_in_;
};

std::size_t FindEngine(const Experiment& experiment, const std::string& id)
{
  std::vector<std::string> known;
  for (std::size_t e = 0; e < experiment.engines.size(); ++e)
  {
    if (experiment.engines[e].id == id) return e;
    known.push_back("'" + experiment.engines[e].id + "'");
  }
  throw ConfigurationError(fmt::format("experiment '{}' has no engine '{}'; it has {}", experiment.name, id,
                                       known.empty() ? "none" : Joined(known)));
}

int Run(int argc, char** argv)
{
  CLI::App app{"Runs one physics engine of a Swarmanoid experiment."};
  app.footer(
      "Examples:\n"
      "  engine_worker --engine ground                              the experiment that runs on this machine\n"
      "  engine_worker --engine ground --experiment diffusion_10 --domain 7\n"
      "  engine_worker --engine ground --interface eth0             space server on another machine");
  std::string engine;
  std::string experiment;
  BusOptions bus;
  app.add_option("--engine", engine, "the engine's id in the experiment file")->required();
  app.add_option("--experiment", experiment, "name of the experiment; default: the first one that is heard");
  AddBusOptions(app, bus);
  if (const int code = ParseCommandLine(app, argc, argv); code >= 0) return code;

  CatchInterrupts();
  RegisterBuiltinEngines();
  RegisterBuiltinDevices();
  RegisterBuiltinRenderers();
  WorkerSession session(bus, experiment, fmt::format("engine '{}'", engine));
  return session.Work(
      [&]
      {
        Replica replica(session.World(), false);
        EngineNode node(session, replica, FindEngine(*replica.experiment, engine));
        node.MeetOthers();
        session.SayReady();
        session.Wait(std::chrono::milliseconds(500), [&] { return node.Stall(); });
        node.Flush();
      });
}

}  // namespace
}  // namespace swarmanoid

int main(int argc, char** argv) { return swarmanoid::RunProgram("engine_worker", swarmanoid::Run, argc, argv); }
