// Problem: an algorithm of NLopt asks for one value at a time and cannot be stopped and stored, but runs of a study
// take long, are executed in parallel, and must survive a kill.
//
// Method: the algorithm is started again for each step, with the same random seed. All known values are answered at
// once, so that it asks the same questions as before. At the first unknown value the pass goes on to the end of the
// generation, whose questions do not depend on each other, collects the unknown places, and stops. Refused places get a
// value that is worse than all known ones by their whole spread.
//
// CMA-ES is our own (cma_es.h). It begins again, with twice the population and at a random place, when it has converged
// or stalls (IPOP: A. Auger and N. Hansen, "A restart CMA evolution strategy with increasing population size", 2005).
// Its space has no borders: it is folded at the sides of the cube, as in pycma's BoundTransform, so that places on a
// side can be found and nothing is drawn twice as often.
//
// Invariant: the questions follow from the known values alone. Source: S. G. Johnson, The NLopt nonlinear-optimization
// package; docs/studies.md, "Searching for the best values".
#include "studies/search/optimiser.h"

#include <fmt/format.h>
#include <nlopt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <memory>
#include <stdexcept>

#include "common/math/random.h"
#include "studies/search/cma_es.h"

namespace swarmanoid
{
namespace
{

constexpr double kCmaStep = 0.3;            // the first deviation: the best place is expected within 3 of them
constexpr double kFold = 0.05;              // width of the fold at a side of the cube
constexpr std::uint64_t kMostRestarts = 9;  // that double the population

struct AlgorithmRow
{
  nlopt_algorithm algorithm;  // NLOPT_NUM_ALGORITHMS: none of NLopt's
  bool is_local;
  std::size_t population_per_dimension;  // its own population: this number times (dimensions + 1); 0: it has none
};

// In the order of kSearchAlgorithms.
constexpr std::array<AlgorithmRow, kSearchAlgorithms.size()> kAlgorithms = {{
    {NLOPT_GN_CRS2_LM, false, 10},
    {NLOPT_GN_ISRES, false, 20},
    {NLOPT_GN_DIRECT_L, false, 0},
    {NLOPT_LN_SBPLX, true, 0},
    {NLOPT_LN_BOBYQA, true, 0},
    {NLOPT_LN_COBYLA, true, 0},
    {NLOPT_LN_NELDERMEAD, true, 0},
    {NLOPT_NUM_ALGORITHMS, false, 0},
}};

const AlgorithmRow& RowOf(const std::string& name)
{
  const auto found = std::find(kSearchAlgorithms.begin(), kSearchAlgorithms.end(), name);
  return kAlgorithms[static_cast<std::size_t>(found - kSearchAlgorithms.begin())];
}

struct OptimiserDeleter
{
  void operator()(nlopt_opt optimiser) const { nlopt_destroy(optimiser); }
};

// One pass of the algorithm over the known values.
struct Pass
{
  Pass(const Optimiser::Known& known_values, std::function<std::size_t(std::size_t)> end)
      : known(known_values), end_of_generation(std::move(end))
  {
  }

  const Optimiser::Known& known;
  std::function<std::size_t(std::size_t)> end_of_generation;
  nlopt_opt optimiser = nullptr;
  std::size_t questions = 0;
  double best = HUGE_VAL, worst = -HUGE_VAL;
  bool is_over = false;
  std::vector<std::vector<double>> wanted;
  std::exception_ptr failure;

