// The process of an engine answers a state of the space and the commands of all its controller hosts with an update of
// its bodies. Messages may be late, lost or repeated, and a host may be a tick ahead, so commands have a place for even
// and one for odd ticks; the step runs when the last input has come (TickInputs).
//
// A process that takes the place of a lost one loads the last saved state and repeats the recorded ticks. It compares
// each update with the recorded one bit by bit and refuses to go on if one differs: a run that continued with other
// numbers would be a wrong run that nothing shows. The mutex of `inputs_` guards the role and all messages.
#include "engine_worker/cluster/engine_node.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <utility>

#include "common/activity/activity.h"
#include "common/bus/membership/recovery.h"
#include "common/bus/membership/region_links.h"
#include "common/bus/membership/saved_states.h"
#include "common/bus/membership/tick_inputs.h"
#include "common/bus/membership/worker_program.h"
#include "common/bus/membership/worker_session.h"
#include "common/bus/membership/worker_world.h"
#include "common/program/usage_error.h"
#include "common/space/space.h"
#include "engine_worker/engine_worker.h"

namespace swarmanoid
{
namespace
{

// Steps the engine in the threads of the bus, as soon as the state and all commands of a tick are here.
class EngineNode
{
public:
  EngineNode(WorkerSession& session, WorkerWorld& replica, std::size_t engine)
      : session_(session),
        replica_(replica),
        engine_(static_cast<std::uint32_t>(engine)),
        team_(TeamOf(session, replica, engine)),
        role_(*replica.space, replica.assignment, engine, team_.get()),
        saved_(session, EngineName(*replica.experiment, engine), role_),
        inputs_(session, replica, Hosts(*replica.experiment, role_.Layout())),
        commands_here_(role_.Layout().commands_from.size()),
        updates_(session.GetBus(), session.Scope(replica.limits->UpdateBytes(), 1))
  {
    for (auto& commands : commands_) commands.resize(commands_here_.size());
    if (session.World().recorded) update_.recorded.resize(role_.Layout().command_size + role_.Layout().sensor_size);
    if (role_.Layout().sensor_size > 0)
      frames_.emplace(session.GetBus(), session.Scope(replica.limits->FrameBytes(), 1));
    replica.space->Fields().Stop();
    if (EnginesHearParts(session.World()))
      inputs_.HearPart(PartNameOfEngine(engine), engine_, [this](const LocalState& state) { Apply(state); });
    Begin();
    inputs_.Open({[this](std::size_t k, std::uint64_t tick) { return &commands_[tick % 2][k]; }, [this] { Tick(); },
                  [this] { Answer(true); }, team_ != nullptr, replica.experiment->ahead > 0},
                 replica.limits->CommandBytes(), HostCount());
  }
  ~EngineNode() { inputs_.Close(); }

  // Waits until all processes that this engine sends to or receives from have joined.
  void WaitForOthers()
  {
    unsigned frame_readers = 0;
    for (const HostLayout& host : replica_.assignment.hosts) frame_readers += host.frames_from.empty() ? 0 : 1;
    session_.WaitUntil(
        [&]
        {
          if (inputs_.Over()) return true;
          return inputs_.ServerIsHere() && inputs_.MissingWriters() == 0 && updates_.Readers() >= 1 &&
                 saved_.Matched() && (!frames_ || frames_->Readers() >= frame_readers) &&
                 (team_ == nullptr || team_->Missing() == 0);
        },
        [&]
        {
          if (team_ != nullptr && team_->Missing() > 0) return fmt::format("{} of its regions", team_->Missing());
          const unsigned missing = inputs_.MissingWriters();
          return missing > 0 ? fmt::format("{} of {} controller hosts", missing, HostCount())
                             : std::string("the space server's topics");
        });
    if (team_ == nullptr) return;
    const std::lock_guard lock(inputs_.Mutex());
    team_->Begin(inputs_.Mutex());
  }

  std::optional<std::string> Stall()
  {
    return inputs_.Stall(
        [this]
        {
          const std::string regions = team_ != nullptr ? team_->Awaited() : "";
          return regions.empty() ? "runs " + CurrentActivity() : "waits for " + regions;
        });
  }

  // Called after the last tick.
  void Finish()
  {
    saved_.Flush();
    if (team_ != nullptr) team_->End();
    // A host whose commands act a tick later may still need a frame for its last step.
    if (frames_ && replica_.experiment->ahead > 0)
      session_.WaitUntil([this] { return HostsThere().empty(); }, [this] { return Joined(HostsThere()); });
  }

private:
  using Inputs = TickInputs<ControlCommands>;

  static std::unique_ptr<RegionTeamLink> TeamOf(WorkerSession& session, const WorkerWorld& replica, std::size_t engine)
  {
    if (RegionsOf(replica.experiment->engines[engine]) == 0) return nullptr;
    return std::make_unique<RegionTeamLink>(session, *replica.experiment, engine, replica.limits->Regions());
  }

