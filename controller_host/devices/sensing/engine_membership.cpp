#include "controller_host/devices/sensing/engine_membership.h"

#include <algorithm>
#include <map>

namespace swarmanoid
{

bool IsPlane(const EngineConfiguration& engine)
{
  return engine.tag == "dummy_engine" || engine.tag == "kinematics2d" || engine.tag == "dynamics2d";
}

EngineMembership::EngineMembership(const Experiment& experiment)
{
  std::vector<std::vector<std::uint32_t>> engines_of(experiment.entities.size());
  for (std::uint32_t engine = 0; engine < experiment.engines.size(); ++engine)
    for (const std::uint32_t entity : experiment.engines[engine].entities) engines_of[entity].push_back(engine);

  std::map<std::vector<std::uint32_t>, std::uint32_t> classes;
  for (const auto& engines : engines_of)
    class_of_.push_back(classes.emplace(engines, static_cast<std::uint32_t>(classes.size())).first->second);

  class_count_ = classes.size();
  shared_.assign(class_count_ * class_count_, 0);
  for (const auto& [a_engines, a] : classes)
    for (const auto& [b_engines, b] : classes)
      shared_[a * class_count_ + b] = std::any_of(a_engines.begin(), a_engines.end(),
                                                  [&engines = b_engines](std::uint32_t engine) {
                                                    return std::binary_search(engines.begin(), engines.end(), engine);
                                                  });
}

}  // namespace swarmanoid
