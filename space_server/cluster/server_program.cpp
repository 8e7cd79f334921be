#include "space_server/cluster/server_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "common/activity/exit_codes.h"
#include "common/activity/print_error.h"
#include "common/checkpoint/library_builds.h"
#include "common/journal/journal_reader.h"
#include "common/run/run_summary.h"
#include "common/serialisation/trial.h"
#include "space_server/cluster/process_liveness.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr auto kPeriod = 50ms;  // of the main thread, when nothing happens
constexpr auto kFirstRepeat = 100ms;
constexpr auto kLastRepeat = 1s;
constexpr double kLastViewTime_s = 1;  // those who look on may be stopped
constexpr auto kWorldAgain = 3s;       // to those who have not heard of the run
constexpr auto kStallTime = 2s;
constexpr auto kBrokenTime = 5s;  // for the lease of a dead process to end
constexpr auto kStuckTime = 1s;   // for another process to take its place

double Seconds(std::chrono::steady_clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

std::uint64_t NewRun()
{
  std::random_device device;
  return (static_cast<std::uint64_t>(device()) << 32) | device();
}

RunControlSetup MakeRunControlSetup(const ServerOptions& options, const Experiment& experiment,
                                    const std::optional<Continuation>& continuation)
{
  RunControlSetup setup{options.paused, options.real_time_factor, {}, {}};
  if (!options.output_folder.empty()) setup.event_log = options.output_folder + "/events.csv";
  if (!options.events.empty()) setup.repeated = ReadEvents(options.events, experiment);
  if (continuation) continuation->Prepare(setup);
  return setup;
}

std::string DoneText(const ControlRequestMessage& request, const Assignment& assignment)
{
  const std::size_t hosts = assignment.hosts.size();
  if (request.verb == "hosts")
    return fmt::format("{} now", hosts == 1 ? "one controller host has all robots"
                                            : fmt::format("{} controller hosts share the robots", hosts));
  return request.verb + " was done";
}

// A step that the run has still to come to the end of.
bool IsAwaited(const ControlRequestMessage& request, const Continuation& continuation)
{
  const EarlierRequests& requests = continuation.Requests();
  return requests.step && requests.pause_at && *requests.pause_at > continuation.Tick() &&
         requests.step->client == request.client && requests.step->number == request.number;
}

}  // namespace

ServerProgram::ServerProgram(const ServerOptions& options, const Experiment& experiment, StatusChannel& status)
    : options_(options),
      experiment_(experiment),
      status_(status),
      assignment_(MakeAssignment(experiment, options.controller_hosts)),
      continuation_(GoesOn() ? std::optional<Continuation>(std::in_place, options, experiment) : std::nullopt),
      server_(experiment, assignment_, options.output_folder.empty() ? "." : options.output_folder),
      session_(options.bus, World(), Expected(Visualisers()),
               {[this](const ControlRequestMessage& request)
                {
                  if (std::ranges::find(kShareVerbs, request.verb) != kShareVerbs.end()) return shares_.Ask(request);
                  run_control_.Ask(request);
                  Wake();
                },
                [this] { Wake(); },
                [this](const std::string& process)
                {
                  views_.Lost(process);
                  run_control_.Gone(process);
                },
                [this](const ControlReplyMessage& reply)
                {
                  shares_.Replied(reply);
                  // An offer of a machine that is said again is answered without a word, and changes nothing.
                  if (!reply.text.empty()) views_.Renew();
                }}),
      shares_(session_, options.bus,
              {[this](const ViewRequestMessage& request) { views_.Requested(request); },
               [this](const ControlRequestMessage& request)
               {
                 run_control_.Note(request);
                 Wake();
               },
               [this] { Wake(); }}),
      views_(session_, shares_, [this] { Wake(); }),
      run_control_(experiment, Setup(),
                   [this](const ControlRequestMessage& request, bool done, std::uint64_t tick, const std::string& text)
                   { Reply(request, done, tick, text); }),
      pace_(experiment.TickSeconds()),
      checkpoints_(session_, experiment, Expected({}), server_.Space().GetTick(), SavedTicks(),
                   options.output_folder.empty() ? "." : options.output_folder, (OpenJournal(), Journal()),
                   [this] { Wake(); }),
      lockstep_(session_, server_, assignment_, options.visualisations, options.hash_log, options.watch, checkpoints_,
                Journal(), continuation_ ? &*continuation_ : nullptr, [this] { Wake(); }),
      recoveries_(session_, lockstep_, server_.Space(), assignment_, Journal())
{
  if (options.awaits_replacements && journal_) session_.AwaitReplacements();
  if (continuation_)
    for (const ControlRequestMessage& request : continuation_->Requests().answered)
      session_.Remember(request, IsAwaited(request, *continuation_), DoneText(request, assignment_));
  if (continuation_) shares_.Restore(continuation_->Requests().shares);
  server_.SetFaultHandler(
      [this](const std::vector<KnownFault>& faults)
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
        run_control_.Refused(report.topic, report.sender);
        Wake();
      });
}

