// Runs are submitted as arrays of tasks, whose files are in a SlurmBatch. Wait asks Slurm at intervals which tasks
// still exist, and then reads new results. A task that has ended counts as lost only if its results do not appear
// within kPatienceWithFiles, since shared file systems are slow.
#include "studies/executors/slurm_pool.h"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "common/errors/exit_codes.h"
#include "common/program/interrupts.h"
#include "common/program/usage_error.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

constexpr std::size_t kMostTasks = 1000;  // the largest array: one less than the default limit in slurm.conf
constexpr std::size_t kUsualTasks = 200;
constexpr std::size_t kFewTasks = 100;  // up to about this number, Slurm may be asked often
// A shared file system shows the files of another machine with a delay.
constexpr auto kPatienceWithFiles = 90s;
constexpr auto kPatienceWithFailed = 4s;
constexpr auto kPatienceWithCancel = 60s;

// Returns the cure for an end of a task; empty if it is unknown.
std::string CureOf(const std::string& state)
{
  if (state == "TIMEOUT") return "; give it more time (--slurm \"--time=…\") or fewer runs (--runs-per-task)";
  if (state == "OUT_OF_MEMORY") return "; ask for more memory (--slurm \"--mem=…\")";
  return "";
}

bool HasLiveTask(const std::map<std::size_t, SlurmTask>& tasks)
{
  return std::any_of(tasks.begin(), tasks.end(), [](const auto& task) { return !task.second.HasEnded(); });
}

}  // namespace

SlurmPool::SlurmPool(SlurmChoice choice, std::vector<char> setup, std::string study_folder)
    : choice_(std::move(choice)), setup_(std::move(setup)), folder_(std::move(study_folder))
{
  for (SlurmBatch& batch : SlurmBatch::FindAll(folder_)) jobs_.push_back({std::move(batch), {}, {}});
}

void SlurmPool::Give(RunOrder order)
{
  for (const Job& job : jobs_)
    for (const auto& [task, names] : job.batch.Outstanding())
      if (std::find(names.begin(), names.end(), order.name) != names.end()) return;
  collected_.push_back(std::move(order));
}

bool SlurmPool::IsIdle() const
{
  return collected_.empty() &&
         std::all_of(jobs_.begin(), jobs_.end(), [](const Job& job) { return job.batch.Outstanding().empty(); });
}

void SlurmPool::Submit()
{
  const std::size_t per_task =
      choice_.runs_per_task != 0 ? choice_.runs_per_task : (collected_.size() + kUsualTasks - 1) / kUsualTasks;
  try
  {
    while (!collected_.empty())
    {
      const auto end =
          collected_.begin() + static_cast<std::ptrdiff_t>(std::min(collected_.size(), per_task * kMostTasks));
      const std::vector<RunOrder> orders(collected_.begin(), end);
      SlurmBatch batch = SlurmBatch::Create(folder_, setup_, orders, per_task);
      std::string job;
      try
      {
        job = SubmitArray(batch.Script(), batch.LogPattern(), batch.Outstanding().size(), choice_.tasks_at_a_time,
                          choice_.options);
        batch.SetJob(job);
      }
      catch (const std::runtime_error&)
      {
        if (!job.empty()) CancelJob(job);
        batch.Remove();
        throw;
      }
      notes_.push_back(
          fmt::format("job {} of Slurm: {} runs in {} tasks", batch.Job(), orders.size(), batch.Outstanding().size()));
      collected_.erase(collected_.begin(), end);
      jobs_.push_back({std::move(batch), {}, {}});
    }
  }
  catch (const SlurmError& error)
  {
    throw RunPlaceError(fmt::format("--slurm: {}", error.what()));
  }
  catch (const std::runtime_error& error)
  {
    throw RunPlaceError(error.what());
  }
}

std::vector<RunOutcome> SlurmPool::Wait(std::chrono::milliseconds longest)
{
  std::vector<RunOutcome> outcomes;
  if (Interrupted())
  {
    Cancel(outcomes);
    return outcomes;
  }
  if (!collected_.empty()) Submit();
  std::this_thread::sleep_for(longest);
  const auto now = Clock::now();
  if (now < next_look_) return outcomes;
  next_look_ = now + 500ms;
  if (now >= next_question_)
  {
    std::size_t tasks = 0;
    for (Job& job : jobs_)
    {
      tasks += job.batch.Outstanding().size();
      if (!job.batch.Outstanding().empty() && !Ask(job)) break;
    }
    next_question_ = now + (tasks < kFewTasks ? 2s : 15s);
  }
  // Results are read after the question, so that the files of an ended task are seen.
  TakeResults(outcomes);
  for (Job& job : jobs_) LoseEnded(job, outcomes);
  return outcomes;
}

