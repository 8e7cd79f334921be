// One metric of a study during a run. The kinds are in metrics_*.cpp; Recorder owns and calls them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "studies/metrics/recorder.h"

namespace swarmanoid
{

class Metric
{
public:
  virtual ~Metric() = default;
  // Called at each tick, before Measure if a row is due.
  virtual void Look(CSimulator&) {}
  // Appends the values of this tick: one for each entity, NaN for none; or a single one. docs/studies.md has the units.
  virtual void Measure(CSimulator& simulator, std::vector<double>& values) = 0;
  // Adds the grid of a <coverage> at the end of the run.
  virtual void AddGrid(RunSamples&) const {}
  // Called at the end of a run of `ticks` ticks. Throws ConfigurationError if the metric names a value that did not
  // occur in the run.
  virtual void RequireSeen(std::uint64_t /*ticks*/) const {}
};

// Returns the indices of the entities of a metric, ascending. Throws ConfigurationError if a pattern fits none.
std::vector<std::uint32_t> EntitiesOf(const MetricChoice& choice, const Experiment& experiment);
// Throws ConfigurationError if the metric does not fit the experiment.
std::unique_ptr<Metric> MakeMetric(const MetricChoice& choice, const Experiment& experiment);

// Returns an aggregate of values without NaN in any order, and sorts them: "mean", "deviation" (of a sample), "median",
// "q25" (linear between the two nearest values) and so on. Returns NaN if there are too few values.
double Aggregate(const std::string& name, std::vector<double>& values);

}  // namespace swarmanoid
