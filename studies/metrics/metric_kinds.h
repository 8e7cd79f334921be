// The kinds of metrics, grouped by subject into the files metrics_*.cpp. docs/studies.md describes them.
#pragma once

#include <limits>

#include "studies/metrics/metric.h"

namespace swarmanoid
{

inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

// Each function makes the metrics of its kinds, and returns nullptr for others. Throws ConfigurationError if the metric
// does not fit the experiment.
using MakeMetricOf = std::unique_ptr<Metric>(const MetricChoice& choice, const std::vector<std::uint32_t>& entities,
                                             const Experiment& experiment);
MakeMetricOf MakeMotionMetric, MakeSwarmMetric, MakePlaceMetric, MakeContactMetric, MakeValueMetric;

// Returns whether experiment functions publish the value, so that it belongs to no entity.
bool IsPublishedByFunctions(const MetricChoice& choice);
std::unique_ptr<Metric> MakeFunctionMetric(const MetricChoice& choice, const Experiment& experiment);

}  // namespace swarmanoid
