// Problem: an algorithm of NLopt asks for one value at a time and cannot be stopped and stored, but runs of a study
// take long, are executed in parallel, and must survive a kill.
//
// Method: the algorithm is started again for each step, with the same random seed. All known values are answered at
// once, so that it asks the same questions as before. At the first unknown value the pass goes on to the end of the
// generation, whose questions do not depend on each other, collects the unknown places, and stops. Refused places get a
// value that is worse than all known ones by their whole spread.
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

namespace swarmanoid
{
namespace
{

struct AlgorithmRow
{
  nlopt_algorithm algorithm;
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
      value = worst + std::max({worst - best, std::abs(worst), 1e-9});
    if (answer.kind == KnownValue::Kind::kValue)
    {
      best = std::min(best, value);
      worst = std::max(worst, value);
    }
    // Later questions could depend on the missing values.
    if (!wanted.empty() && question == end_of_generation(question)) Stop();
    return value;
  }
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

}  // namespace

Optimiser::Optimiser(const SearchChoice& search, std::vector<double> start, int most_questions)
    : search_(search), start_(std::move(start)), most_questions_(most_questions)
{
  const AlgorithmRow& row = RowOf(search.algorithm);
  population_ = row.population_per_dimension * (start_.size() + 1);
  if (search.population == 0) return;
  if (population_ == 0)
    throw ConfigurationError(search.location, fmt::format("the algorithm {} has no population", search.algorithm));
  population_ = search.population;
  if (population_ < start_.size() + 1)
    throw ConfigurationError(search.location,
                             fmt::format("a population of {} is too small for {} factors: take {} or more", population_,
                                         start_.size(), start_.size() + 1));
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
