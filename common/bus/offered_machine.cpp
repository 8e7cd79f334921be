#include "common/bus/offered_machine.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <condition_variable>
#include <csignal>
#include <filesystem>
#include <mutex>
#include <thread>
#include <utility>

#include "common/activity/exit_codes.h"
#include "common/activity/failure_report.h"
#include "common/activity/limits.h"
#include "common/activity/print_error.h"
#include "common/bus/control_client.h"
#include "common/bus/offered_workers.h"
#include "common/bus/run_directory.h"
#include "common/bus/worker_session.h"
#include "common/checkpoint/library_builds.h"
#include "common/messages/control_request.h"
#include "common/program/interrupts.h"
#include "common/program/usage_error.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kPatienceForRun = 15s;
constexpr std::chrono::seconds kPatienceForAgain = 5min;  // for one that was heard before
constexpr double kPatienceForAnswer_s = 30;
constexpr auto kOfferAgain = 2s;   // the space server may have taken this machine for lost, or be another one
constexpr auto kUnknownTime = 8s;  // to the run, before this machine joins it anew: longer than the usual lease
constexpr auto kLook = 10ms;
constexpr auto kFinishTime = 10s;  // for workers after the end of the run, as the launcher has it
constexpr auto kMovesAgain = 500ms;

class OfferedMachine
{
public:
  OfferedMachine(WorkerSession& session, const std::string& machine, const BusOptions& bus)
      : session_(session),
        machine_(machine),
        offer_(machine + kOfBuild + OwnBuild()),
        client_(session.GetBus(), session.World().experiment, session.World().run),
        reports_(session.GetBus(), session.World().experiment),
        workers_({machine, session.World().experiment, ProcessId(),
                  std::filesystem::read_symlink("/proc/self/exe").parent_path().string(), bus,
                  [this](const WorkerReportMessage& report) { reports_.Write(report); },
                  [this](const std::string& text) { Say(text); }},
                 spawner_),
        requests_(session.GetBus(), session.World().experiment,
                  [this](const WorkerRequestMessage& request)
                  {
                    {
                      const std::lock_guard lock(mutex_);
                      waiting_.push_back(request);
                    }
                    session_.Notify();
                  })
  {
    workers_.FollowRun(session.World().run);
  }

  // Until the run ends, or a signal asks for the end; false if the run does not know this machine any more, or is not
  // heard.
  bool Serve()
  {
    bool taken = Offer();
    std::optional<BusError> over;
    while ((over = session_.Follow(kLook, [this] { Work(), LookForRun(); })))
    {
      if (Interrupted()) return Withdraw(), true;
      if (!session_.FollowNext([this] { return Work(), Interrupted(); })) break;
      is_known_.Heard();
      client_.FollowRun(session_.World().run);
      workers_.FollowRun(session_.World().run);
      offered_ = {};
      if (!taken) taken = Offer();
    }
    if (!over)
    {
      Say("the run does not know this machine any more, or is not heard; looking for it");
      return false;
    }
    if (Interrupted()) return Withdraw(), true;
    Finish();
    if (!session_.RunHasEnded()) throw BusError(*over);
    Say("the run has ended");
    return true;
  }

private:
  void Say(const std::string& text) const { PrintError("machine '{}': {}\n", machine_, text); }

  // False if the run ended, or lost its space server, before it took the offer: the session tells which.
  bool Offer()
  {
    const auto reply =
        client_.Ask("offer", offer_, {}, kPatienceForAnswer_s, [this] { return Interrupted() || session_.IsOver(); });
    if (!reply && session_.IsOver()) return false;
    if (!reply) throw BusError(Interrupted() ? "interrupted by a signal" : "the run does not answer");
    if (!reply->ok && reply->text == RunEndedText(reply->tick)) return false;
    if (!reply->ok) throw UsageError(reply->text);
    offered_ = Clock::now();
    Say(
        fmt::format("offered to the run of '{0}': `swarmanoid control {0} move-host 0 {1}` has a controller host run "
                    "here, Ctrl-C takes the offer back",
                    session_.World().experiment, machine_));
    return true;
  }