RunControlSetup ServerProgram::Setup()
{
  RunControlSetup setup = MakeRunControlSetup(options_, experiment_, continuation_);
  setup.may_reset = status_.IsOpen() && options_.abandon == nullptr;
  setup.build = OwnBuild();
  if (!options_.awaits_replacements) return setup;
  setup.places = WorkerPlaces(options_.machines, options_.worker_places);
  setup.move = [this](const WorkerPlaces::Move& move)
  {
    session_.Release(move.worker);
    status_.Publish(ServerMove{move.machine, move.worker});
  };
  if (options_.abandon == nullptr)
    setup.share_out = [this](const std::vector<std::string>& machines)
    {
      journal_->Flush();
      status_.Publish(ServerHosts{fmt::format("{}", fmt::join(machines, " "))});
    };
  return setup;
}

void ServerProgram::Reply(const ControlRequestMessage& request, bool done, std::uint64_t tick, const std::string& text)
{
  session_.Reply(request, done, tick, text);
  const bool is_refused_offer = request.verb == "offer" && !done;
  if (request.verb == kFailedController || request.verb == kMachineGone || is_refused_offer)
  {
    const std::string warning =
        is_refused_offer ? fmt::format("refused an offer of {}: {}", AskerOf(request), text) : text;
    status_.Publish(ServerWarning{warning});
    Say(warning);
  }
  // Robots that are moved by hand would fill the screen.
  const bool told = request.verb == "pause" || request.verb == "resume" || request.verb == "speed" ||
                    request.verb == "stop" || request.verb == "reset" || IsWorkerMove(request.verb) ||
                    std::ranges::find(kOfferVerbs, request.verb) != kOfferVerbs.end();
  if (!done || !told || text.empty()) return;
  const std::string line = fmt::format("{}: {}", AskerOf(request), text);
  status_.Publish(ServerAsked{line});
  Say(line);
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
    const bool interrupted = IsInterrupted() && reason_ == EndReason::kFailed;
    NoteEnd(interrupted ? EndReason::kInterrupted : reason_, lockstep_.Tick(),
            complete ? error.what() : fmt::format("space server failed at tick {}: {}", lockstep_.Tick(), error.what()),
            complete);
    if (journal_) journal_->Flush();
    // Who looks on waits for the server that takes the place of one that is stuck.
    if (!stuck_ || !options_.awaits_replacements)
    {
      shares_.Leave(lockstep_.Tick(), error.what(), kLastViewTime_s);
      session_.Leave(lockstep_.Tick(), error.what());
    }
    // Within another program, that one says it.
    if (options_.abandon == nullptr) PrintError("space_server: {}\n", error.what());
    status_.Publish(ServerError{error.what()});
    session_.LeaveDirectory();
    failed_ = true;
    if (interrupted) return kExitInterrupted;
    if (stuck_) return kExitStuck;
    return reason_ == EndReason::kOthers ? kExitOthersFailed : kExitProcessFailed;
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

WorldMessage ServerProgram::World()
{
  WorldMessage world =
      DescribeWorld(server_.Space(), NewRun(), options_.file, static_cast<unsigned>(assignment_.hosts.size()));
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
  if (!options_.restore_file.empty())
  {
    const Checkpoint checkpoint =
        ReadCheckpoint(options_.restore_file, experiment_, {assignment_.hosts.size(), options_.any_build});
    checkpoint.LoadPart(kServerPart, [&](ByteReader& state) { server_.LoadState(checkpoint.snapshot, state); });
    world.checkpoint = EncodeCheckpoint(checkpoint);
    if (KeepsJournal() && !GoesOn()) restored_ = checkpoint;
  }
  if (continuation_) continuation_->Restore(server_);
  if (!experiment_.HasGuards()) return world;
  if (!options_.faults_of.empty())
    world.known = FaultsOfRun(options_.faults_of, experiment_, server_.Space().GetTick());
  if (continuation_) world.known.Add(continuation_->Faults());
  return world;
}

std::set<std::uint64_t> ServerProgram::SavedTicks() const
{
  std::set<std::uint64_t> ticks;
  if (!continuation_ || continuation_->Journal() == nullptr) return ticks;
  for (const JournalPlace& place : continuation_->Journal()->Places())
    if (place.kind == JournalBlockKind::kSnapshot && place.first_tick <= continuation_->Tick())
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
  if (continuation_ && continuation_->Journal() != nullptr)
  {
    journal_.emplace(*continuation_->Journal(), continuation_->Tick(), beside_launcher, std::move(budget));
    continuation_->ShareOut(*journal_, experiment_, assignment_.hosts.size());
    return;
  }
  std::filesystem::create_directories(std::filesystem::path(file).parent_path());
  const JournalStart start{OriginOf(experiment_), assignment_.hosts.size(), server_.Space().GetTick()};
  journal_.emplace(file, ContentOf(start), beside_launcher, std::move(budget));
  if (!restored_) return;
  // For those who look back, and resume: what no message of a tick tells.
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
  // Whoever started the processes knows that one may end before it can.
  for (const std::string& name : session_.TakeLeft()) status_.Publish(ServerLeft{name});
  session_.AnswerLeaves();
  HelpReplacements();
  // Asked first: who leaves in good order has the last state, and who does not has failed.
  const std::optional<std::string> left = session_.FirstLeft();
  if (const auto failure = lockstep_.Failure()) throw BusError(*failure);
  if (const auto failure = session_.Failure())
  {
    reason_ = EndReason::kOthers;
    throw BusError(*failure);
  }
  if (left && !lockstep_.Finished())
  {
    reason_ = EndReason::kOthers;
    throw BusError(fmt::format("{} has left before the last tick", *left));
  }
  if (!BusIsBroken()) return;
  // Another process may have taken the place of the dead one: then the run goes on.
  if (!broken_since_ || lockstep_.Tick() != broken_tick_) broken_since_ = Clock::now();
  broken_tick_ = lockstep_.Tick();
  if (Clock::now() - *broken_since_ <= (options_.awaits_replacements ? kStuckTime : kBrokenTime)) return;
  reason_ = EndReason::kOthers;
  stuck_ = true;
  throw BusError("a process died, or was stopped, while it held shared memory of the run");
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
    recoveries_.Work();
  }
  catch (const BusError&)
  {
    reason_ = EndReason::kOthers;
    throw;
  }
  const auto replaced = session_.TakeReplaced();
  for (const auto& [name, incarnation] : replaced)
  {
    lockstep_.Return(name, incarnation);
    run_control_.Arrived({name, session_.MachineOf(name)}, session_.ProcessOf(name), lockstep_.Tick());
  }
  if (replaced.empty() || !started_) return;
  lockstep_.Repeat();
  repeated_ = Clock::now();
  repeat_after_ = kFirstRepeat;
}

