// RunningExperiment: an experiment of configs/ that runs in this process, tick by tick, without its visualisations.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/math/elementary.h"
#include "simulation/simulator.h"
#include "test_folders.h"

namespace swarmanoid
{

class RunningExperiment
{
public:
  using Settings = std::vector<std::pair<std::string, std::string>>;

  // `file` is in configs/; `settings` are those of --set.
  explicit RunningExperiment(const std::string& file, const Settings& settings = {}, SimulatorOptions options = {})
      : experiment_(ReadExperiment(SWARMANOID_SOURCE_FOLDER "/configs/" + file, settings))
  {
    options.visualisations = false;
    simulator_ = std::make_unique<CSimulator>(*experiment_, options);
  }

  void Run(int ticks)
  {
    for (int k = 0; k < ticks; ++k) ASSERT_TRUE(simulator_->Step());
  }
  std::uint64_t HashAtTheEnd()
  {
    while (simulator_->Step()) continue;
    return simulator_->Finish().hash;
  }
  const CSwarmanoidSpace& Space() { return simulator_->GetSpace(); }
  const CSwarmanoidSpaceEntity& Entity(const std::string& id) { return *Space().FindEntity(id); }
  const Experiment& File() const { return *experiment_; }

  // Returns the entities whose ids begin with the prefix, in entity order.
  std::vector<const CSwarmanoidSpaceEntity*> EntitiesOf(const std::string& prefix)
  {
    std::vector<const CSwarmanoidSpaceEntity*> found;
    for (std::size_t k = 0; k < Space().Size(); ++k)
      if (Space().GetEntity(k).GetId().starts_with(prefix)) found.push_back(&Space().GetEntity(k));
    return found;
  }
  std::vector<Vector3> PositionsOf(const std::string& prefix)
  {
    std::vector<Vector3> positions;
    for (const CSwarmanoidSpaceEntity* entity : EntitiesOf(prefix)) positions.push_back(entity->GetPosition());
    return positions;
  }

private:
  std::unique_ptr<Experiment> experiment_;
  std::unique_ptr<CSimulator> simulator_;
};

// Returns the mean distance between two sets of positions.
inline double MeanDistance(const std::vector<Vector3>& from, const std::vector<Vector3>& to)
{
  double sum = 0;
  for (std::size_t k = 0; k < from.size(); ++k) sum += (to[k] - from[k]).norm();
  return sum / static_cast<double>(from.size());
}

}  // namespace swarmanoid
