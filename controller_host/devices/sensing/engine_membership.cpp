#include "controller_host/devices/sensing/engine_membership.h"

#include <algorithm>
#include <map>

#include "common/experiment/entity_kind.h"

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

  // Lights have no body, so they neither hide anything nor are sensed as bodies. They count as part of the one world of
  // all others, whether its engine lists them or not.
  const auto is_without_body = [&](std::size_t entity)
  { return IsBodiless(experiment.entities[entity].kind) && !HasBody(experiment.entities[entity].kind); };
  const std::vector<std::uint32_t>* of_bodies = nullptr;
  bool is_one_world = true;
  for (std::size_t entity = 0; entity < engines_of.size(); ++entity)
  {
    if (is_without_body(entity)) continue;
    if (of_bodies == nullptr) of_bodies = &engines_of[entity];
    is_one_world &= engines_of[entity] == *of_bodies;
  }
  if (of_bodies != nullptr && is_one_world)
    for (std::size_t entity = 0; entity < engines_of.size(); ++entity)
      if (is_without_body(entity)) engines_of[entity] = *of_bodies;

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
