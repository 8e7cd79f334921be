#include <fmt/format.h>
#include <fnmatch.h>

#include <stdexcept>

#include "common/configuration/wording.h"
#include "studies/metrics/metric_kinds.h"

namespace swarmanoid
{

std::vector<std::uint32_t> EntitiesOf(const MetricChoice& choice, const Experiment& experiment)
{
  std::vector<bool> meant(experiment.entities.size(), false);
  for (const std::string& pattern : choice.of)
  {
    bool fits = false;
    std::vector<std::string> ids;
    for (std::size_t i = 0; i < experiment.entities.size(); ++i)
    {
      const std::string& id = experiment.entities[i].id;
      if (ids.size() < 1000) ids.push_back(id);
      if (pattern != id &&
          (pattern.find('[') != std::string::npos || fnmatch(pattern.c_str(), id.c_str(), FNM_NOESCAPE) != 0))
        continue;
      meant[i] = fits = true;
    }
    if (!fits)
      throw ConfigurationError(choice.tree.ValueLocation("of"), fmt::format("no entity of the experiment fits {}{}",
                                                                            Quoted(pattern), DidYouMean(pattern, ids)));
  }
  std::vector<std::uint32_t> entities;
  for (std::uint32_t i = 0; i < meant.size(); ++i)
    if (meant[i] || (choice.of.empty() && IsRobot(experiment.entities[i].kind))) entities.push_back(i);
  if (entities.empty())
    throw ConfigurationError(choice.location, "the experiment has no robots; name entities by 'of'");
  return entities;
}

std::unique_ptr<Metric> MakeMetric(const MetricChoice& choice, const Experiment& experiment)
{
  if (IsPublishedByFunctions(choice)) return MakeFunctionMetric(choice, experiment);
  const std::vector<std::uint32_t> entities = EntitiesOf(choice, experiment);
  for (MakeMetricOf* make : {MakeMotionMetric, MakeSwarmMetric, MakePlaceMetric, MakeContactMetric, MakeValueMetric})
    if (auto metric = make(choice, entities, experiment)) return metric;
  throw std::logic_error("no code makes the metric " + choice.kind);
}

}  // namespace swarmanoid
