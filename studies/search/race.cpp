// Problem: which of many points is best on average, if values of one point differ between seeds, and each value costs a
// run.
//
// Method (names as in Lopez-Ibanez et al., 2016): an iteration draws candidates, first everywhere, then near those that
// survived, in ranges that shrink. The candidates race: all run with the same seed, then with the next. After five
// seeds (T_first) and each further one, Friedman's test with Conover's comparison to the best drops the worse ones;
// between the last two Wilcoxon's test does. The race ends if few are left, or the runs of the iteration or the seeds
// are used up. A survivor is dropped only by candidates that ran with all of its seeds (elitist racing).
//
// Invariants: runs are ordered by iteration, seed and candidate; random numbers are named by iteration and candidate.
// So equal values give the same race, however many runs are executed at a time and however often it is interrupted.
#include "studies/search/race.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "common/math/random.h"
#include "studies/tables/statistics.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kFirstTest = 5;  // seeds before the first test
constexpr double kLevel = 0.05;        // of each test
constexpr double kFirstDeviation = 0.5;
constexpr int kTries = 100;  // to draw a candidate that is allowed and new

struct Candidate
{
  std::vector<double> place;
  std::string identity;
  std::vector<std::vector<double>> probabilities;  // by side, of its values; empty for a range
  std::size_t seeds = 0;                           // with which it survived a race
};

// Returns the middle of one of `levels` equal parts of a side.
double MiddleOf(std::size_t level, std::size_t levels)
{
  return (static_cast<double>(level) + 0.5) / static_cast<double>(levels);
}

std::size_t LevelAt(double share, std::size_t levels)
{
  return std::min(static_cast<std::size_t>(share * static_cast<double>(levels)), levels - 1);
}

// Returns one of the choices with a probability in proportion to its weight.
std::size_t Drawn(const std::vector<double>& weights, RandomStream& random)
{
  double left = random.Uniform() * std::accumulate(weights.begin(), weights.end(), 0.0);
  for (std::size_t i = 0; i + 1 < weights.size(); ++i)
    if ((left -= weights[i]) < 0) return i;
  return weights.size() - 1;
}

double DrawnNear(double middle, double deviation, RandomStream& random)
{
  for (int i = 0; i < kTries; ++i)
    if (const double share = random.Gaussian(middle, deviation); share >= 0 && share <= 1) return share;
  return middle;
}

}  // namespace

// All iterations from the first one on, as far as the values are known.
class RaceReplay
{
public:
  RaceReplay(const Race& race, const Race::Known& known) : race_(race), known_(known) {}

  Race::Step Run()
  {
    double deviation = kFirstDeviation;
    for (step_.iteration = 1;; ++step_.iteration)
    {
      const std::size_t left = race_.search_.runs - used_.size();
      const std::size_t planned = std::max(race_.iterations_, step_.iteration) - step_.iteration + 1;
      const std::size_t runs = left / planned;
      const std::size_t drawn = race_.search_.population;
      const std::size_t count = drawn != 0 ? drawn : runs / (kFirstTest + std::min(step_.iteration, kFirstTest));
      std::vector<Candidate> candidates = elites_;
      Draw(count, deviation, candidates);
      const std::size_t added = candidates.size() - elites_.size();
      if (added == 0 || candidates.size() < 2 || !StartsWithin(candidates, left)) break;
      deviation *= std::pow(1 / static_cast<double>(added), 1 / static_cast<double>(race_.levels_.size()));
      const std::size_t used = used_.size();
      Compete(std::move(candidates), runs);
      // A race without a new run has drawn only points that earlier races knew.
      if (!step_.wanted.empty() || used_.size() == used) break;
    }
    return std::move(step_);
  }

private:
  bool IsNew(const Candidate& candidate, std::size_t seed) const { return !used_.contains({candidate.identity, seed}); }
  // Returns whether the candidates can run up to the first test.
  bool StartsWithin(const std::vector<Candidate>& candidates, std::size_t runs) const
  {
    std::size_t needed = 0;
    for (const Candidate& candidate : candidates)
      for (std::size_t seed = 0; seed < kFirstTest; ++seed) needed += IsNew(candidate, seed) ? 1 : 0;
    return needed <= runs;
  }