  double Answer(std::span<const double> place)
  {
    if (is_over) return HUGE_VAL;
    const std::size_t question = questions++;
    const KnownValue answer = known(place);
    double value = HUGE_VAL;
    if (answer.kind == KnownValue::Kind::kUnknown)
      wanted.emplace_back(place.begin(), place.end());
    else if (answer.kind == KnownValue::Kind::kValue)
      value = answer.value;
    else
      value = Refused();
    if (answer.kind == KnownValue::Kind::kValue) Learn(value);
    // Later questions could depend on the missing values.
    if (!wanted.empty() && question == end_of_generation(question)) Stop();
    return value;
  }
  void Learn(double value)
  {
    best = std::min(best, value);
    worst = std::max(worst, value);
  }
  double Margin() const { return std::max({worst - best, std::abs(worst), 1e-9}); }
  double Refused() const { return worst + Margin(); }
  void Stop()
  {
    is_over = true;
    nlopt_force_stop(optimiser);
  }
};

// No exception may cross the library, which is written in C.
double AnswerOfPass(unsigned dimensions, const double* place, double*, void* data)
{
  Pass& pass = *static_cast<Pass*>(data);
  try
  {
    return pass.Answer({place, dimensions});
  }
  catch (...)
  {
    pass.failure = std::current_exception();
    pass.Stop();
    return HUGE_VAL;
  }
}

// Folds the line to 0..1: the identity except near the ends, where it is a parabola, and mirrored beyond them.
double Folded(double x)
{
  const double period = 2 * (1 + 2 * kFold);
  double y = x + kFold - period * std::floor((x + kFold) / period);  // 0 is the lower turning point
  y = std::min(y, period - y) - kFold;
  if (y < kFold) return (y + kFold) * (y + kFold) / (4 * kFold);
  if (y > 1 - kFold) return 1 - (1 + kFold - y) * (1 + kFold - y) / (4 * kFold);
  return y;
}

// Returns the x between the turning points with Folded(x) = y.
double Unfolded(double y)
{
  if (y < kFold) return std::sqrt(4 * kFold * y) - kFold;
  if (y > 1 - kFold) return 1 + kFold - std::sqrt(4 * kFold * (1 - y));
  return y;
}

// Runs CMA-ES, and again after each end, until a value is unknown or the questions are used up.
class CmaPass
{
public:
  CmaPass(const SearchChoice& search, std::span<const double> start, std::size_t population, Pass& pass)
      : search_(search), start_(start), population_(population), pass_(pass), best_(Begin(0))
  {
  }

  void Run(std::size_t most_questions)
  {
    std::uint64_t run = 0;
    while (!pass_.is_over && pass_.questions < most_questions)
    {
      CmaEs evolution(Begin(run), kCmaStep, population_ << std::min(run, kMostRestarts), search_.random_seed, run);
      while (!pass_.is_over && pass_.questions < most_questions && evolution.Deviation() >= search_.tolerance &&
             !evolution.HasStalled())
        Generation(evolution);
      ++run;
    }
  }

private:
  // Returns the first mean of a run: the start of the search, later a random place.
  Eigen::VectorXd Begin(std::uint64_t run) const
  {
    Eigen::VectorXd mean(static_cast<Eigen::Index>(start_.size()));
    RandomStream random(search_.random_seed, run, StreamName("cma_es begin"), 0);
    for (std::size_t i = 0; i < start_.size(); ++i)
      mean[static_cast<Eigen::Index>(i)] = run == 0 ? Unfolded(start_[i]) : random.Uniform();
    return mean;
  }

  void Generation(CmaEs& evolution)
  {
    std::vector<KnownValue> answers;
    const std::vector<Eigen::VectorXd>& places = evolution.Ask();
    for (const Eigen::VectorXd& place : places)
    {
      std::vector<double> folded(place.begin(), place.end());
      for (double& side : folded) side = Folded(side);
      answers.push_back(pass_.known(folded));
      ++pass_.questions;
      if (answers.back().kind == KnownValue::Kind::kUnknown) pass_.wanted.push_back(std::move(folded));
    }
    if (!pass_.wanted.empty())
    {
      pass_.is_over = true;
      return;
    }
    for (std::size_t i = 0; i < answers.size(); ++i)
    {
      if (answers[i].kind != KnownValue::Kind::kValue) continue;
      if (answers[i].value < pass_.best) best_ = places[i];
      pass_.Learn(answers[i].value);
    }
    // Refused places are worse the further they are from an allowed one, so the distribution finds the way back.
    std::vector<double> values;
    for (std::size_t i = 0; i < answers.size(); ++i)
      values.push_back(answers[i].kind == KnownValue::Kind::kValue
                           ? answers[i].value
                           : pass_.Refused() + pass_.Margin() * (places[i] - best_).norm());
    evolution.Tell(values);
  }

