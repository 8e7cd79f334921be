// The entities that share a physics engine. Engines are closed worlds: bodies of different engines neither touch nor
// hide each other. Used by the sensors of a controller host; fixed after construction.
#pragma once

#include <cstdint>
#include <vector>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

// Returns whether the robots of an engine stay upright and at their height.
bool IsPlane(const EngineConfiguration& engine);

class EngineMembership
{
public:
  explicit EngineMembership(const Experiment& experiment);

  // Returns true if some engine has both; never for an entity that is in no engine.
  bool ShareEngine(std::uint32_t a, std::uint32_t b) const
  {
    return shared_[class_of_[a] * class_count_ + class_of_[b]] != 0;
  }

  // All entities are in the same engines, and there are some.
  bool IsOneWorld() const { return class_count_ == 1 && shared_[0] != 0; }
  bool IsInSomeEngine(std::uint32_t entity) const { return ShareEngine(entity, entity); }

private:
  std::vector<std::uint32_t> class_of_;  // entities in the same set of engines are of one class
  std::size_t class_count_ = 0;
  std::vector<char> shared_;  // class by class
};

}  // namespace swarmanoid