  // Adds candidates until there are `count`, or no more new ones are found.
  void Draw(std::size_t count, double deviation, std::vector<Candidate>& candidates) const
  {
    std::set<std::string> taken;
    for (const Candidate& candidate : candidates) taken.insert(candidate.identity);
    const auto add = [&](Candidate candidate)
    {
      const std::optional<std::string> identity = race_.identity_(candidate.place);
      if (!identity || !taken.insert(*identity).second) return false;
      candidate.identity = *identity;
      candidates.push_back(std::move(candidate));
      return true;
    };
    if (step_.iteration == 1) add(Begin());
    for (std::uint64_t number = candidates.size(); candidates.size() < count; ++number)
    {
      RandomStream random(race_.search_.random_seed, number, StreamName("race"), step_.iteration);
      int tries = 0;
      while (tries < kTries && !add(elites_.empty() ? Anywhere(random) : Near(deviation, random))) ++tries;
      if (tries == kTries) return;
    }
  }

  Candidate Begin() const
  {
    Candidate candidate{race_.start_, {}, {}, 0};
    for (const std::size_t levels : race_.levels_)
      candidate.probabilities.emplace_back(levels, levels == 0 ? 0 : 1 / static_cast<double>(levels));
    return candidate;
  }

  Candidate Anywhere(RandomStream& random) const
  {
    Candidate candidate = Begin();
    for (std::size_t side = 0; side < candidate.place.size(); ++side)
    {
      const std::size_t levels = race_.levels_[side];
      candidate.place[side] =
          levels == 0 ? random.Uniform() : MiddleOf(random.Below(static_cast<std::uint32_t>(levels)), levels);
    }
    return candidate;
  }

  // Draws near a survivor, a better one more often.
  Candidate Near(double deviation, RandomStream& random) const
  {
    std::vector<double> weights(elites_.size());
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = static_cast<double>(weights.size() - i);
    Candidate candidate = elites_[Drawn(weights, random)];
    candidate.seeds = 0;
    // The probability of the survivor's own value grows from iteration to iteration.
    const double kept =
        std::min(1.0, static_cast<double>(step_.iteration - 1) / static_cast<double>(race_.iterations_));
    for (std::size_t side = 0; side < candidate.place.size(); ++side)
    {
      const std::size_t levels = race_.levels_[side];
      if (levels == 0)
      {
        candidate.place[side] = DrawnNear(candidate.place[side], deviation, random);
        continue;
      }
      std::vector<double>& probabilities = candidate.probabilities[side];
      for (double& probability : probabilities) probability *= 1 - kept;
      probabilities[LevelAt(candidate.place[side], levels)] += kept;
      candidate.place[side] = MiddleOf(Drawn(probabilities, random), levels);
    }
    return candidate;
  }

  // Races the candidates with at most `runs` new runs, or stops at unknown values.
  void Compete(std::vector<Candidate> candidates, std::size_t runs)
  {
    const std::size_t end = used_.size() + runs;
    std::vector<std::vector<double>> values;  // by seed and candidate
    for (std::size_t seed = 0; seed < race_.seeds_; ++seed)
    {
      const auto added = static_cast<std::size_t>(std::count_if(
          candidates.begin(), candidates.end(), [&](const Candidate& candidate) { return IsNew(candidate, seed); }));
      const std::size_t limit = seed < kFirstTest ? race_.search_.runs : std::min<std::size_t>(end, race_.search_.runs);
      if (used_.size() + added > limit) break;
      step_.alive = candidates.size();
      std::vector<double> row;
      for (const Candidate& candidate : candidates)
      {
        used_.insert({candidate.identity, seed});
        const KnownValue value = known_(candidate.place, seed);
        if (value.kind == KnownValue::Kind::kUnknown) step_.wanted.push_back({candidate.place, seed});
        row.push_back(value.kind == KnownValue::Kind::kValue ? value.value : std::numeric_limits<double>::infinity());
      }
      if (!step_.wanted.empty()) return;
      values.push_back(std::move(row));
      if (seed + 1 < kFirstTest) continue;
      DropWorse(candidates, values);
      const bool are_equally_tested =
          std::all_of(candidates.begin(), candidates.end(),
                      [&](const Candidate& candidate) { return candidate.seeds <= seed + 1; });
      if (candidates.size() <= race_.most_survivors_ && are_equally_tested) break;
    }
    TakeSurvivors(std::move(candidates), values);
  }

