// The process of a controller host answers a state of the space and the sensor frames of its engines with commands.
// Frames have a place for even and one for odd ticks, since an engine may be a tick ahead. With commands that act later
// (`ahead`), the ones that are due are sent before the step, so that engines do not wait for the controllers.
//
// A process that takes the place of a lost one repeats the recorded ticks from the last saved state, with the recorded
// faults of controllers instead of measured ones, and refuses to go on if its commands differ from the record in any
// bit. The mutex of `inputs_` guards the role and all messages.
#include "controller_host/cluster/host_node.h"

#include <fmt/format.h>
#include <array>
#include <cmath>

#include "common/activity/shared_activity.h"
#include "common/bus/membership/recovery.h"
#include "common/bus/membership/saved_states.h"
#include "common/bus/membership/tick_inputs.h"
#include "common/bus/membership/worker_program.h"
#include "common/bus/membership/worker_session.h"
#include "common/bus/membership/worker_world.h"
#include "common/threads/thread_choice.h"
#include "controller_host/cluster/robot_inspection.h"
#include "controller_host/controller_host.h"

namespace swarmanoid
{
namespace
{

// Steps the controllers in the threads of the bus, as soon as the state and all sensor frames of a tick are here.
class HostNode
{
public:
  // `faults` has the values of --fault.
  HostNode(WorkerSession& session, WorkerWorld& replica, std::size_t host, unsigned threads,
           const std::vector<std::string>& faults)
      : session_(session),
        replica_(replica),
        host_(static_cast<std::uint32_t>(host)),
        pool_(std::min(threads, SharedActivity::kMostThreads)),
        role_(*replica.space, replica.assignment, host, &pool_),
        saved_(session, HostName(host), role_),
        inputs_(session, replica, Engines(*replica.experiment, role_.Layout()), replica.experiment->ahead > 0),
        commands_(session.GetBus(), session.Scope(replica.limits->CommandBytes(), 1)),
        inspection_(session, role_, host_, inputs_.Mutex())
  {
    if (std::isfinite(role_.Reach())) replica.space->Fields().Stop();
    // Sensors that ask for all, wherever they are, need the state of all.
    if (const double reach = role_.Reach(); HostsAskForParts(session.World()) && std::isfinite(reach))
    {
      inputs_.HearPart(HostName(host), host_, [this](const LocalState& state) { replica_.space->Apply(state, near_); });
      session.SetReach(reach);
    }
    const std::size_t engines = role_.Layout().frames_from.size();
    for (auto& frames : frames_) frames.resize(engines);
    frames_here_.resize(engines);
    RecordedFaults known = session.World().known;
    for (const std::string& text : faults)
    {
      const auto fault = ParseFault(text);
      known.faults.push_back({fault->first, fault->second, FaultKind::kDied});
    }
    role_.Know(std::move(known));
    if (session.TakesAPlace())
      inputs_.StartAt(Recover(session, replica,
                              {[this] { Restore(); }, [this](ByteReader& state) { role_.LoadState(state); },
                               [this](const TickRecord& record, const TickRecord* next) { Redo(record, next); },
                               [this](const std::vector<SensorFrame>& frames)
                               {
                                 TakeFrames(frames);
                                 has_frames_ = true;
                               }}));
    else
    {
      Restore();
      has_frames_ = true;
    }
    for (std::size_t k = 0; k < engines && has_frames_; ++k) inputs_.HaveFirst(k);
    inputs_.Open({[this](std::size_t k, std::uint64_t tick) { return &frames_[tick % 2][k]; }, [this] { Tick(); },
                  [this] { AnswerAgain(); }},
                 replica.limits->FrameBytes(), FrameWriters());
  }
  ~HostNode() { inputs_.Close(); }

  // Waits until all processes that this host sends to or receives from have joined.
  void WaitForOthers()
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
          if (inputs_.Over()) return true;
          return inputs_.ServerIsHere() && inputs_.MissingWriters() == 0 && commands_.Readers() >= readers &&
                 saved_.Matched();
        },
        [&] { return std::string("the engines"); });
  }

  std::optional<std::string> Stall()
  {
    return inputs_.Stall([] { return "runs " + CurrentActivity(); });
  }

  void Flush() { saved_.Flush(); }
  void Destroy() { role_.Destroy(); }