bool SlurmPool::Ask(Job& job)
{
  try
  {
    std::map<std::size_t, SlurmTask> tasks = TasksOf(job.batch.Job());
    // Slurm drops a task at once if it is cancelled before it began.
    for (const auto& [number, before] : job.tasks)
      if (!tasks.contains(number) && (before.state == "PENDING" || before.state == "CANCELLED"))
        tasks[number] = {"CANCELLED", "", ""};
    job.tasks = std::move(tasks);
    is_silent_ = false;
  }
  catch (const SlurmError& error)
  {
    if (!is_silent_)
      notes_.push_back(fmt::format("Slurm cannot be asked about job {}: {}; asked again until it answers",
                                   job.batch.Job(), error.what()));
    is_silent_ = true;
    return false;
  }
  for (const auto& [number, names] : job.batch.Outstanding())
  {
    const auto task = job.tasks.find(number);
    if (task == job.tasks.end() || task->second.HasEnded())
      job.ended.try_emplace(number, Clock::now());
    else
      job.ended.erase(number);  // it is in the queue again
  }
  return true;
}

void SlurmPool::TakeResults(std::vector<RunOutcome>& outcomes)
{
  for (Job& job : jobs_)
    for (RunOutcome& outcome : job.batch.TakeResults()) outcomes.push_back(std::move(outcome));
}

void SlurmPool::LoseEnded(Job& job, std::vector<RunOutcome>& outcomes)
{
  for (const auto& [number, since] : job.ended)
  {
    const auto names = job.batch.Outstanding().find(number);
    if (names == job.batch.Outstanding().end()) continue;
    const auto task = job.tasks.find(number);
    const std::string state = task == job.tasks.end() ? "" : task->second.state;
    if (Clock::now() - since < (state == "COMPLETED" ? kPatienceWithFiles : kPatienceWithFailed)) continue;
    const std::string words = job.batch.LastLineOfTask(number);
    for (const RunName& name : names->second)
    {
      RunOutcome& outcome = outcomes.emplace_back();
      outcome.name = name;
      outcome.exit_code = kExitProcessFailed;
      outcome.failure =
          fmt::format("Slurm's task {}_{} ended before it had a result ({}){}{}", job.batch.Job(), number,
                      state.empty() ? "Slurm has forgotten how"
                                    : state + (task->second.nodes.empty() ? "" : " on " + task->second.nodes),
                      words.empty() ? "" : ": " + words, CureOf(state));
      if (task != job.tasks.end()) outcome.host = task->second.nodes;
      job.batch.KeepLogOfTask(number, name);
    }
    job.batch.Outstanding().erase(names);
  }
}

void SlurmPool::Cancel(std::vector<RunOutcome>& outcomes)
{
  collected_.clear();
  const auto start = Clock::now();
  for (Job& job : jobs_)
  {
    if (job.batch.Outstanding().empty()) continue;
    try
    {
      CancelJob(job.batch.Job());
      // Results that were computed before the cancellation are taken.
      while (HasLiveTask(TasksOf(job.batch.Job())) && Clock::now() - start < kPatienceWithCancel)
        std::this_thread::sleep_for(500ms);
      notes_.push_back(fmt::format("job {} of Slurm is cancelled", job.batch.Job()));
    }
    catch (const SlurmError& error)
    {
      notes_.push_back(fmt::format("job {0} of Slurm could not be cancelled: {1}; end it by: scancel {0}",
                                   job.batch.Job(), error.what()));
    }
  }
  TakeResults(outcomes);
  for (Job& job : jobs_) job.batch.Outstanding().clear();
}

std::vector<RunningRun> SlurmPool::Running() const
{
  std::vector<RunningRun> runs;
  for (const Job& job : jobs_)
    for (const auto& [number, names] : job.batch.Outstanding())
      if (const auto task = job.tasks.find(number); task != job.tasks.end() && task->second.state == "RUNNING")
        runs.push_back({names.front(), task->second.nodes});
  return runs;
}

unsigned SlurmPool::Slots() const { return static_cast<unsigned>(std::max<std::size_t>(1, Running().size())); }

void SlurmPool::Committed()
{
  for (Job& job : jobs_)
  {
    job.batch.RemoveTaken();
    if (job.batch.Outstanding().empty()) job.batch.Remove();
  }
  std::erase_if(jobs_, [](const Job& job) { return job.batch.Outstanding().empty(); });
}

void SettleSlurm(StudyStore& store)
{
  std::vector<SlurmBatch> batches = SlurmBatch::FindAll(store.Folder());
  std::string live;
  for (const SlurmBatch& batch : batches)
  {
    try
    {
      if (HasLiveTask(TasksOf(batch.Job()))) live += " " + batch.Job();
    }
    catch (const SlurmError& error)
    {
      throw UsageError(
          fmt::format("the study has jobs of Slurm, which cannot be asked about them: {}; go on where Slurm "
                      "is, or remove '{}/slurm' if they have ended",
                      error.what(), store.Folder()));
    }
  }
  if (!live.empty())
    throw UsageError(
        fmt::format("the study's jobs{0} of Slurm go on: go on with --slurm, too, or end them by: scancel{0}", live));
  for (SlurmBatch& batch : batches)
  {
    for (const RunOutcome& outcome : batch.TakeResults())
      if (outcome.IsDone() && !store.IsDone(outcome.name)) store.Add(outcome);
    store.Commit();
    batch.RemoveTaken();
    batch.Remove();
  }
}

}  // namespace swarmanoid
