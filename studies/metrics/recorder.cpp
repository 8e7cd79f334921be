// Collects the values of a run's metrics at the sampled ticks, row by row. A metric with a value for each entity is
// aggregated at once: values that are not a number are dropped, the others sorted, so that sums have one order whatever
// the order of entities. The row of the last tick is added before it is known to be the last; if another tick comes, it
// is removed again.
#include "studies/metrics/recorder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/space/space.h"
#include "studies/metrics/metric.h"

namespace swarmanoid
{
namespace
{

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Returns the quantile (0 to 1) of sorted values.
double Quantile(const std::vector<double>& sorted, double share)
{
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(std::floor(place));
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

double SumOf(const std::vector<double>& values)
{
  double sum = 0;
  for (const double value : values) sum += value;
  return sum;
}

}  // namespace

double Aggregate(const std::string& name, std::vector<double>& values)
{
  const auto count = static_cast<double>(values.size());
  if (name == "count") return count;
  if (values.empty()) return kNone;
  // Sums run in the order of the values, so that they do not depend on the order of the entities.
  std::sort(values.begin(), values.end());
  if (name == "sum") return SumOf(values);
  if (name == "min") return values.front();
  if (name == "max") return values.back();
  if (name == "median") return Quantile(values, 0.5);
  if (name.starts_with("q")) return Quantile(values, std::stod(name.substr(1)) / 100);
  const double mean = SumOf(values) / count;
  if (name == "mean") return mean;
  if (values.size() < 2) return kNone;
  double squares = 0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / (count - 1));
}

Recorder::Recorder(const Study& study, const Experiment& experiment)
    : study_(study), columns_(MetricColumns(study).size())
{
  for (const MetricChoice& choice : study.metrics)
  {
    if (choice.HasColumns())
      metrics_.push_back(MakeMetric(choice, experiment));
    else if (followed_.empty())
      followed_ = EntitiesOf(choice, experiment);
    else
      throw ConfigurationError(choice.location, "there is a second <trajectories>; one may follow all entities");
  }
  samples_.tick_s = experiment.TickSeconds();
  for (const std::uint32_t index : followed_) samples_.followed.push_back(experiment.entities[index].id);
}

Recorder::~Recorder() = default;

void Recorder::Look(CSimulator& simulator)
{
  if (std::exchange(is_tentative_, false))
  {
    samples_.ticks.pop_back();
    samples_.values.resize(samples_.values.size() - columns_);
    samples_.ways.resize(samples_.ways.size() - 2 * followed_.size());
  }
  for (const auto& metric : metrics_) metric->Look(simulator);
  const std::uint64_t tick = simulator.GetSpace().GetTick();
  if (study_.sample_every != 0 && tick % study_.sample_every == 0) AddRow(simulator);
}

void Recorder::LookLast(CSimulator& simulator)
{
  if (!samples_.ticks.empty() && samples_.ticks.back() == simulator.GetSpace().GetTick()) return;
  AddRow(simulator);
  is_tentative_ = true;
}

void Recorder::AddRow(CSimulator& simulator)
{
  const CSwarmanoidSpace& space = simulator.GetSpace();
  samples_.ticks.push_back(space.GetTick());
  std::vector<double> values;
  std::size_t metric = 0;
  for (const MetricChoice& choice : study_.metrics)
  {
    if (!choice.HasColumns()) continue;
    values.clear();
    metrics_[metric++]->Measure(simulator, values);
    if (choice.aggregates.empty())
    {
      samples_.values.push_back(values.empty() ? kNone : values[0]);
      continue;
    }
    std::erase_if(values, [](double value) { return std::isnan(value); });
    for (const std::string& aggregate : choice.aggregates) samples_.values.push_back(Aggregate(aggregate, values));
  }
  for (const std::uint32_t index : followed_)
  {
    const bool present = space.IsPresent(index);
    samples_.ways.push_back(static_cast<float>(present ? space.Poses().x[index] : kNone));
    samples_.ways.push_back(static_cast<float>(present ? space.Poses().y[index] : kNone));
  }
}

RunSamples Recorder::Take()
{
  const std::uint64_t ticks = samples_.ticks.empty() ? 0 : samples_.ticks.back();
  for (const auto& metric : metrics_)
  {
    if (ticks > 0) metric->RequireSeen(ticks);
    metric->AddGrid(samples_);
  }
  is_tentative_ = false;
  return std::move(samples_);
}

}  // namespace swarmanoid
