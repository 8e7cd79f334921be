#include "space_server/cluster/server_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "common/checkpoint/host_state.h"
#include "common/checkpoint/library_builds.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/journal/journal_reader.h"
#include "common/messages/control_verbs.h"
#include "common/program/standard_output.h"
#include "common/run/access/digest.h"
#include "common/run/run_summary.h"
#include "common/serialisation/save_check.h"
#include "common/space/space.h"
#include "space_server/cluster/late_processes.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr auto kPeriod = 50ms;         // period of the main thread while no event comes
constexpr double kLastViewTime_s = 1;  // observers may be stopped
constexpr auto kSayAgain = 300ms;      // between lines that say which processes are awaited
constexpr auto kWorldAgain = 3s;       // between announcements to processes that have not joined
constexpr auto kBrokenTime = 5s;       // time for the lease of a dead process to end
constexpr auto kStuckTime = 1s;        // time for another process to replace it
// So long after the last tick the end of the run is to answer all processes that leave: all receive each answer.
constexpr auto kOneAnswerTime = 200ms;
constexpr auto kOneAnswerTimeOfProcess = 20ms;  // more for each process

// Another process has ended the run.
class EndedByOthers : public BusError
{
public:
  explicit EndedByOthers(const std::string& text, int exit_code = kExitOthersFailed)
      : BusError(text), exit_code_(exit_code)
  {
  }
  int ExitCode() const { return exit_code_; }

private:
  int exit_code_;
};

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
      journal_sender_(session_, lockstep_, server_.Space(), assignment_, Journal())
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
  if (restart_point_) Add(world.known, restart_point_->Faults());
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

int ServerProgram::Run()
{
  try
  {
    session_.Open();
    if (KeepsJournal()) session_.AnnounceFolder(std::filesystem::absolute(options_.output_folder).lexically_normal());
    Collect();
    RunTicks();
    Close();
  }
  catch (const std::exception& error)
  {
    const bool complete = dynamic_cast<const ActivityError*>(&error) != nullptr;
    const auto* const by_others = dynamic_cast<const EndedByOthers*>(&error);
    EndReason reason = EndReason::kFailed;
    int exit_code = kExitProcessFailed;
    if (by_others != nullptr)
    {
      reason = EndReason::kOthers;
      exit_code = by_others->ExitCode();
    }
    else if (IsInterrupted())
    {
      reason = EndReason::kInterrupted;
      exit_code = kExitInterrupted;
    }
    NoteEnd(reason, lockstep_.Tick(),
            complete ? error.what() : fmt::format("space server failed at tick {}: {}", lockstep_.Tick(), error.what()),
            complete);
    if (journal_) journal_->Flush();
    // Observers wait for the server that replaces a stuck one, so they get no end of the run.
    if (exit_code != kExitStuck || !options_.awaits_replacements)
    {
      grants_.Leave(lockstep_.Tick(), error.what(), kLastViewTime_s);
      session_.Leave(lockstep_.Tick(), error.what());
    }
    // Within another program, that program reports the error.
    if (options_.abandon == nullptr) PrintError("space_server: {}\n", error.what());
    status_.Publish(ServerError{error.what()});
    session_.LeaveDirectory();
    stage_ = Stage::kFailed;
    return exit_code;
  }
  if (IsInterrupted())
  {
    NoteEnd(EndReason::kInterrupted, lockstep_.Tick(),
            fmt::format("space server was asked by a signal to end the run at tick {}", lockstep_.Tick()));
    return kExitInterrupted;
  }
  NoteEnd(EndReason::kDone, lockstep_.Tick(), "");
  return server_.HasFailed() ? kExitExperimentFailed : kExitDone;
}

void ServerProgram::Wake()
{
  const std::lock_guard lock(wake_mutex_);
  awake_ = true;
  wake_.notify_all();
}

void ServerProgram::Sleep(Clock::time_point until)
{
  std::unique_lock lock(wake_mutex_);
  wake_.wait_until(lock, until, [this] { return awake_; });
  awake_ = false;
}

