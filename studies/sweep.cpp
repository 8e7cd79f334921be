// Runs a study from its first run to its table. Runs are queued seed by seed, so that early results cover all points. A
// failed run is queued again up to the number of retries. With --until-ci, points get more seeds after all runs have
// ended, while the confidence interval of their mean is too wide, so that the decision does not depend on the order of
// results. Results are committed twice a second.
#include "studies/sweep.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "common/configuration/wording.h"
#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/math/reproducible_math.h"
#include "common/program/interrupts.h"
#include "common/program/shell_word.h"
#include "common/program/usage_error.h"
#include "simulation/register_all.h"
#include "studies/design/conflicts.h"
#include "studies/executors/machine_pool.h"
#include "studies/executors/run_pool.h"
#include "studies/executors/slurm_pool.h"
#include "studies/metrics/recorder.h"
#include "studies/runs/study_estimate.h"
#include "studies/runs/study_setup.h"
#include "studies/search/search.h"
#include "studies/sweep_progress.h"
#include "studies/tables/statistics.h"
#include "studies/tables/study_store.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr std::size_t kMostTried = 1000;
constexpr std::size_t kMostTold = 20;
// Seeds that are added to a point whose interval is too wide. The decision waits until all its runs have ended, so that
// it does not depend on their order.
constexpr unsigned kMoreSeeds = 5;

// Returns a mistake in a value, with the position of the factor that gives it.
std::string MistakeText(const Study& study, const Design& design, std::size_t point, const Diagnostic& error)
{
  const std::vector<const Factor*> factors = study.Factors();
  const std::vector<const FactorLevel*> levels = design.Levels(point);
  for (std::size_t f = 0; f < factors.size(); ++f)
    for (const StudyChange& change : levels[f]->changes)
      if (error.location.file && *error.location.file == "--set " + change.path)
        return fmt::format("{}: the value {} of '{}', at {}: {}", change.location.Text(), levels[f]->value,
                           factors[f]->id, change.path, error.message);
  const std::string values = design.Text(point);
  return error.Text() + (values.empty() ? "" : " (with " + values + ")");
}

[[nodiscard]] bool Complain(const std::vector<Diagnostic>& errors)
{
  for (const Diagnostic& error : errors) PrintError("{}\n", error.Text());
  return !errors.empty();
}

std::string NewFolder(const std::string& study)
{
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char time[64];
  std::strftime(time, sizeof time, "%Y%m%d-%H%M%S", &local);
  const std::string stem = fmt::format("runs/{}-{}", study, time);
  std::string folder = stem;
  std::error_code none;
  for (int number = 2; fs::exists(folder, none); ++number) folder = fmt::format("{}-{}", stem, number);
  return folder;
}

// Throws UsageError.
Machines MachinesOf(const SweepOptions& options)
{
  Machines machines = Machines::FromFile(options.hosts);
  if (machines.ForRuns().empty())
    throw UsageError(fmt::format("--hosts: '{}' names no machine for runs; write a line such as `runs = alpha beta`",
                                 options.hosts));
  return machines;
}

// Returns how many runs this machine executes at a time.
unsigned JobsOf(const SweepOptions& options, const Study& study)
{
  if (options.jobs != 0) return options.jobs;
  return study.cluster ? 1 : static_cast<unsigned>(UsableCores().size());
}

class Sweeper
{
public:
  Sweeper(const SweepOptions& options, const Study& study, const Design& design, StudyStore& store)
      : options_(options), study_(study), design_(design), store_(store)
  {
    if (!options.only.empty())
    {
      std::vector<std::string> names = study.FactorIds();
      names.emplace_back("seed");
      only_.emplace(options.only, names);
    }
    ReadLimit();
  }