  // Commands that act a tick later come a tick early.
  static std::vector<Inputs::Other> Hosts(const Experiment& experiment, const EngineLayout& layout)
  {
    std::vector<Inputs::Other> hosts;
    for (const std::uint32_t host : layout.commands_from)
      hosts.push_back({host, {HostName(host), experiment.ahead > 0}});
    return hosts;
  }

  unsigned HostCount() const { return static_cast<unsigned>(replica_.assignment.hosts.size()); }

  // Returns the hosts that read the frames and have not left.
  std::vector<std::string> HostsThere() const
  {
    std::vector<std::string> names;
    for (std::size_t host = 0; host < HostCount(); ++host)
    {
      const std::vector<std::uint32_t>& engines = replica_.assignment.hosts[host].frames_from;
      if (std::ranges::find(engines, engine_) != engines.end() && !session_.HasLeft(HostName(host), 0))
        names.push_back(HostName(host));
    }
    return names;
  }

  void Begin()
  {
    const auto begin = [this]
    {
      replica_.Restore(session_.Name(), role_);
      has_frame_ = replica_.checkpoint.has_value();
    };
    if (!session_.TakesAPlace()) return begin();
    const auto load = [this](ByteReader& state)
    {
      role_.LoadState(state);
      has_frame_ = true;
    };
    inputs_.StartAt(Recover(session_, replica_,
                            {begin, load, [this](const TickRecord& record, const TickRecord*) { Redo(record); }, {}}));
  }

  // Repeats the step of a tick from the record.
  void Redo(const TickRecord& record)
  {
    CheckAgainst(record);
    const std::uint64_t tick = record.state.tick;
    for (std::size_t k = 0; k < commands_here_.size(); ++k)
      commands_[tick % 2][k] = record.commands.at(role_.Layout().commands_from[k]);
    Step(tick, record.state.moved);
    saved_.Ready(tick + 1, role_, record.save);
  }

  // The message lacks the poses that this engine computed itself, so they come from its last update.
  void Apply(const LocalState& state)
  {
    CSwarmanoidSpace& space = *replica_.space;
    space.SetTick(state.tick);
    if (has_update_) space.SetPoses(role_.Layout().owned, update_.poses);
    space.SetPoses(state.entities, state.poses);
    space.SetAttributes(state.attributes);
  }

  // Compares the update that was computed again with the tick that the run went on with.
  void CheckAgainst(const TickRecord& record)
  {
    if (!has_update_) return;
    const std::uint64_t tick = record.state.tick;
    if (frames_ && !SameBits(role_.Sensors().values, record.frames.at(engine_).values))
      RefuseRecovery(session_.Name(), tick, "other sensor values");
    const std::span<const std::uint32_t> movable = replica_.space->Movable();
    const std::vector<std::uint32_t>& owned = role_.Layout().owned;
    const std::vector<std::uint32_t>& moved = record.state.moved;
    for (std::size_t k = 0; k < owned.size(); ++k)
    {
      if (std::binary_search(moved.begin(), moved.end(), owned[k])) continue;
      if (std::ranges::binary_search(role_.Elsewhere(), owned[k])) continue;
      const auto place =
          static_cast<std::size_t>(std::lower_bound(movable.begin(), movable.end(), owned[k]) - movable.begin());
      for (std::size_t c = 0; c < 7; ++c)
        if (std::bit_cast<std::uint64_t>(role_.Update().poses[c * owned.size() + k]) !=
            std::bit_cast<std::uint64_t>(record.state.poses[c * movable.size() + place]))
          RefuseRecovery(session_.Name(), tick,
                         "another pose of '" + replica_.space->GetEntity(owned[k]).GetId() + "'");
    }
  }

  void Step(std::uint64_t tick, std::span<const std::uint32_t> moved)
  {
    if (team_ != nullptr) team_->SetTick(tick);
    for (std::size_t k = 0; k < commands_here_.size(); ++k) commands_here_[k] = &commands_[tick % 2][k];
    if (frames_ && has_frame_ && replica_.experiment->ahead > 0) frame_before_ = role_.Sensors();
    role_.Tick(moved, commands_here_);
    TakeUpdate();
  }

  void Tick()
  {
    Step(inputs_.Tick(), inputs_.State().moved);
    inputs_.Next();
    saved_.Ready(inputs_.Tick(), role_, inputs_.Saves());
    Answer(false);
  }

  void TakeUpdate()
  {
    std::vector<double> recorded = std::move(update_.recorded);
    update_ = role_.Update();
    update_.recorded = std::move(recorded);
    has_update_ = has_frame_ = true;
    if (update_.recorded.empty()) return;
    const EngineLayout& layout = role_.Layout();
    for (const ValueCopy& copy : layout.command_copies)
    {
      const auto source = std::find(layout.commands_from.begin(), layout.commands_from.end(), copy.source);
      const ControlCommands& commands =
          *commands_here_[static_cast<std::size_t>(source - layout.commands_from.begin())];
      std::copy_n(commands.values.begin() + static_cast<std::ptrdiff_t>(copy.from), copy.count,
                  update_.recorded.begin() + static_cast<std::ptrdiff_t>(copy.to));
    }
    std::ranges::copy(role_.Sensors().values,
                      update_.recorded.begin() + static_cast<std::ptrdiff_t>(layout.command_size));
  }

