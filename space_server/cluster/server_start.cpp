// The start of a run, and its resumption from a checkpoint or a journal.
#include "space_server/cluster/server_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <random>

#include "common/activity/print_error.h"
#include "common/checkpoint/host_state.h"
#include "common/checkpoint/library_builds.h"
#include "common/journal/journal_reader.h"
#include "common/messages/control_verbs.h"
#include "common/serialisation/save_check.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

std::uint64_t NewRun()
{
  std::random_device device;
  return (static_cast<std::uint64_t>(device()) << 32) | device();
}

RunControlSetup MakeRunControlSetup(const ServerOptions& options, const Experiment& experiment,
                                    const std::optional<RestartPoint>& restart_point)
{
  RunControlSetup setup{options.paused, options.real_time_factor, {}, {}};
  if (!options.output_folder.empty()) setup.event_log = options.output_folder + "/events.csv";
  if (!options.events.empty()) setup.repeated = ReadEvents(options.events, experiment);
  if (restart_point) restart_point->Prepare(setup);
  return setup;
}

// Returns the reply to a request that an earlier space server executed. A change of the controller hosts starts a new
// server.
std::string DoneText(const ControlRequestMessage& request, const Assignment& assignment)
{
  if (FindControlVerb(request.verb)->effect != Effect::kPlacement) return request.verb + " was done";
  const std::size_t hosts = assignment.hosts.size();
  return hosts == 1 ? "one controller host has all robots now"
                    : fmt::format("{} controller hosts share the robots now", hosts);
}

// A step that the run has still to come to the end of.
bool IsAwaited(const ControlRequestMessage& request, const RestartPoint& restart_point)
{
  const EarlierRequests& requests = restart_point.Requests();
  return requests.step && requests.pause_at && *requests.pause_at > restart_point.Tick() &&
         requests.step->client == request.client && requests.step->number == request.number;
}

}  // namespace

ServerProgram::ServerProgram(const ServerOptions& options, const Experiment& experiment, StatusChannel& status)
    : options_(options),
      experiment_(experiment),
      status_(status),
      restart_point_(GoesOn() ? std::optional<RestartPoint>(std::in_place, options, experiment) : std::nullopt),
      restored_(options.restore_file.empty()
                    ? std::nullopt
                    : std::optional(ReadCheckpoint(options.restore_file, experiment,
                                                   {options.controller_hosts, options.any_build}))),
      assignment_(MakeAssignment(experiment, Hosts())),
      server_(experiment, assignment_, options.output_folder.empty() ? "." : options.output_folder),
      session_(options.bus, World(), Members(),
               {[this](const ControlRequestMessage& request)
                {
                  const ControlVerb* const verb = FindControlVerb(request.verb);
                  if (verb != nullptr && verb->who == Asker::kOwner) return grants_.Ask(request);
                  run_control_.Ask(request);
                  Wake();
                },
                [this] { Wake(); }, [this](const std::string& process) { views_.Lost(process); },
                [this](const ControlReplyMessage& reply)
                {
                  grants_.Replied(reply);
                  views_.Renew();
                }}),
      grants_(session_, options.bus,
              {[this](const ViewRequestMessage& request) { views_.Requested(request); },
               [this](const ControlRequestMessage& request)
               {
                 run_control_.Note(request);
                 Wake();
               },
               [this] { Wake(); }}),
      views_(session_, grants_, [this] { Wake(); }),
      run_control_(experiment, Setup(),
                   [this](const ControlRequestMessage& request, bool done, std::uint64_t tick, const std::string& text)
                   { Reply(request, done, tick, text); }),
      pace_(experiment.TickSeconds()),
      checkpoints_(session_, experiment, Expected({}), server_.Space().GetTick(), SavedTicks(),
                   options.output_folder.empty() ? "." : options.output_folder, (OpenJournal(), Journal()),
                   [this] { Wake(); }),
      lockstep_(session_, server_, assignment_, options.visualisations, options.hash_log, options.watch, checkpoints_,
                Journal(), restart_point_ ? &*restart_point_ : nullptr, [this] { Wake(); }),
      recoveries_(session_, lockstep_, server_.Space(), assignment_, Journal())
{
  if (options.awaits_replacements && journal_) session_.AwaitReplacements();
  if (restart_point_)
    for (const ControlRequestMessage& request : restart_point_->Requests().answered)
      session_.Remember(request, IsAwaited(request, *restart_point_), DoneText(request, assignment_));
  if (restart_point_) grants_.Restore(restart_point_->Requests().grants);
  server_.SetFaultHandler(
      [this](const std::vector<RecordedFault>& faults)
      {
        run_control_.Failed(faults);
        Wake();
      });
  if (status_.IsOpen())
    server_.SetWarningHandler([this](const std::string& text) { status_.Publish(ServerWarning{text}); });
  session_.GetBus().OnRefused(
      [this](const BadMessageReport& report)
      {
        status_.Publish(
            ServerWarning{fmt::format("refused a {} message of {}: {}", report.topic, report.sender, report.what)});
        run_control_.Note(NoteOf(kRefusedMessage, report.topic, report.sender));
        Wake();
      });
}

