// The kinds of metrics, by what they are about: one metrics_*.cpp each. docs/studies.md describes them.
#pragma once

#include <limits>

#include "studies/metric.h"

namespace swarmanoid
{

inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

// Each makes its own kinds, and nullptr for others. Throws ConfigurationError if the metric does not fit the
// experiment.
using MakeMetricOf = std::unique_ptr<Metric>(const MetricChoice& choice, const std::vector<std::uint32_t>& entities,
                                             const Experiment& experiment);
MakeMetricOf MakeMotionMetric, MakeSwarmMetric, MakePlaceMetric, MakeContactMetric, MakeValueMetric;

// Of no entities.
bool IsPublishedByFunctions(const MetricChoice& choice);
std::unique_ptr<Metric> MakeFunctionMetric(const MetricChoice& choice, const Experiment& experiment);

}  // namespace swarmanoid