void ServerProgram::CheckFailures()
{
  if (options_.abandon != nullptr && *options_.abandon) throw BusError("the run was given up");
  // The launcher is told which processes have left, so that it expects their end.
  for (const std::string& name : session_.TakeLeft()) status_.Publish(ServerLeft{name});
  if (Clock::now() >= answers_from_) session_.AnswerLeaves();
  HelpReplacements();
  // The order matters: a process that leaves in good order has the last state. Any other one has failed.
  const std::optional<std::string> left = session_.FirstLeft();
  if (const auto failure = lockstep_.Failure()) throw BusError(*failure);
  if (const auto failure = session_.Failure()) throw EndedByOthers(*failure);
  if (left && !lockstep_.Finished()) throw EndedByOthers(fmt::format("{} has left before the last tick", *left));
  if (!BusIsBroken()) return;
  // If another process has replaced the dead one, the tick advances and the run continues.
  const std::uint64_t tick = lockstep_.Tick();
  if (!broken_ || tick != broken_->tick) broken_ = {tick, Clock::now()};
  if (Clock::now() - broken_->since <= (options_.awaits_replacements ? kStuckTime : kBrokenTime)) return;
  throw EndedByOthers("a process died, or was stopped, while it held shared memory of the run", kExitStuck);
}

void ServerProgram::HelpReplacements()
{
  for (const std::string& name : session_.TakeLost()) status_.Publish(ServerLost{name});
  if (const auto trouble = journal_ ? journal_->TakeTrouble() : std::nullopt)
  {
    if (options_.journal_need != "optional")
      throw BusError(*trouble + "; free some room, or let the run go on without it: --journal optional");
    status_.Publish(ServerWarning{*trouble});
    Say(*trouble);
  }
  if (const auto excess = journal_ ? journal_->TakeExcess() : std::nullopt)
  {
    status_.Publish(ServerWarning{*excess});
    Say(*excess);
  }
  try
  {
    journal_sender_.Work();
  }
  catch (const BusError& error)
  {
    throw EndedByOthers(error.what());
  }
  const auto replaced = session_.TakeReplaced();
  for (const auto& [name, incarnation] : replaced)
  {
    lockstep_.Return(name, incarnation);
    run_control_.Arrived({name, session_.MachineOf(name)}, session_.ProcessOf(name), lockstep_.Tick());
  }
  if (replaced.empty() || stage_ == Stage::kGathering) return;
  lockstep_.Repeat();
  wait_.Repeated(Clock::now());
}

void ServerProgram::SayWorldAgain()
{
  if (Clock::now() < world_said_ + kWorldAgain) return;
  session_.SayWorldAgain();
  world_said_ = Clock::now();
}

void ServerProgram::Collect()
{
  world_said_ = Clock::now();
  auto said_at = world_said_;
  std::string said;
  while (true)
  {
    CheckFailures();
    if (IsInterrupted()) throw BusError("interrupted before the first tick");
    PublishViews();
    const std::vector<std::string> missing = session_.Missing();
    if (missing.empty() && lockstep_.AllMatched()) return;
    SayWorldAgain();
    const std::string text = Joined(missing);
    if (text != said && !text.empty() && Clock::now() - said_at > kSayAgain)
    {
      said_at = Clock::now();
      Say(fmt::format("waiting for {} (experiment '{}', domain {}) …", text, experiment_.name, options_.bus.domain));
      status_.Publish(ServerState{ServerState::kWaiting, text});
      said = text;
    }
    // Endpoints match without a message, so poll often once all processes have joined.
    Sleep(Clock::now() + (missing.empty() ? 1ms : 10ms));
  }
}

void ServerProgram::RunTicks()
{
  start_ = Clock::now();
  wait_.Begin(start_);
  const std::uint64_t tick = lockstep_.Tick();
  run_control_.Start(tick, start_);
  if (GoesOn())
    start_ -= std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options_.goes_on_after_s));
  stage_ = Stage::kRunning;
  first_tick_ = restart_point_ && restart_point_->Journal() ? restart_point_->Journal()->Start().first_tick : tick;
  ReportState();
  while (!lockstep_.Finished())
  {
    CheckFailures();
    Clock::time_point next = Clock::now() + kPeriod;
    if (IsInterrupted()) run_control_.Stop("interrupt");
    if (run_control_.WantsHold()) lockstep_.Hold();
    if (lockstep_.Held())
    {
      lockstep_.WithServer([this](SpaceServer& server) { run_control_.Work(server); });
      const RunControl::Decision decision = run_control_.Decide(lockstep_.Tick(), Clock::now());
      if (decision.go)
        lockstep_.Go(decision.until);
      else if (decision.due)
        next = std::min(next, *decision.due);
    }
    checkpoints_.Work();
    ReportProgress();
    PublishViews();
    if (!lockstep_.Finished() && !lockstep_.Failure()) Sleep(std::min(next, views_.Next(Clock::now())));
  }
  end_ = Clock::now();
  const auto who = lockstep_.Terminator();
  if (!who) return;
  run_control_.Stopped(lockstep_.Tick(), *who);
  status_.Publish(ServerAsked{fmt::format("{}: stopped at tick {}", *who, lockstep_.Tick())});
}