  const SearchChoice& search_;
  std::span<const double> start_;
  std::size_t population_;
  Pass& pass_;
  Eigen::VectorXd best_;  // where the best value is; the start is allowed
};

}  // namespace

Optimiser::Optimiser(const SearchChoice& search, std::vector<double> start, int most_questions)
    : search_(search), start_(std::move(start)), most_questions_(most_questions)
{
  const AlgorithmRow& row = RowOf(search.algorithm);
  const bool is_cma = row.algorithm == NLOPT_NUM_ALGORITHMS;
  population_ = is_cma ? CmaEs::DefaultPopulation(start_.size()) : row.population_per_dimension * (start_.size() + 1);
  if (search.population == 0) return;
  if (population_ == 0)
    throw ConfigurationError(search.location, fmt::format("the algorithm {} has no population", search.algorithm));
  population_ = search.population;
  const std::size_t least = is_cma ? 4 : start_.size() + 1;
  if (population_ < least)
    throw ConfigurationError(search.location,
                             fmt::format("a population of {} is too small for {} factors: take {} or more", population_,
                                         start_.size(), least));
}

std::size_t Optimiser::EndOfGeneration(std::size_t question) const
{
  // ISRES asks for whole generations. CRS asks for a first generation, then for one place after the other.
  if (population_ == 0 || (search_.algorithm == "crs" && question >= population_)) return question;
  return question / population_ * population_ + population_ - 1;
}

std::vector<std::vector<double>> Optimiser::Next(const Known& known) const
{
  Pass pass(known, [this](std::size_t question) { return EndOfGeneration(question); });
  const KnownValue at_start = known(start_);
  if (at_start.kind == KnownValue::Kind::kUnknown) return {start_};
  pass.best = pass.worst = at_start.value;

  const AlgorithmRow& row = RowOf(search_.algorithm);
  if (row.algorithm == NLOPT_NUM_ALGORITHMS)
  {
    CmaPass(search_, start_, population_, pass).Run(static_cast<std::size_t>(most_questions_));
    return pass.wanted;
  }
  const auto dimensions = static_cast<unsigned>(start_.size());
  const std::unique_ptr<std::remove_pointer_t<nlopt_opt>, OptimiserDeleter> optimiser(
      nlopt_create(row.algorithm, dimensions));
  if (optimiser == nullptr) throw std::runtime_error("NLopt cannot make the algorithm " + search_.algorithm);
  pass.optimiser = optimiser.get();
  nlopt_set_lower_bounds1(optimiser.get(), 0);
  nlopt_set_upper_bounds1(optimiser.get(), 1);
  nlopt_set_min_objective(optimiser.get(), AnswerOfPass, &pass);
  nlopt_set_maxeval(optimiser.get(), most_questions_);
  if (row.is_local) nlopt_set_xtol_abs1(optimiser.get(), search_.tolerance);
  if (population_ != 0) nlopt_set_population(optimiser.get(), static_cast<unsigned>(population_));
  nlopt_srand(search_.random_seed);
  std::vector<double> place = start_;
  double value = 0;
  const nlopt_result result = nlopt_optimize(optimiser.get(), place.data(), &value);
  if (pass.failure) std::rethrow_exception(pass.failure);
  // A local algorithm that cannot distinguish rounding errors from progress is finished.
  if (result < 0 && result != NLOPT_FORCED_STOP && result != NLOPT_ROUNDOFF_LIMITED)
  {
    const char* reason = nlopt_get_errmsg(optimiser.get());
    throw std::runtime_error(
        fmt::format("NLopt's {} failed: {}", search_.algorithm, reason != nullptr ? reason : std::to_string(result)));
  }
  return pass.wanted;
}

}  // namespace swarmanoid
