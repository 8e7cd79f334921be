// Runs a study with a <search>. Each step asks the Optimiser for places, or the Race for runs, makes points of them,
// executes their runs, and stores the results. Its own state is only what the database has: points by the text of their
// values, and results by point and seed. So a step after a kill equals the step before it. At the end, the best point
// is run with fresh seeds, since the best of many noisy values is too good by chance.
#include "studies/search/search.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <deque>
#include <map>
#include <optional>
#include <set>

#include "common/errors/exit_codes.h"
#include "common/errors/print_error.h"
#include "common/program/interrupts.h"
#include "common/program/shell_word.h"
#include "common/space/space.h"
#include "studies/executors/run_pool.h"
#include "studies/metrics/metric.h"
#include "studies/search/optimiser.h"
#include "studies/search/race.h"
#include "studies/search/search_space.h"
#include "studies/tables/statistics.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using SearchClock = std::chrono::steady_clock;

// This limit ends an algorithm that only asks for known values, for example if all whole numbers are known.
constexpr std::size_t kQuestionsOfPoint = 50;

std::size_t MostPoints(const Study& study) { return std::max<std::size_t>(1, study.search->runs / study.seeds.size()); }

int MostQuestions(const Study& study)
{
  return static_cast<int>(std::min<std::size_t>(kQuestionsOfPoint * (1000 + MostPoints(study)), 1'000'000'000));
}

Race RaceOf(const Study& study, const SearchSpace& space)
{
  const auto identity = [&space](std::span<const double> place) -> std::optional<std::string>
  {
    const std::vector<ExpressionValue> values = space.Values(place);
    return space.Allows(values) ? std::optional(space.Text(values)) : std::nullopt;
  };
  return {*study.search, space.Start(), space.Levels(), study.seeds.size(), identity};
}

std::string SizeText(const Study& study)
{
  const SearchChoice& search = *study.search;
  if (search.algorithm == kRace)
    return fmt::format("races of at most {} runs, over at most {} seeds", search.runs, study.seeds.size());
  return fmt::format("a search of at most {} points, {} seeds each", MostPoints(study), study.seeds.size());
}

// The state of one search, over the runs of this process and earlier ones.
class Searcher
{
public:
  Searcher(const SearchOptions& options, const Study& study, StudyStore& store)
      : options_(options), study_(study), search_(*study.search), store_(store), space_(study)
  {
    if (search_.algorithm == kRace)
      race_.emplace(RaceOf(study, space_));
    else
      optimiser_.emplace(search_, space_.Start(), MostQuestions(study));
    const std::vector<std::string>& columns = store.Columns();
    column_ = static_cast<std::size_t>(std::find(columns.begin(), columns.end(), search_.column) - columns.begin());
    for (auto& [point, values] : store.PointValues())
    {
      point_of_[space_.Text(values)] = point;
      values_.push_back(std::move(values));
    }
    results_ = store.LastValues(search_.column);
    for (const StudyStore::RunState& run : store.Runs()) attempts_[run.name] = 0;
  }

  int Run()
  {
    CatchInterrupts(SecondInterrupt::kKills);
    const auto start = SearchClock::now();
    const unsigned cores = static_cast<unsigned>(UsableCores().size());
    RunPool pool(study_, store_.Folder(), options_.jobs != 0 ? options_.jobs : study_.cluster ? 1 : cores);
    bool is_whole = false;
    std::string end;
    try
    {
      end = race_ ? RunRaces(pool) : Search(pool);
      is_whole = !end.empty() && RunFresh(pool);
      store_.Commit();
      store_.WriteTable();
    }
    catch (const StudyStoreError& error)
    {
      Clear();
      PrintError("{}; what was stored before stays: mend the cause, then go on: swarmanoid sweep {} --resume\n",
                 error.what(), ShellWord(store_.Folder()));
      return kExitProcessFailed;
    }
    Clear();
    if (is_whole) Report(end);
    const double seconds = std::chrono::duration<double>(SearchClock::now() - start).count();
    if (is_whole)
      fmt::print("finished: {} runs, 0 failed, {:.3f} s, table {}/table.csv\n", results_.size(), seconds,
                 store_.Folder());
    else
      PrintError("{} runs of the search are done; to go on: swarmanoid sweep {} --resume\n", results_.size(),
                 ShellWord(store_.Folder()));
    return is_whole ? kExitDone : has_failed_ ? kExitProcessFailed : kExitInterrupted;
  }

private:
  std::size_t MostPoints() const { return swarmanoid::MostPoints(study_); }

  // Returns why the search has ended; empty if it was interrupted, or if a run failed.
  std::string Search(RunPool& pool)
  {
    while (true)
    {
      const auto wanted = optimiser_->Next([this](std::span<const double> place) { return KnownAt(place); });
      if (wanted.empty()) return "the algorithm found no better place to try";
      const std::string end = EndOfPatience();
      if (!end.empty()) return end;
      std::vector<RunName> runs;
      bool is_new = false;
      for (const std::vector<double>& place : wanted)
      {
        const auto point = PointAt(space_.Values(place));
        if (!point) break;
        is_new = true;
        for (const std::uint64_t seed : study_.seeds)
          if (!results_.contains({*point, seed})) runs.push_back({*point, seed});
      }
      if (!is_new) return fmt::format("its {} runs are used up", search_.runs);
      store_.Commit();
      std::sort(runs.begin(), runs.end());
      runs.erase(std::unique(runs.begin(), runs.end()), runs.end());
      if (!RunAll(pool, runs)) return "";
      RequireValueAtStart();
    }
  }

  // Returns as Search.
  std::string RunRaces(RunPool& pool)
  {
    while (true)
    {
      Race::Step step = race_->Next([this](std::span<const double> place, std::size_t seed)
                                    { return KnownRun(place, study_.seeds[seed]); });
      winner_.reset();
      if (!step.survivors.empty()) winner_ = PointOf(space_.Values(step.survivors.front()));
      state_ = fmt::format("race {}, {} candidates left", step.iteration, step.alive);
      if (step.wanted.empty())
      {
        if (!winner_)
          throw ConfigurationError(search_.location,
                                   "the conditions allow only one point, and a race needs two or more");
        if (!ValueOf(*winner_))
          throw ConfigurationError(search_.location,
                                   fmt::format("not all runs of the best point have a value of {}", search_.column));
        return fmt::format("{} races used {} of {} runs", step.iteration - 1, RunsOfSeeds(), search_.runs);
      }
      std::vector<RunName> runs;
      for (const RaceRun& run : step.wanted)
      {
        const std::uint64_t seed = study_.seeds[run.seed];
        const std::vector<ExpressionValue> values = space_.Values(run.place);
        const RunName name{PointOf(values), seed};
        if (attempts_.try_emplace(name).second) store_.AddPoint(name.point, values, {seed});
        runs.push_back(name);
      }
      store_.Commit();
      std::sort(runs.begin(), runs.end());
      if (!RunAll(pool, runs)) return "";
    }
  }

  std::size_t RunsOfSeeds() const
  {
    return static_cast<std::size_t>(std::count_if(
        results_.begin(), results_.end(),
        [this](const auto& result)
        { return std::find(study_.seeds.begin(), study_.seeds.end(), result.first.seed) != study_.seeds.end(); }));
  }

  KnownValue KnownRun(std::span<const double> place, std::uint64_t seed) const
  {
    const auto point = point_of_.find(space_.Text(space_.Values(place)));
    const auto found = point == point_of_.end() ? results_.end() : results_.find({point->second, seed});
    if (found == results_.end()) return {KnownValue::Kind::kUnknown};
    if (std::isnan(found->second)) return {KnownValue::Kind::kRefused};
    return {KnownValue::Kind::kValue, search_.maximise ? -found->second : found->second};
  }

  void RequireValueAtStart() const
  {
    if (!ValueOf(0))
      throw ConfigurationError(search_.location,
                               fmt::format("where the search begins, at {}, not all runs have a value of {}: give the "
                                           "factors a 'start' where they do",
                                           space_.Text(values_[0]), search_.column));
  }

  KnownValue KnownAt(std::span<const double> place) const
  {
    const std::vector<ExpressionValue> values = space_.Values(place);
    if (!space_.Allows(values)) return {KnownValue::Kind::kRefused};
    const auto found = point_of_.find(space_.Text(values));
    if (found == point_of_.end() || !IsRun(found->second)) return {KnownValue::Kind::kUnknown};
    const auto value = ValueOf(found->second);
    if (!value) return {KnownValue::Kind::kRefused};
    return {KnownValue::Kind::kValue, search_.maximise ? -*value : *value};
  }

  bool IsRun(std::uint32_t point) const
  {
    return std::all_of(study_.seeds.begin(), study_.seeds.end(),
                       [&](std::uint64_t seed) {
                         return results_.contains({point, seed});
                       });
  }

  // Returns the seeds of the study with which the point has run.
  std::vector<std::uint64_t> SeedsOf(std::uint32_t point) const
  {
    std::vector<std::uint64_t> seeds;
    for (const std::uint64_t seed : study_.seeds)
      if (results_.contains({point, seed})) seeds.push_back(seed);
    return seeds;
  }

  // Returns the value of a point over the seeds that it has; nothing if one of its runs has no value.
  std::optional<double> ValueOf(std::uint32_t point) const { return ValueOver(point, SeedsOf(point)); }
  std::optional<double> ValueOver(std::uint32_t point, const std::vector<std::uint64_t>& seeds) const
  {
    std::vector<double> values;
    for (const std::uint64_t seed : seeds)
    {
      const double value = results_.at({point, seed});
      if (std::isnan(value)) return std::nullopt;
      values.push_back(value);
    }
    const double whole = Aggregate(search_.aggregate, values);
    return std::isnan(whole) ? std::nullopt : std::optional(whole);
  }

  // Returns the point of these values. It is made if it is new and the limit is not reached.
  std::optional<std::uint32_t> PointAt(const std::vector<ExpressionValue>& values)
  {
    const std::string text = space_.Text(values);
    if (const auto found = point_of_.find(text); found != point_of_.end()) return found->second;
    if (values_.size() >= MostPoints()) return std::nullopt;
    const std::uint32_t point = PointOf(values);
    store_.AddPoint(point, values, study_.seeds);
    return point;
  }

  // Returns the number of the point of these values, a new one if there is none.
  std::uint32_t PointOf(const std::vector<ExpressionValue>& values)
  {
    const auto [found, is_new] = point_of_.try_emplace(space_.Text(values), static_cast<std::uint32_t>(values_.size()));
    if (is_new) values_.push_back(values);
    return found->second;
  }

  // Returns the best of the finished points, the first of equal ones; of races the winner of the last one.
  std::optional<std::uint32_t> Best() const
  {
    if (race_) return winner_;
    std::optional<std::uint32_t> best;
    double best_value = 0;
    for (std::uint32_t point = 0; point < values_.size(); ++point)
    {
      const auto value = IsRun(point) ? ValueOf(point) : std::nullopt;
      if (!value || (best && (search_.maximise ? *value <= best_value : *value >= best_value))) continue;
      best = point;
      best_value = *value;
    }
    return best;
  }

  std::string EndOfPatience() const
  {
    // An earlier process may have ended within a generation; the search continues there.
    for (std::uint32_t point = 0; point < values_.size(); ++point)
      if (!IsRun(point)) return "";
    const auto best = search_.patience == 0 ? std::nullopt : Best();
    if (!best || values_.size() - *best <= search_.patience) return "";
    return fmt::format("{} points in a row were no better", search_.patience);
  }

  std::vector<std::uint64_t> FreshSeeds() const
  {
    const std::uint64_t last = *std::max_element(study_.seeds.begin(), study_.seeds.end());
    std::vector<std::uint64_t> seeds;
    for (std::uint64_t i = 1; i <= search_.fresh_seeds; ++i) seeds.push_back(last + i);
    return seeds;
  }

  bool RunFresh(RunPool& pool)
  {
    const std::uint32_t best = *Best();
    std::vector<RunName> runs;
    std::vector<std::uint64_t> added;
    for (const std::uint64_t seed : FreshSeeds())
    {
      if (!results_.contains({best, seed})) runs.push_back({best, seed});
      if (!attempts_.contains({best, seed})) added.push_back(seed);
    }
    store_.AddPoint(best, values_[best], added);
    store_.Commit();
    return RunAll(pool, runs);
  }

  // Returns false if not all runs are done.
  bool RunAll(RunPool& pool, const std::vector<RunName>& runs)
  {
    std::deque<RunName> queue(runs.begin(), runs.end());
    auto committed = SearchClock::now();
    while (!pool.IsIdle() || (!queue.empty() && !Interrupted() && !has_failed_))
    {
      while (!Interrupted() && !has_failed_ && !queue.empty() && pool.HasRoom())
      {
        const RunName name = queue.front();
        queue.pop_front();
        pool.Give({name, space_.Experiment(values_[name.point]), space_.Settings(values_[name.point])});
      }
      for (const RunOutcome& outcome : pool.Wait(100ms)) Take(outcome, queue);
      const auto now = SearchClock::now();
      Show(now);
      if (now - committed < 500ms) continue;
      committed = now;
      store_.Commit();
    }
    store_.Commit();
    return queue.empty() && !has_failed_;
  }

  void Take(const RunOutcome& outcome, std::deque<RunName>& queue)
  {
    store_.Add(outcome);
    if (outcome.IsDone())
    {
      const std::vector<double>& values = outcome.samples.values;
      results_[outcome.name] = values[values.size() - store_.Columns().size() + column_];
      return;
    }
    Clear();
    PrintError("run {} ({}) failed with exit code {}: {}; what it left is in {}/runs/{}\n", outcome.name.Text(),
               space_.Text(values_[outcome.name.point]), outcome.exit_code, outcome.failure, store_.Folder(),
               outcome.name.Text());
    if (++attempts_[outcome.name] <= options_.retries)
      queue.push_back(outcome.name);
    else
      has_failed_ = true;
  }

  void Show(SearchClock::time_point now)
  {
    if (options_.quiet || now < next_) return;
    next_ = now + (terminal_ ? SearchClock::duration(200ms) : SearchClock::duration(10s));
    std::string line = race_ ? fmt::format("{}, {} of at most {} runs", state_, results_.size(), search_.runs)
                             : fmt::format("point {} of at most {}, {} run{}", values_.size(), MostPoints(),
                                           results_.size(), results_.size() == 1 ? "" : "s");
    if (const auto best = Best())
      if (const auto value = ValueOf(*best))
        line += fmt::format("; best {} {:.6g} ({})", search_.column, *value, space_.Text(values_[*best]));
    Clear();
    PrintError("{}{}", line, terminal_ ? "" : "\n");
    std::fflush(stderr);
    is_shown_ = terminal_;
  }

  void Clear()
  {
    if (is_shown_) fmt::print(stderr, "\r\033[K");
    is_shown_ = false;
  }

  void Report(const std::string& end) const
  {
    const std::uint32_t best = *Best();
    const std::size_t seeds = SeedsOf(best).size();
    fmt::print("the search ended after {} points: {}\n", values_.size(), end);
    fmt::print("best: point {}, {}\n", best, space_.Text(values_[best]));
    fmt::print("{} ({} of {} seed{}): {:.6g} in the search, which is flattered, as it was chosen by it\n",
               search_.column, search_.aggregate, seeds, seeds == 1 ? "" : "s", *ValueOf(best));
    std::vector<double> fresh;
    for (const std::uint64_t seed : FreshSeeds())
      if (const double value = results_.at({best, seed}); !std::isnan(value)) fresh.push_back(value);
    if (fresh.size() > 1)
    {
      fmt::print("{} with {} fresh seeds: mean {} (95 %)", search_.column, fresh.size(),
                 IntervalText(MeanIntervalOf(fresh)));
      if (search_.aggregate != "mean")
        fmt::print(", {} {:.6g}", search_.aggregate, Aggregate(search_.aggregate, fresh));
      fmt::print("\n");
    }
    std::string words;
    for (const auto& [path, value] : space_.Settings(values_[best])) words += " --set " + ShellWord(path + "=" + value);
    fmt::print("swarmanoid run {} --single-process{}\n", ShellWord(space_.Experiment(values_[best])), words);
  }

  const SearchOptions options_;
  const Study& study_;
  const SearchChoice& search_;
  StudyStore& store_;
  SearchSpace space_;
  // One of both.
  std::optional<Optimiser> optimiser_;
  std::optional<Race> race_;
  std::optional<std::uint32_t> winner_;  // of the last race that ended
  std::string state_;                    // of the race, for the progress line
  std::size_t column_ = 0;
  std::map<std::string, std::uint32_t> point_of_;     // by the text of its values
  std::vector<std::vector<ExpressionValue>> values_;  // by point
  std::map<RunName, double> results_;                 // by finished run; NaN: no value
  std::map<RunName, unsigned> attempts_;              // failed attempts, by requested run
  bool has_failed_ = false;
  bool terminal_ = isatty(STDERR_FILENO) != 0;
  bool is_shown_ = false;
  SearchClock::time_point next_ = SearchClock::now();
};

}  // namespace

int RunSearch(const SearchOptions& options, const Study& study, StudyStore& store)
{
  try
  {
    if (!options.quiet) PrintError("study {}: {}, in {}\n", study.name, SizeText(study), store.Folder());
    return Searcher(options, study, store).Run();
  }
  catch (const ConfigurationError& error)
  {
    PrintError("{}\n", error.what());
    return kExitInvalidFile;
  }
}

void CheckSearch(const Study& study)
{
  const SearchSpace space(study);
  if (study.search->algorithm == kRace)
    const Race checked = RaceOf(study, space);
  else
    const Optimiser checked(*study.search, space.Start(), 1);
  const std::vector<ExpressionValue> values = space.Values(space.Start());
  if (!space.Allows(values))
    throw ConfigurationError(
        study.conditions.front().location,
        fmt::format("the search begins at {}, which the conditions do not allow: give the factors a 'start'",
                    space.Text(values)));
}

void DescribeSearch(const Study& study)
{
  const SearchChoice& search = *study.search;
  for (const Factor* factor : study.Factors())
  {
    if (factor->range)
      fmt::print("{}: {} to {}{}{}\n", factor->id, factor->levels.front().value, factor->levels.back().value,
                 factor->range->step > 0 ? fmt::format(" in steps of {:.12g}", factor->range->step) : "",
                 factor->range->logarithmic ? ", logarithmic" : "");
    else
    {
      std::string values;
      for (const FactorLevel& level : factor->levels) values += (values.empty() ? "" : ", ") + level.value;
      fmt::print("{}: {}\n", factor->id, values);
    }
  }
  const SearchSpace space(study);
  fmt::print("begins at {}\n", space.Text(space.Values(space.Start())));
  fmt::print("{} of {} ({} of {} seeds), by {}\n", search.maximise ? "most" : "least", search.column, search.aggregate,
             study.seeds.size(), search.algorithm);
  if (search.algorithm == kRace)
    PrintError("{}, and {} with fresh seeds\n", SizeText(study), search.fresh_seeds);
  else
    PrintError("at most {} points, {} runs, and {} with fresh seeds\n", MostPoints(study),
               MostPoints(study) * study.seeds.size(), search.fresh_seeds);
}

}  // namespace swarmanoid