  void Answer(bool repeated)
  {
    MessageHeader header = session_.Header(inputs_.Tick(), engine_);
    header.repeated = repeated;
    if (has_update_) updates_.Write(header, update_);
    if (!frames_ || !has_frame_) return;
    if (repeated && frame_before_)
    {
      // Commands that act a tick later do not tell that their host has the frame of the tick before.
      MessageHeader before = header;
      --before.tick;
      frames_->Write(before, *frame_before_);
    }
    frames_->Write(header, role_.Sensors());
  }

  WorkerSession& session_;
  WorkerWorld& replica_;
  std::uint32_t engine_;
  std::unique_ptr<RegionTeamLink> team_;  // of an engine that is split
  EngineWorker role_;
  SavedStates saved_;
  Inputs inputs_;                                         // its mutex guards the role and what follows
  std::array<std::vector<ControlCommands>, 2> commands_;  // of even and odd ticks
  std::vector<const ControlCommands*> commands_here_;     // of the tick
  EngineUpdate update_;
  bool has_update_ = false;  // of the tick that comes next
  bool has_frame_ = false;
  std::optional<SensorFrame> frame_before_;  // of the tick before, if commands act a tick later
  HotPublisher<EngineUpdate> updates_;
  std::optional<HotPublisher<SensorFrame>> frames_;
};

// The engine worker sends most regions everything about their bodies, so they need only the engines of the experiment.
std::unique_ptr<Experiment> EnginesOf(const WorldMessage& world)
{
  LoadOptions options;
  options.check_files = false;
  options.engines_alone = true;
  return LoadWorld(world, options);
}

// No engine has more bodies than there are entities that can move.
RegionLimits LimitsOf(const WorldMessage& world)
{
  return {static_cast<std::size_t>(std::ranges::count_if(world.entities, &WorldEntity::movable)), 0};
}

int RunRegion(const WorkerSettings& settings, const BusOptions& bus)
{
  const auto region = static_cast<unsigned>(*settings.region);
  WorkerSession session(bus, settings.experiment, fmt::format("region {} of engine '{}'", region, settings.engine), {},
                        settings.incarnation, settings.machine);
  return session.Work(
      [&]
      {
        const std::unique_ptr<Experiment> engines = EnginesOf(session.World());
        const Experiment& experiment = *engines;
        const std::size_t engine = NumberOf(experiment, experiment.engines, "engine", settings.engine);
        const std::unique_ptr<CPhysicsEngine> made = RegisteredEngine(experiment.engines[engine]).create();
        const RegionLimits limits = LimitsOf(session.World());
        std::optional<WorkerWorld> replica;
        if (made->RegionsKnowEntities()) replica.emplace(session.World(), false);
        session.ReleaseWorld();
        malloc_trim(0);
        if (region >= RegionsOf(experiment.engines[engine]))
          throw ConfigurationError(experiment.engines[engine].location,
                                   fmt::format("the engine '{}' has {} regions, numbered from 0; there is no region {}",
                                               settings.engine, RegionsOf(experiment.engines[engine]), region));
        RegionLink link(session, experiment, engine, region, limits);
        std::optional<EngineWorker> whole;
        if (replica) whole.emplace(*replica->space, replica->assignment, engine);
        const std::unique_ptr<EngineRegion> world = (whole ? whole->Engine() : *made).MakeRegion(region, link);
        RunThread worker("does the tasks of a region",
                         [&]
                         {
                           try
                           {
                             link.Serve(*world);
                           }
                           catch (const std::exception& error)
                           {
                             session.Fail(0, error.what());
                           }
                         });
        struct Ended
        {
          ~Ended()
          {
            link.Close();
            worker.join();
          }
          RegionLink& link;
          RunThread& worker;
        } const ended{link, worker};
        // The engine does without its regions until all are there: the run may end before.
        session.WaitUntil([&] { return link.Missing() == 0 || link.IsOver(); },
                          [&] { return fmt::format("{} processes of its engine", link.Missing()); });
        session.ReportReady();
        session.Wait(std::chrono::milliseconds(500), [] { return std::nullopt; });
      });
}

}  // namespace

int RunEngineWorker(const WorkerSettings& settings, const BusOptions& bus)
{
  if (settings.engine.empty()) throw UsageError("give --engine ID; for example --engine ground");
  if (settings.region) return RunRegion(settings, bus);
  WorkerSession session(bus, settings.experiment, fmt::format("engine '{}'", settings.engine), {}, settings.incarnation,
                        settings.machine);
  return session.Work(
      [&]
      {
        WorkerWorld replica(session.World(), false);
        session.ReleaseWorld();
        const Experiment& experiment = *replica.experiment;
        EngineNode node(session, replica, NumberOf(experiment, experiment.engines, "engine", settings.engine));
        node.WaitForOthers();
        session.ReportReady();
        session.Wait(std::chrono::milliseconds(500), [&] { return node.Stall(); });
        node.Finish();
      });
}

}  // namespace swarmanoid