RunControlSetup ServerProgram::Setup()
{
  RunControlSetup setup = MakeRunControlSetup(options_, experiment_, restart_point_);
  setup.may_reset = status_.IsOpen() && options_.abandon == nullptr;
  if (!options_.awaits_replacements) return setup;
  setup.places = WorkerPlacement(options_.machines, options_.worker_places);
  setup.move = [this](const WorkerPlacement::Move& move)
  {
    session_.Release(move.worker);
    status_.Publish(ServerMove{move.machine, move.worker});
  };
  if (options_.abandon == nullptr)
    setup.rebalance = [this](const std::vector<std::string>& machines)
    {
      journal_->Flush();
      status_.Publish(ServerHosts{fmt::format("{}", fmt::join(machines, " "))});
    };
  return setup;
}

HostTable ServerProgram::Hosts() const
{
  std::span<const double> poses;
  if (restored_) poses = restored_->snapshot.poses;
  if (restart_point_ && !restart_point_->NewestPoses().empty()) poses = restart_point_->NewestPoses();
  return DealRobots(experiment_, options_.controller_hosts, poses);
}

WorldMessage ServerProgram::World()
{
  WorldMessage world = DescribeWorld(server_.Space(), NewRun(), options_.file, assignment_.table);
  world.xml += options_.places;
  CheckCheckpointPeriod(options_.checkpoint_every, experiment_);
  world.checkpoint_every = options_.checkpoint_every;
  if (options_.checkpoint_every != 0) TrySaving(server_);
  world.recorded = KeepsJournal();
  ForEachLibrary(experiment_,
                 [&](const std::string& name, const std::string& file, bool)
                 {
                   if (!file.empty()) world.libraries.push_back({name, DigestOfFile(file)});
                 });
  if (restored_)
  {
    // A run that resumes with another assignment has other robots in its hosts, so the saved parts are distributed
    // again.
    if (GoesOn()) restored_->parts = SharedOut(std::move(restored_->parts), experiment_, assignment_.table);
    restored_->LoadPart(kServerPart, [&](ByteReader& state) { server_.LoadState(restored_->snapshot, state); });
    world.checkpoint = EncodeCheckpoint(*restored_);
    if (!KeepsJournal() || GoesOn()) restored_.reset();
  }
  if (restart_point_) restart_point_->Restore(server_);
  if (!experiment_.HasGuards()) return world;
  if (!options_.faults_of.empty())
    world.known = FaultsOfRun(options_.faults_of, experiment_, server_.Space().GetTick());
  if (restart_point_) world.known.Add(restart_point_->Faults());
  return world;
}

std::set<std::uint64_t> ServerProgram::SavedTicks() const
{
  std::set<std::uint64_t> ticks;
  if (!restart_point_ || restart_point_->Journal() == nullptr) return ticks;
  for (const JournalPlace& place : restart_point_->Journal()->Places())
    if (place.kind == JournalBlockKind::kSnapshot && place.first_tick <= restart_point_->Tick())
      ticks.insert(place.first_tick);
  return ticks;
}

void ServerProgram::OpenJournal()
{
  if (!KeepsJournal()) return;
  const std::string file = JournalFile(options_.output_folder);
  const bool beside_launcher = options_.abandon == nullptr;
  JournalBudget budget{options_.JournalBudgetBytes(), Expected({})};
  budget.parts.push_back(kServerPart);
  if (restart_point_ && restart_point_->Journal() != nullptr)
  {
    journal_.emplace(*restart_point_->Journal(), restart_point_->Tick(), beside_launcher, std::move(budget));
    restart_point_->ShareOut(*journal_, experiment_, assignment_.table);
    return;
  }
  std::filesystem::create_directories(std::filesystem::path(file).parent_path());
  const JournalStart start{OriginOf(experiment_), assignment_.table, server_.Space().GetTick()};
  journal_.emplace(file, ContentOf(start), beside_launcher, std::move(budget));
  if (!restored_) return;
  // The journal needs the restored state for playback and resumption, since no message of a tick has it.
  journal_->Add(restored_->snapshot);
  for (const SavedPart& part : restored_->parts) journal_->Add(restored_->snapshot.tick, part);
  restored_.reset();
}

std::span<const RenderConfiguration> ServerProgram::Visualisers() const
{
  return options_.visualisations ? std::span<const RenderConfiguration>(experiment_.visualisations)
                                 : std::span<const RenderConfiguration>();
}

std::vector<std::string> ServerProgram::Expected(std::span<const RenderConfiguration> visualisers) const
{
  std::vector<std::string> names;
  for (std::size_t e = 0; e < experiment_.engines.size(); ++e) names.push_back(EngineName(experiment_, e));
  for (std::size_t h = 0; h < assignment_.hosts.size(); ++h) names.push_back(HostName(h));
  for (const RenderConfiguration& render : visualisers) names.push_back(VisualiserName(render));
  return names;
}

std::vector<std::string> ServerProgram::Members() const
{
  std::vector<std::string> names = Expected(Visualisers());
  for (std::size_t e = 0; e < experiment_.engines.size(); ++e)
    for (unsigned region = 0; region < RegionsOf(experiment_.engines[e]); ++region)
      names.push_back(RegionName(experiment_, e, region));
  return names;
}

}  // namespace swarmanoid