  void DropWorse(std::vector<Candidate>& candidates, std::vector<std::vector<double>>& values) const
  {
    const std::vector<bool> is_worse = WorseOnes(values);
    const auto keeps = [&](std::size_t i) { return !is_worse[i] || candidates[i].seeds > values.size(); };
    std::vector<Candidate> left;
    std::vector<std::vector<double>> left_values(values.size());
    for (std::size_t i = 0; i < candidates.size(); ++i)
    {
      if (!keeps(i)) continue;
      for (std::size_t seed = 0; seed < values.size(); ++seed) left_values[seed].push_back(values[seed][i]);
      left.push_back(std::move(candidates[i]));
    }
    candidates = std::move(left);
    values = std::move(left_values);
  }

  // Returns for each candidate whether a test shows that it is worse than the best one.
  static std::vector<bool> WorseOnes(const std::vector<std::vector<double>>& values)
  {
    const std::size_t count = values.front().size();
    std::vector<bool> is_worse(count);
    if (count < 2) return is_worse;
    const FriedmanTest test = FriedmanTestOf(values, kLevel);
    if (count == 2)
    {
      std::vector<double> differences;
      for (const std::vector<double>& row : values)
        differences.push_back(row[0] == row[1] ? 0 : std::clamp(row[0] - row[1], -1e300, 1e300));
      if (WilcoxonP(differences) < kLevel && test.rank_sums[0] != test.rank_sums[1])
        is_worse[test.rank_sums[0] < test.rank_sums[1] ? 1 : 0] = true;
      return is_worse;
    }
    if (!(test.p < kLevel)) return is_worse;
    const double best = *std::min_element(test.rank_sums.begin(), test.rank_sums.end());
    for (std::size_t i = 0; i < count; ++i) is_worse[i] = test.rank_sums[i] - best > test.critical_difference;
    return is_worse;
  }

  void TakeSurvivors(std::vector<Candidate> candidates, const std::vector<std::vector<double>>& values)
  {
    std::vector<std::size_t> order(candidates.size());
    std::iota(order.begin(), order.end(), 0);
    std::vector<double> sums(candidates.size());
    for (const std::vector<double>& row : values)
    {
      const std::vector<double> ranks = RanksOf(row);
      for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += ranks[i];
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sums[a] < sums[b]; });
    order.resize(std::min(order.size(), race_.most_survivors_));
    elites_.clear();
    step_.survivors.clear();
    for (const std::size_t i : order)
    {
      candidates[i].seeds = std::max(candidates[i].seeds, values.size());
      step_.survivors.push_back(candidates[i].place);
      elites_.push_back(std::move(candidates[i]));
    }
  }

  const Race& race_;
  const Race::Known& known_;
  std::vector<Candidate> elites_;
  std::set<std::pair<std::string, std::size_t>> used_;  // runs, by identity and seed
  Race::Step step_;
};

Race::Race(const SearchChoice& search, std::vector<double> start, std::vector<std::size_t> levels, std::size_t seeds,
           Identity identity)
    : search_(search),
      start_(std::move(start)),
      levels_(std::move(levels)),
      seeds_(seeds),
      identity_(std::move(identity))
{
  iterations_ = most_survivors_ = 2 + static_cast<std::size_t>(std::log2(static_cast<double>(levels_.size())));
  if (seeds_ < kFirstTest)
    throw ConfigurationError(
        search.location, fmt::format("a race tests its candidates from the seed number {} on, and the study has {}: "
                                     "give it more 'seeds', such as 1-50, of which bad candidates use few",
                                     kFirstTest, seeds_));
  const std::size_t least =
      search.population != 0 ? search.population * kFirstTest : iterations_ * (most_survivors_ + 1) * (kFirstTest + 1);
  if (search.population == 1 || search.runs < least)
    throw ConfigurationError(
        search.location, search.population == 1 ? std::string("a race has a population of 2 or more")
                                                : fmt::format("{} runs are too few for races over {} factors: take {} "
                                                              "or more",
                                                              search.runs, levels_.size(), least));
}

Race::Step Race::Next(const Known& known) const { return RaceReplay(*this, known).Run(); }

}  // namespace swarmanoid