void ServerProgram::Say(const std::string& text) const
{
  if (!status_.IsOpen()) PrintError("space server: {}\n", text);
}

void ServerProgram::Collect()
{
  const auto start = Clock::now();
  auto again = start + kWorldAgain;
  std::string said;
  while (true)
  {
    CheckFailures();
    if (IsInterrupted()) throw BusError("interrupted before the first tick");
    PublishViews();
    const std::vector<std::string> missing = session_.Missing();
    if (missing.empty() && lockstep_.AllMatched()) return;
    if (Clock::now() >= again)
    {
      session_.SayWorldAgain();
      again = Clock::now() + kWorldAgain;
    }
    const std::string text = Joined(missing);
    if (text != said && !text.empty() && (Clock::now() - start > 300ms || !said.empty()))
    {
      Say(fmt::format("waiting for {} (experiment '{}', domain {}) …", text, experiment_.name, options_.bus.domain));
      status_.Publish(ServerState{ServerState::kWaiting, text});
      said = text;
    }
    // Endpoints of others are met without a word: look often while nobody is missing.
    Sleep(Clock::now() + (missing.empty() ? 1ms : 10ms));
  }
}

void ServerProgram::RunTicks()
{
  start_ = since_ = repeated_ = Clock::now();
  if (GoesOn())
    start_ -= std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(options_.goes_on_after_s));
  repeat_after_ = kFirstRepeat;
  started_ = true;
  const std::uint64_t tick = lockstep_.Tick();
  first_tick_ = continuation_ && continuation_->Journal() ? continuation_->Journal()->Start().first_tick : tick;
  run_control_.Start(tick, since_);
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
    if (!lockstep_.Finished() && !lockstep_.Failure()) Sleep(std::min(next, views_.Next()));
  }
  end_ = Clock::now();
  const auto who = lockstep_.Terminator();
  if (!who) return;
  run_control_.Stopped(lockstep_.Tick(), *who);
  status_.Publish(ServerAsked{fmt::format("{}: stopped at tick {}", *who, lockstep_.Tick())});
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
    since_ = now;
    repeat_after_ = kFirstRepeat;
    repeated_ = now;
    stall_said_ = 0s;
  }
  else if (now - repeated_ >= repeat_after_)
  {
    lockstep_.Repeat();
    repeated_ = now;
    repeat_after_ = std::min<Clock::duration>(2 * repeat_after_, kLastRepeat);
  }
  if (now - since_ >= kStallTime && now - since_ >= stall_said_ + 1s)
  {
    stall_said_ = now - since_;
    const std::string who = LateNames(tick);
    status_.Publish(ServerStall{who, std::round(Seconds(stall_said_))});
    Say(fmt::format("tick {}: waiting for {} since {:.0f} s", tick, who, Seconds(stall_said_)));
  }
  ReportState();
  if (run_control_.Paused() && held)
    pace_.Rest(tick, now);
  else if (pace_.Observe(tick, now))
    status_.Publish(ServerTick{tick, experiment_.max_clock, pace_.RealTimeFactor()});
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
  if (!started_) return RunStatus::Phase::kWaiting;
  return run_control_.Paused() ? RunStatus::Phase::kPaused : RunStatus::Phase::kRunning;
}