  void Work()
  {
    std::vector<WorkerRequestMessage> requests;
    {
      const std::lock_guard lock(mutex_);
      requests.swap(waiting_);
    }
    const auto now = Clock::now();
    for (const WorkerRequestMessage& request : requests) workers_.Take(request);
    workers_.Work(now);
    if (now - offered_ < kOfferAgain) return;
    offered_ = now;
    client_.Send("offer", offer_, {});
  }

  // The link may have been cut for so long that the space server has dropped this process, which would not be told.
  void LookForRun()
  {
    if (client_.StatusesHeard() != std::exchange(statuses_heard_, client_.StatusesHeard()))
    {
      const std::optional<RunStatus> status = client_.LatestStatus();
      const bool is_listed =
          std::ranges::any_of(status->processes, [](const ProcessStatus& p) { return p.process == ProcessId(); });
      if (is_listed || status->phase == RunStatus::Phase::kFinished) is_known_.Heard();
    }
    if (is_known_.IsTooLong(Clock::now(), kUnknownTime)) session_.Finish(0);
  }

  // Has the workers move away first.
  void Withdraw()
  {
    Say("asked to end: its workers move away first; Ctrl-C again ends them at once");
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
    while (true)
    {
      const auto reply = client_.Ask("withdraw", machine_, {}, kPatienceForAnswer_s,
                                     [this]
                                     {
                                       offered_ = Clock::now();  // not again
                                       return Work(), session_.RunHasEnded();
                                     });
      if (!reply && session_.RunHasEnded()) return Say("the run has ended");
      if (!reply) return Say("the run does not answer: other processes take the places of the workers that end here");
      if (reply->ok) return Say(reply->text);
      // Other workers are on their way.
      Say(reply->text);
      for (const auto until = Clock::now() + kMovesAgain; Clock::now() < until; std::this_thread::sleep_for(kLook))
        Work();
    }
  }

  // The run is over: workers end by themselves.
  void Finish()
  {
    const auto until = Clock::now() + kFinishTime;
    while (workers_.Any() && Clock::now() < until && !Interrupted())
    {
      offered_ = Clock::now();
      Work();
      std::this_thread::sleep_for(kLook);
    }
  }

  WorkerSession& session_;
  const std::string machine_;
  const std::string offer_;
  SystemSpawner spawner_;
  ControlClient client_;
  Publisher<WorkerReportMessage> reports_;
  OfferedWorkers workers_;
  Clock::time_point offered_;
  std::uint64_t statuses_heard_ = 0;
  SilenceCount is_known_;
  std::mutex mutex_;
  std::vector<WorkerRequestMessage> waiting_;
  Subscription<WorkerRequestMessage> requests_;
};

// The worker on the offered machine, as it is heard here.
class DistantWorker
{
public:
  DistantWorker(Bus& bus, const std::string& experiment, WorkerRequestMessage request)
      : request_(std::move(request)),
        requests_(bus, experiment),
        reports_(bus, experiment,
                 [this](const WorkerReportMessage& report)
                 {
                   const std::lock_guard lock(mutex_);
                   if (report.client != request_.client) return;
                   report_ = report;
                   changed_.notify_all();
                 }),
        worlds_(bus, experiment,
                [this](const WorldMessage& world)
                {
                  const std::lock_guard lock(mutex_);
                  if (world.protocol == kProtocolVersion) run_ = world.run;
                  changed_.notify_all();
                })
  {
  }