void ServerProgram::Close()
{
  RunSummary result;
  lockstep_.WithServer(
      [&](SpaceServer& server)
      {
        result.ticks = server.Space().GetTick();
        result.entities = server.Space().Size();
        result.hash = server.Space().Hash();
      });
  lockstep_.CloseHashLog();
  run_control_.Ended(result.ticks);
  result.wall_s = Seconds(end_ - start_);
  result.real_time_factor = RealTimeFactor(result.ticks - first_tick_, experiment_.TickSeconds(), result.wall_s);
  status_.Publish(ServerTick{result.ticks, experiment_.max_clock, result.real_time_factor});
  PublishEnd();
  wait_.Begin(Clock::now());
  if (!BeginsAgain())
    answers_from_ = Clock::now() + kOneAnswerTime + session_.NotLeft().size() * kOneAnswerTimeOfProcess;
  for (std::vector<std::string> there = session_.NotLeft(); !there.empty(); there = session_.NotLeft())
  {
    CheckFailures();
    Sleep(Clock::now() + 10ms);
    const auto now = Clock::now();
    if (const auto waited = wait_.TakeStall(now)) ReportStall(Joined(there), *waited);
    if (wait_.TakeRepeat(now)) lockstep_.Repeat();
  }
  CheckFailures();
  FinishCheckpoints();
  lockstep_.WithServer([](SpaceServer& server) { server.Destroy(); });
  // After the last state was read, no process waits for another one.
  views_.WaitUntilRead(kLastViewTime_s);
  grants_.Leave(result.ticks, "", kLastViewTime_s);
  if (BeginsAgain())
    session_.LeaveToNext();
  else
    session_.Leave(result.ticks, "");
  if (const auto& reset = run_control_.Reset())
    status_.Publish(ServerReset{reset->seed, reset->paused, reset->real_time_factor});
  status_.Publish(ServerFinished{result.ticks, result.entities, result.hash, result.wall_s, result.real_time_factor,
                                 server_.Failure()});
  if (status_.IsOpen()) return;
  std::fputs((FinishedLine(result) + "\n").c_str(), stdout);
  if (!OutputIsWritten()) throw std::runtime_error("the result of the run is lost");
}

void ServerProgram::FinishCheckpoints()
{
  const auto patience = Clock::now() + kBrokenTime;
  for (checkpoints_.Work(); !checkpoints_.Incomplete().empty(); checkpoints_.Work())
  {
    if (Clock::now() > patience)
      throw BusError(fmt::format("the checkpoint of tick {} is incomplete: parts of it were lost",
                                 checkpoints_.Incomplete().front()));
    Sleep(Clock::now() + 10ms);
  }
}

void ServerProgram::Reply(const ControlRequestMessage& request, bool done, std::uint64_t tick, const std::string& text)
{
  session_.Reply(request, done, tick, text);
  if (request.verb == kFailedController)
  {
    status_.Publish(ServerWarning{text});
    Say(text);
  }
  const ControlVerb* const verb = FindControlVerb(request.verb);
  if (!done || verb == nullptr || !verb->announced) return;
  const std::string line = fmt::format("{}: {}", AskerOf(request), text);
  status_.Publish(ServerAsked{line});
  Say(line);
}

void ServerProgram::Say(const std::string& text) const
{
  if (!status_.IsOpen()) PrintError("space server: {}\n", text);
}

void ServerProgram::ReportState()
{
  const ServerState::Phase phase = run_control_.Paused() ? ServerState::kPaused : ServerState::kRunning;
  if (phase == said_phase_) return;
  said_phase_ = phase;
  status_.Publish(ServerState{phase, {}});
  Say(run_control_.Paused() ? fmt::format("paused at tick {}", lockstep_.Tick()) : "running");
}