  int Run()
  {
    Plan();
    CatchInterrupts(SecondInterrupt::kKills);
    const auto start = std::chrono::steady_clock::now();
    {
      const std::unique_ptr<Executor> place = MakePlace();
      SweepProgress progress(design_, all_, done_, options_.quiet);
      for (const auto& [point, wall_s] : known_times_) progress.AddTime(point, wall_s);
      const auto stop = [&](const std::string& reason)
      {
        progress.Say(fmt::format("{}; what was stored before stays: mend the cause, then go on: {}", reason, GoOn()));
        return kExitProcessFailed;
      };
      try
      {
        std::string no_place;
        try
        {
          Loop(*place, progress);
        }
        catch (const RunPlaceError& error)
        {
          no_place = error.what();
        }
        Commit(*place);
        store_.WriteTable();
        if (!no_place.empty()) return stop(no_place);
      }
      catch (const StudyStoreError& error)
      {
        return stop(error.what());
      }
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (is_study_wrong_)
    {
      PrintError("the study ends here, with {} of {} runs done: other runs would fail in the same way\n", done_, all_);
      return kExitInvalidFile;
    }
    if (done_ + failed_ < all_)
    {
      PrintError("{} of {} runs are done; to go on: {}\n", done_, all_, GoOn());
      return kExitInterrupted;
    }
    fmt::print("finished: {} runs, {} failed, {:.3f} s, table {}/table.csv\n", done_ + failed_, failed_, seconds,
               store_.Folder());
    if (failed_ > 0) return kExitProcessFailed;
    return TellWideIntervals() ? kExitTooFewSeeds : kExitDone;
  }

private:
  std::unique_ptr<Executor> MakePlace() const
  {
    if (!options_.hosts.empty())
      return std::make_unique<MachinePool>(MachinesOf(options_), SetupOf(study_, design_), store_.Folder());
    if (!options_.slurm.empty())
    {
      // The jobs continue without this process.
      for (const int signal : {SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
      return std::make_unique<SlurmPool>(
          SlurmChoice{SlurmOptions(options_.slurm.front()), options_.jobs, options_.runs_per_task},
          SetupOf(study_, design_), store_.Folder());
    }
    const unsigned jobs = JobsOf(options_, study_);
    return std::make_unique<RunPool>(
        study_, store_.Folder(),
        column_.empty() ? static_cast<unsigned>(std::clamp<std::size_t>(queue_.size(), 1, jobs)) : jobs);
  }

  // Returns the command that continues the study.
  std::string GoOn() const
  {
    std::string where;
    if (!options_.hosts.empty()) where = " --hosts " + ShellWord(options_.hosts);
    if (!options_.slurm.empty()) where = " --slurm " + ShellWord(options_.slurm.front());
    return fmt::format("swarmanoid sweep {} --resume{}", ShellWord(store_.Folder()), where);
  }

  void Commit(Executor& place)
  {
    store_.Commit();
    place.Committed();
  }

  bool IsChosen(const RunName& name) const
  {
    if (!only_) return true;
    const std::size_t factors = study_.FactorIds().size();
    return only_->Holds([&](std::size_t k) -> ExpressionValue
                        { return k < factors ? design_.Value(name.point, k) : static_cast<double>(name.seed); });
  }

  void ReadLimit()
  {
    if (options_.until_ci.empty()) return;
    const std::size_t sign = options_.until_ci.rfind('=');
    const std::string share = sign == std::string::npos ? "" : options_.until_ci.substr(sign + 1);
    const auto percent = share.ends_with('%') ? ParseNumber(share.substr(0, share.size() - 1)) : std::nullopt;
    if (!percent || *percent <= 0)
      throw UsageError("--until-ci: write COLUMN=PERCENT%, for example --until-ci dispersion=5%");
    column_ = options_.until_ci.substr(0, sign);
    share_ = *percent / 100;
    const std::vector<std::string>& columns = store_.Columns();
    if (std::find(columns.begin(), columns.end(), column_) == columns.end())
      throw UsageError(fmt::format("--until-ci: the study has no column {}; it has: {}{}", Quoted(column_),
                                   Listed(columns), DidYouMean(column_, columns)));
  }

  // Returns the seeds of each point that this process runs.
  std::map<std::uint32_t, std::vector<std::uint64_t>> SeedsOfPoints() const
  {
    std::map<std::uint32_t, std::vector<std::uint64_t>> seeds;
    for (const auto& [name, attempts] : attempts_) seeds[name.point].push_back(name.seed);
    return seeds;
  }

  // Returns the interval of a point's mean if it is wider than --until-ci allows.
  std::optional<MeanInterval> WideInterval(std::uint32_t point)
  {
    const std::vector<double> values = store_.LastValues(point, column_);
    const MeanInterval interval = MeanIntervalOf(values);
    if (values.empty() || interval.half <= share_ * std::abs(interval.mean)) return std::nullopt;
    return interval;
  }

  // Names the points whose interval stays too wide with --most-seeds; returns false if there are none.
  bool TellWideIntervals()
  {
    if (column_.empty()) return false;
    std::size_t wide = 0;
    const auto seeds = SeedsOfPoints();
    for (const auto& [point, of_point] : seeds)
    {
      const auto interval = WideInterval(point);
      if (!interval || ++wide > kMostTold) continue;
      const std::string values = design_.Text(point);
      PrintError("point {}{}: {} is {} with {} seeds\n", point, values.empty() ? "" : " (" + values + ")", column_,
                 IntervalText(*interval), of_point.size());
    }
    if (wide > 0)
      PrintError(
          "{} of {} points do not reach --until-ci {} with --most-seeds {}; for more: swarmanoid sweep {} --resume "
          "--until-ci {} --most-seeds {}\n",
          wide, seeds.size(), options_.until_ci, options_.most_seeds, ShellWord(store_.Folder()),
          ShellWord(options_.until_ci), 10 * options_.most_seeds);
    return wide > 0;
  }

  // Adds runs for the points whose interval is too wide; returns false if there are none.
  bool Extend(SweepProgress& progress)
  {
    if (column_.empty() || IsEnding()) return false;
    store_.Commit();
    for (const auto& [point, of_point] : SeedsOfPoints())
    {
      if (!WideInterval(point)) continue;
      const std::uint64_t last = *std::max_element(of_point.begin(), of_point.end());
      for (unsigned more = 1; more <= kMoreSeeds && of_point.size() + more <= options_.most_seeds; ++more)
      {
        const RunName name{point, last + more};
        store_.AddRun(name);
        attempts_[name] = 0;
        Enqueue(name);
        ++all_;
        progress.AddRuns(1);
      }
    }
    return !queue_.empty();
  }

  // Plans all points with the first seed, then with the second, so that early results cover the whole study.
  void Plan()
  {
    std::vector<StudyStore::RunState> runs = store_.Runs();
    std::map<std::uint64_t, std::size_t> order;
    for (std::size_t i = 0; i < study_.seeds.size(); ++i) order[study_.seeds[i]] = i;
    std::stable_sort(runs.begin(), runs.end(),
                     [&](const auto& a, const auto& b) { return order[a.name.seed] < order[b.name.seed]; });
    for (const StudyStore::RunState& run : runs)
    {
      if (!IsChosen(run.name)) continue;
      ++all_;
      attempts_[run.name] = run.attempts;
      if (run.is_done)
      {
        ++done_;
        known_times_.emplace_back(run.name.point, run.wall_s);
      }
      else if (run.has_failed && run.attempts > options_.retries)
      {
        ++failed_;
      }
      else
      {
        Enqueue(run.name);
      }
    }
  }

  void Enqueue(const RunName& name)
  {
    queue_.push_back(name);
    ++waiting_[name.point];
  }

  void Loop(Executor& pool, SweepProgress& progress)
  {
    auto committed = std::chrono::steady_clock::now();
    while (!pool.IsIdle() || (!queue_.empty() && !IsEnding()) || Extend(progress))
    {
      while (!IsEnding() && !queue_.empty() && pool.HasRoom())
      {
        const RunName name = queue_.front();
        queue_.pop_front();
        if (--waiting_[name.point] == 0) waiting_.erase(name.point);
        open_.insert(name);
        pool.Give({name, design_.ExperimentOf(name.point), design_.SettingsOf(name.point)});
      }
      for (const RunOutcome& outcome : pool.Wait(100ms)) Take(outcome, progress);
      for (const std::string& note : pool.TakeNotes()) progress.Say(note);
      const auto now = std::chrono::steady_clock::now();
      progress.Show(pool, waiting_, now);
      if (now - committed < 500ms) continue;
      committed = now;
      Commit(pool);
    }
  }

  // Returns whether no more runs are started.
  bool IsEnding() const { return Interrupted() || is_study_wrong_; }

  void Take(const RunOutcome& outcome, SweepProgress& progress)
  {
    // The result belongs to a run that is not requested now, or has another result already.
    if (open_.erase(outcome.name) == 0)
    {
      if (outcome.IsDone() && !store_.IsDone(outcome.name)) store_.Add(outcome);
      return;
    }
    store_.Add(outcome);
    if (outcome.IsDone())
    {
      ++done_;
      progress.Done();
      progress.AddTime(outcome.name.point, outcome.wall_s);
      return;
    }
    const std::string values = design_.Text(outcome.name.point);
    progress.Say(fmt::format("run {}{} failed with exit code {}: {}; what it left is in {}/runs/{}",
                             outcome.name.Text(), values.empty() ? "" : " (" + values + ")", outcome.exit_code,
                             outcome.failure, store_.Folder(), outcome.name.Text()));
    // The run did its ticks, and then a metric found that the study names something that does not exist.
    if (outcome.exit_code == kExitInvalidFile && outcome.ticks > 0) is_study_wrong_ = true;
    if (++attempts_[outcome.name] <= options_.retries && !is_study_wrong_)
      Enqueue(outcome.name);
    else
      ++failed_;
  }

  const SweepOptions& options_;
  const Study& study_;
  const Design& design_;
  StudyStore& store_;
  std::optional<Expression> only_;
  std::string column_;  // the column of --until-ci
  double share_ = 0;
  std::deque<RunName> queue_;
  std::map<std::uint32_t, std::size_t> waiting_;  // queued runs, by point
  std::set<RunName> open_;                        // given to the executor, without an outcome
  std::map<RunName, unsigned> attempts_;
  std::vector<std::pair<std::uint32_t, double>> known_times_;
  std::size_t all_ = 0, done_ = 0, failed_ = 0;
  bool is_study_wrong_ = false;
};

// Tells the time and the disk space of some runs.
void TellEstimate(const SweepOptions& options, const Study& study, const Design& design, std::size_t runs)
{
  const StudyEstimate estimate = EstimateOf(study, design);
  if (!estimate.failure.empty()) return PrintError("there is no estimate of time and disk: {}\n", estimate.failure);
  const std::string size = RoughSize(estimate.bytes_of_run * static_cast<double>(runs));
  const double seconds = estimate.seconds_of_run * static_cast<double>(runs);
  const bool is_here = options.hosts.empty() && options.slurm.empty();
  const unsigned jobs = JobsOf(options, study);
  PrintError("estimate: {:.2g} s a run, {} {}, {} on disk\n", estimate.seconds_of_run,
             RoughTime(is_here ? seconds / jobs : seconds),
             is_here ? fmt::format("with {} at a time", jobs) : std::string("of processor time"), size);
}

void ListRuns(const SweepOptions& options, const Study& study, const Design& design)
{
  std::optional<Expression> only;
  std::vector<std::string> names = study.FactorIds();
  const std::size_t factors = names.size();
  names.emplace_back("seed");
  if (!options.only.empty()) only.emplace(options.only, names);
  std::size_t runs = 0;
  for (std::size_t point = 0; point < design.Points(); ++point)
    for (const std::uint64_t seed : study.seeds)
    {
      const auto value_of = [&](std::size_t k) -> ExpressionValue
      { return k < factors ? design.Value(point, k) : static_cast<double>(seed); };
      if (only && !only->Holds(value_of)) continue;
      ++runs;
      const std::string values = design.Text(point);
      fmt::print("{}{}{} seed={}\n", RunName{static_cast<std::uint32_t>(point), seed}.Text(), values.empty() ? "" : " ",
                 values, seed);
    }
  std::fflush(stdout);  // the copies of this process would write it again
  PrintError("{} runs: {} points, {} seeds\n", runs, design.Points(), study.seeds.size());
  if (runs > 0) TellEstimate(options, study, design, runs);
}

bool HasExperimentsOf(const Study& study, StudyStore& store)
{
  try
  {
    return Design(study).ExperimentsHash() == store.Fact("experiments");
  }
  catch (const ConfigurationError&)
  {
    return false;
  }
}

// Loads the study from its file, or from the folder that is continued, with the experiments that it began with.
LoadedStudy LoadFor(const SweepOptions& options, StudyStore* store)
{
  if (store == nullptr) return LoadStudyFile(options.study);
  const std::vector<std::string> starts = store->StartsOfPaths();
  const auto load = [&](const std::string& start)
  { return LoadStudyText(store->Fact("study"), store->Fact("name") + ".xml", start); };
  for (const std::string& start : starts)
    if (LoadedStudy loaded = load(start); loaded.study && HasExperimentsOf(*loaded.study, *store)) return loaded;
  return load(starts.front());
}

void RefuseOtherExperiments(const Design& design, StudyStore& store)
{
  if (store.Fact("experiments") == design.ExperimentsHash()) return;
  throw UsageError(fmt::format(
      "an experiment of the study has changed since '{}' was begun, so that its runs would not go together; begin "
      "again in another folder",
      store.Folder()));
}

void RefuseWrongTogether(const SweepOptions& options)
{
  if (!options.hosts.empty() && !options.slurm.empty())
    throw UsageError(
        "--hosts and --slurm: runs are either on machines that you name or on those that Slurm gives; keep one");
  if (options.runs_per_task != 0 && options.slurm.empty())
    throw UsageError("--runs-per-task: only Slurm has tasks; give --slurm, too, or leave it out");
  if (!options.hosts.empty()) MachinesOf(options);
  if (!options.slurm.empty()) SlurmOptions(options.slurm.front());
  if (!options.hosts.empty() && options.jobs != 0)
    throw UsageError(
        "--jobs and --hosts: each machine has runs of its own; write `cores HOST = N` into the file of --hosts");
}

int SweepChecked(const SweepOptions& options)
{
  RefuseWrongTogether(options);
  std::unique_ptr<StudyStore> store;
  if (options.resume) store = StudyStore::Open(options.study);
  const LoadedStudy loaded = LoadFor(options, store.get());
  if (Complain(loaded.errors)) return kExitInvalidFile;
  const Study& study = *loaded.study;
  const Design design(study);
  RequireReproducibleMath();
  RegisterBuiltins();
  const std::vector<std::string> mistakes = MistakesInRuns(study, design);
  for (const std::string& mistake : mistakes) PrintError("{}\n", mistake);
  if (!mistakes.empty()) return kExitInvalidFile;
  if (study.search && !(options.only.empty() && options.until_ci.empty()))
    throw UsageError("a study with a <search> chooses its runs itself; leave --only and --until-ci out");
  if (study.search && !(options.hosts.empty() && options.slurm.empty()))
    throw UsageError("a study with a <search> runs on this machine; leave --hosts and --slurm out");
  if (study.search) CheckSearch(study);
  if (options.dry_run && study.search)
  {
    DescribeSearch(study);
    return kExitDone;
  }
  if (options.dry_run)
  {
    ListRuns(options, study, design);
    return kExitDone;
  }
  if (store)
  {
    RefuseOtherExperiments(design, *store);
    if (options.slurm.empty()) SettleSlurm(*store);
  }
  else
    store = StudyStore::Create(options.output.empty() ? NewFolder(study.name) : options.output, study, design);
  if (study.search) return RunSearch({options.jobs, options.retries, options.quiet}, study, *store);
  if (!options.quiet)
    PrintError("study {}: {} points, {} seeds, in {}\n", study.name, design.Points(), study.seeds.size(),
               store->Folder());
  return Sweeper(options, study, design, *store).Run();
}

}  // namespace

std::vector<std::string> MistakesInRuns(const Study& study, const Design& design)
{
  std::vector<std::string> mistakes = ConflictsIn(study, design);
  if (!mistakes.empty()) return mistakes;
  const auto add = [&](std::string text)
  {
    if (std::find(mistakes.begin(), mistakes.end(), text) == mistakes.end()) mistakes.push_back(std::move(text));
  };
  for (const std::size_t point : design.PointsOfAllLevels(kMostTried))
  {
    LoadOptions changes;
    changes.settings = design.SettingsOf(point);
    changes.settings.emplace_back("framework.seed", std::to_string(study.seeds.front()));
    const LoadedExperiment loaded = LoadExperimentFile(design.ExperimentOf(point), changes);
    for (const Diagnostic& error : loaded.errors) add(MistakeText(study, design, point, error));
    try
    {
      if (loaded.experiment)
      {
        const Recorder tried(study, *loaded.experiment);
        if (loaded.experiment->max_clock == 0 && loaded.experiment->functions.empty())
          add(fmt::format("{}: its runs would never end; give <study> 'ticks', or the experiment a maxclock",
                          design.ExperimentOf(point)));
      }
    }
    catch (const ConfigurationError& error)
    {
      add(error.what());
    }
    if (mistakes.size() >= kMostTold) break;
  }
  return mistakes;
}

int Sweep(const SweepOptions& options)
{
  try
  {
    return SweepChecked(options);
  }
  catch (const ExpressionError& error)
  {
    throw UsageError(fmt::format("--only: {}", error.what()));
  }
  catch (const StudyStoreError& error)
  {
    throw UsageError(error.what());
  }
}

}  // namespace swarmanoid