  // How it ended; nothing if nobody answers.
  std::optional<WorkerReportMessage> Follow()
  {
    SilenceCount silence;
    std::string process;
    while (true)
    {
      if (Interrupted() && request_.run == 0) return std::nullopt;
      request_.signal = Interrupted() ? SIGTERM : 0;
      std::optional<WorkerReportMessage> report = Ask();
      if (report && process.empty()) process = report->process;
      // Another one offers a machine of that name now: the worker is not there.
      if (!report || report->process != process || report->run != request_.run)
      {
        if (request_.run != 0 && silence.IsTooLong(Clock::now(), kAnswerTime)) return std::nullopt;
        continue;
      }
      silence.Heard();
      if (report->number != request_.taken + 1) continue;
      WriteAll(STDOUT_FILENO, {report->output.data(), report->output.size()});
      WriteAll(STDERR_FILENO, {report->errors.data(), report->errors.size()});
      request_.taken = report->number;
      if (!report->ended) continue;
      requests_.Write(request_);
      requests_.WaitUntilRead(1);
      return report;
    }
  }

private:
  // Says again what is wanted; what came since, within the period.
  std::optional<WorkerReportMessage> Ask()
  {
    {
      const std::lock_guard lock(mutex_);
      request_.run = run_;
    }
    if (request_.run != 0) requests_.Write(request_);
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, kRequestPeriod, [this] { return report_.has_value() || run_ != request_.run; });
    return std::exchange(report_, std::nullopt);
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  WorkerRequestMessage request_;
  std::uint64_t run_ = 0;
  std::optional<WorkerReportMessage> report_;
  Publisher<WorkerRequestMessage> requests_;
  Subscription<WorkerReportMessage> reports_;
  Subscription<WorldMessage> worlds_;
};

// Without a network the messages of a tick go through memory that is the run's user's on the machine of the run.
void RequireWay(const WorldMessage& world, int domain)
{
  const std::vector<LocalRun> runs = FindLocalRuns();
  const bool is_near = std::ranges::any_of(
      runs, [&](const LocalRun& run) { return run.experiment == world.experiment && run.domain == domain; });
  if (world.spread || is_near) return;
  throw UsageError(
      fmt::format("the run of '{}' uses no network: only its user can offer, on its own machine. Start it with a file "
                  "of --hosts that says options = --interface eth0",
                  world.experiment));
}

// As the worker did, so that whoever started this process sees what became of it.
int EndAs(const WorkerReportMessage& report)
{
  TakePageOfOther(report.activity);
  if (report.signal == 0) return static_cast<int>(report.exit_code);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const auto number = static_cast<int>(report.signal);
  std::signal(number, SIG_DFL);
  raise(number);
  return 128 + number;
}

}  // namespace

int OfferMachine(const WorkerSettings& settings, const BusOptions& options)
{
  if (options.key_fd >= 0)
    throw UsageError("--key-fd: the workers that are started here need the key, too; give it by --key FILE");
  BusOptions of_workers = options;
  if (!of_workers.key_file.empty()) of_workers.key_file = std::filesystem::absolute(of_workers.key_file);
  auto patience = kPatienceForRun;
  while (true)
  {
    WorkerSession session(options, settings.experiment, fmt::format("machine '{}'", settings.offer), std::nullopt, 0,
                          settings.offer, nullptr, patience);
    session.LookOn();
    RequireWay(session.World(), options.domain);
    if (OfferedMachine(session, settings.offer, of_workers).Serve()) return kExitDone;
    patience = kPatienceForAgain;
  }
}

int RunThroughMachine(const std::string& program, WorkerTable table, const WorkerSettings& settings,
                      const BusOptions& options)
{
  const Limits limits = LimitsOfEnvironment();
  std::optional<WorkerReportMessage> end;
  {
    Bus bus(options, fmt::format("{} of machine '{}'", program, settings.through));
    WorkerRequestMessage request;
    request.client = ProcessId();
    request.machine = settings.through;
    request.program = program;
    request.words = WorkerWords(table, settings);
    request.step_timeout_s = limits.step_s;
    request.memory_limit = limits.memory_bytes;
    end = DistantWorker(bus, settings.experiment, std::move(request)).Follow();
  }
  if (end && end->refusal.empty()) return EndAs(*end);
  if (Interrupted()) return kExitInterrupted;
  PrintError("{}: machine '{}' {}\n", program, settings.through,
             end ? "does not take the worker: " + end->refusal : "does not answer any more");
  return kExitMachineGone;
}

}  // namespace swarmanoid
