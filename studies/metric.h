// One metric of a study while a run is measured. The kinds are in metrics_*.cpp; Recorder owns and calls them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "studies/recorder.h"

namespace swarmanoid
{

class Metric
{
public:
  virtual ~Metric() = default;
  // At each tick.
  virtual void Look(CSimulator&) {}
  // The values of this tick: one for each entity, NaN for none; or a single one.
  virtual void Measure(CSimulator& simulator, std::vector<double>& values) = 0;
  virtual void AddGrid(RunSamples&) const {}
  // At the end of a run of `ticks` ticks. Throws ConfigurationError if the run has shown that the metric names what
  // does not exist.
  virtual void RequireSeen(std::uint64_t /*ticks*/) const {}
};

// Indices of the entities that a metric is about, ascending. Throws ConfigurationError if a pattern fits none.
std::vector<std::uint32_t> EntitiesOf(const MetricChoice& choice, const Experiment& experiment);
// Throws ConfigurationError if it does not fit the experiment.
std::unique_ptr<Metric> MakeMetric(const MetricChoice& choice, const Experiment& experiment);

// Of values without NaN, in any order, which are sorted: "mean", "deviation" (of a sample), "median", "q25" (linear
// between the two nearest values) …; NaN if there are too few.
double Aggregate(const std::string& name, std::vector<double>& values);

}  // namespace swarmanoid