private:
  using Inputs = TickInputs<SensorFrame>;

  // Engines do not wait for their frames to be read: they may be one tick ahead.
  static std::vector<Inputs::Other> Engines(const Experiment& experiment, const HostLayout& layout)
  {
    std::vector<Inputs::Other> engines;
    for (const std::uint32_t engine : layout.frames_from)
      engines.push_back({engine, {EngineName(experiment, engine), true}});
    return engines;
  }

  unsigned FrameWriters() const
  {
    unsigned writers = 0;
    for (const EngineLayout& engine : replica_.assignment.engines) writers += engine.sensor_size > 0 ? 1 : 0;
    return writers;
  }

  // Restores the state at which the run begins. The first tick has no frames, or the checkpoint has those that engines
  // saved.
  void Restore()
  {
    replica_.Restore(session_.Name(), role_);
    const auto& from = role_.Layout().frames_from;
    for (std::size_t k = 0; k < from.size() && replica_.checkpoint; ++k)
    {
      ByteReader state(replica_.checkpoint->StateOf(EngineName(*replica_.experiment, from[k])));
      frames_[replica_.FirstTick() % 2][k].values = state.GetArray<double>();
    }
  }

  // Repeats the step of a tick. Its commands and failed controllers may be in the next record.
  void Redo(const TickRecord& record, const TickRecord* next)
  {
    TakeFrames(record.frames);
    const TickRecord* acting = replica_.experiment->ahead == 0 ? &record : next;
    if (acting != nullptr && !acting->commands.empty())
      role_.KnowTick(record.state.tick, acting->commands.at(host_).faults);
    Step(record.state.tick);
    saved_.Ready(record.state.tick + 1, role_, record.save);
    // The commands of the present tick may not have been sent.
    if (record.commands.empty()) return;
    const ControlCommands& before = record.commands.at(host_);
    const ControlCommands& now = role_.Commands();
    if (!SameBits(now.values, before.values) || now.faults != before.faults ||
        now.attributes.slots != before.attributes.slots || !SameBits(now.attributes.values, before.attributes.values))
      RefuseRecovery(session_.Name(), record.state.tick, "other commands");
  }

  // Takes this host's frames from those of all engines. The first tick has none.
  void TakeFrames(const std::vector<SensorFrame>& all)
  {
    const auto& from = role_.Layout().frames_from;
    for (std::size_t k = 0; k < from.size() && !all.empty(); ++k)
      for (auto& frames : frames_) frames[k] = all.at(from[k]);
  }

  void Step(std::uint64_t tick)
  {
    for (std::size_t k = 0; k < frames_here_.size(); ++k) frames_here_[k] = &frames_[tick % 2][k];
    const std::span<const SensorFrame* const> frames(frames_here_);
    sharing_.Do(&pool_, [&] { role_.Tick(tick == 0 ? std::span<const SensorFrame* const>() : frames); });
    has_stepped_ = true;
  }

  void Tick()
  {
    // The commands of the first tick may be unsent, and the process that this one replaces may have died before
    // sending.
    if (const ControlCommands* due = has_sent_ ? nullptr : role_.Due()) Send(*due, false);
    Step(inputs_.Tick());
    inputs_.Next();
    saved_.Ready(inputs_.Tick(), role_, inputs_.Saves());
    Send(role_.NewestCommands(), false);
    has_sent_ = true;
    inspection_.Stepped();
  }

  void AnswerAgain()
  {
    if (!has_stepped_) return;
    Send(role_.Commands(), true);
    if (replica_.experiment->ahead > 0) Send(role_.NewestCommands(), true);
  }

  void Send(const ControlCommands& commands, bool repeated)
  {
    MessageHeader header = session_.Header(commands.tick, host_);
    header.repeated = repeated;
    commands_.Write(header, commands);
  }

  WorkerSession& session_;
  WorkerWorld& replica_;
  std::uint32_t host_;
  WorkerPool pool_;
  ThreadedTicks sharing_;
  ControllerHost role_;
  SavedStates saved_;
  std::vector<std::uint32_t> near_;                 // LocalState::near of the last state that was told
  Inputs inputs_;                                   // its mutex guards the role and what follows
  std::array<std::vector<SensorFrame>, 2> frames_;  // of even and odd ticks
  std::vector<const SensorFrame*> frames_here_;
  bool has_frames_ = false;  // of the first tick that it waits for
  bool has_stepped_ = false;
  bool has_sent_ = false;
  HotPublisher<ControlCommands> commands_;
  RobotInspection inspection_;
};

}  // namespace

int RunControllerHost(const WorkerSettings& settings, const BusOptions& bus)
{
  const std::size_t host = settings.host;
  // The space server and the engines hear it, and speak to it.
  BusOptions without_others = bus;
  without_others.hears_announcements = false;
  WorkerSession session(without_others, settings.experiment, HostName(host), {}, settings.incarnation,
                        settings.machine);
  return session.Work(
      [&]
      {
        WorkerWorld replica(session.World(), true);
        session.ReleaseWorld();
        const std::size_t hosts = replica.assignment.hosts.size();
        if (host >= hosts)
          throw ConfigurationError(fmt::format("experiment '{}' has {} controller host{}, numbered from 0",
                                               replica.experiment->name, hosts, hosts == 1 ? "" : "s"));
        const auto watch = WatchTimeBudgets(*replica.experiment, replica.assignment.hosts[host]);
        HostNode node(session, replica, host, settings.threads, settings.faults);
        node.WaitForOthers();
        session.ReportReady();
        session.Wait(std::chrono::milliseconds(500), [&] { return node.Stall(); });
        node.Flush();
        node.Destroy();
      });
}

}  // namespace swarmanoid