void ServerProgram::PublishViews()
{
  shares_.Work(lockstep_.Tick());
  const auto now = Clock::now();
  const bool over = lockstep_.Finished();
  if (std::exchange(told_end_, over) || (over && BeginsAgain())) return;
  if (started_ && (over || views_.ViewIsDue(lockstep_.Tick(), now)))
  {
    lockstep_.WithServer([this](SpaceServer& server) { server.WriteSnapshot(snapshot_); });
    snapshot_.last = over;
    snapshot_.real_time_factor = pace_.RealTimeFactor();
    views_.SendView(snapshot_, now);
  }
  const RunStatus::Phase phase = Phase();
  if (over || views_.StatusIsDue(phase, now)) views_.SendStatus(Status(phase, now), now);
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
  const bool waits = started_ && !lockstep_.Held() && !lockstep_.Finished();
  status.processes = ProcessesNow(session_, status.tick, waits ? lockstep_.Missing() : std::vector<std::string>(),
                                  waits ? Seconds(now - since_) : 0);
  return status;
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
  PublishViews();
  auto said = Clock::now();
  repeat_after_ = kFirstRepeat;
  while (!session_.AllLeft())
  {
    CheckFailures();
    Sleep(Clock::now() + 10ms);
    if (Clock::now() - said < repeat_after_) continue;
    said = Clock::now();
    repeat_after_ = std::min<Clock::duration>(2 * repeat_after_, kLastRepeat);
    lockstep_.Repeat();
  }
  CheckFailures();
  FinishCheckpoints();
  lockstep_.WithServer([](SpaceServer& server) { server.Destroy(); });
  // After it nobody waits for the last state any more.
  views_.WaitUntilRead(kLastViewTime_s);
  shares_.Leave(result.ticks, "", kLastViewTime_s);
  if (BeginsAgain())
    session_.LeaveToNext();
  else
    session_.Leave(result.ticks, "");
  result.wall_s = Seconds(end_ - start_);
  result.real_time_factor = RealTimeFactor(result.ticks - first_tick_, experiment_.TickSeconds(), result.wall_s);
  status_.Publish(ServerTick{result.ticks, experiment_.max_clock, result.real_time_factor});
  if (const auto& reset = run_control_.Reset())
    status_.Publish(ServerReset{reset->seed, reset->paused, reset->real_time_factor});
  status_.Publish(ServerFinished{result.ticks, result.entities, result.hash, result.wall_s, result.real_time_factor});
  if (!status_.IsOpen()) fmt::print("{}\n", FinishedLine(result));
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

}  // namespace swarmanoid