void ServerProgram::ReportProgress()
{
  const auto now = Clock::now();
  const std::uint64_t tick = lockstep_.Tick();
  const bool held = lockstep_.Held();
  if (tick != last_tick_ || held)
  {
    last_tick_ = tick;
    wait_.Begin(now);
  }
  else if (wait_.TakeRepeat(now))
    lockstep_.Repeat();
  if (const auto waited = wait_.TakeStall(now)) ReportStall(LateNames(tick), *waited);
  ReportState();
  const bool rests = run_control_.Paused() && held;
  if (rests) pace_.Rest(tick, now);
  if (rests || pace_.Observe(tick, now)) TellTick();
}

void ServerProgram::TellTick()
{
  const std::uint64_t tick = lockstep_.Tick();
  if (std::exchange(told_tick_, tick) != tick)
    status_.Publish(ServerTick{tick, experiment_.max_clock, pace_.RealTimeFactor()});
}

void ServerProgram::ReportStall(const std::string& who, Clock::duration waited)
{
  // A replacement waits for the world, and Fast DDS 2.9 may lose it while they meet.
  SayWorldAgain();
  status_.Publish(ServerStall{std::round(Seconds(waited)), who});
  Say(fmt::format("tick {}: waiting for {} since {:.0f} s", lockstep_.Tick(), who, Seconds(waited)));
}

std::string ServerProgram::LateNames(std::uint64_t tick) const
{
  std::vector<std::string> names;
  for (const LateProcess& late : LateProcesses(session_, lockstep_.Missing(), tick))
    names.push_back(late.doing.empty() ? late.name : fmt::format("{} ({})", late.name, late.doing));
  return Joined(names);
}

RunStatus::Phase ServerProgram::Phase() const
{
  if (lockstep_.Finished()) return RunStatus::Phase::kFinished;
  if (stage_ == Stage::kGathering) return RunStatus::Phase::kWaiting;
  return run_control_.Paused() ? RunStatus::Phase::kPaused : RunStatus::Phase::kRunning;
}

void ServerProgram::PublishViews()
{
  grants_.Work(lockstep_.Tick());
  const auto now = Clock::now();
  const RunStatus::Phase phase = Phase();
  if (phase == RunStatus::Phase::kFinished) return;
  if (phase != RunStatus::Phase::kWaiting && views_.ViewIsDue(lockstep_.Tick(), now)) SendView(now);
  if (views_.StatusIsDue(phase, now)) views_.SendStatus(Status(phase, now), now);
}

void ServerProgram::PublishEnd()
{
  grants_.Work(lockstep_.Tick());
  if (BeginsAgain()) return;
  const auto now = Clock::now();
  snapshot_.last = true;
  if (views_.Viewers() > 0) SendView(now);
  views_.SendStatus(Status(RunStatus::Phase::kFinished, now), now);
}

void ServerProgram::SendView(Clock::time_point now)
{
  lockstep_.WithServer(
      [this](SpaceServer& server)
      {
        server.Draw();
        server.WriteSnapshot(snapshot_);
        snapshot_.drawing = server.Space().GetDrawing();
      });
  snapshot_.real_time_factor = pace_.RealTimeFactor();
  views_.SendView(snapshot_, now);
}

RunStatus ServerProgram::Status(RunStatus::Phase phase, Clock::time_point now)
{
  RunStatus status;
  status.phase = phase;
  status.tick = lockstep_.Tick();
  status.speed_wanted = run_control_.Speed();
  if (phase == RunStatus::Phase::kRunning || phase == RunStatus::Phase::kFinished)
  {
    status.real_time_factor = pace_.RealTimeFactor();
    status.ticks_per_second = pace_.TicksPerSecond();
  }
  status.ended = run_control_.WhyStopped();
  if (const auto who = lockstep_.Terminator()) status.ended = *who + " asked for the end";
  const bool waits = stage_ != Stage::kGathering && !lockstep_.Held() && !lockstep_.Finished();
  status.processes = ProcessesNow(session_, status.tick, waits ? lockstep_.Missing() : std::vector<std::string>(),
                                  waits ? Seconds(wait_.Waited(now)) : 0);
  return status;
}

}  // namespace swarmanoid
