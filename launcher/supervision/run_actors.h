// RunActors: what the supervisor needs of an experiment while its processes run. It takes some 20 bytes for each
// entity, so that the launcher need not keep the experiment.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "common/experiment/actors.h"

namespace swarmanoid
{

class RunActors
{
public:
  explicit RunActors(const Experiment& experiment);

  // Returns the actor of that kind and number, whose names live as long as this object, or an actor of kind kNobody.
  Actor Of(Actor::Kind kind, std::uint32_t number) const;
  // Returns whether the run goes on if the controller of a robot fails.
  bool MayFail(std::uint32_t robot) const;

private:
  static constexpr std::uint32_t kNoController = std::numeric_limits<std::uint32_t>::max();

  // Returns the controller of an entity, or nullptr.
  const ControllerConfiguration* ControllerOf(std::uint32_t entity) const;

  Experiment without_entities_;
  std::string ids_;  // of the entities, each with a zero at its end
  std::vector<std::uint32_t> id_starts_;
  std::vector<std::uint32_t> controllers_;  // by entity
};

}  // namespace swarmanoid
