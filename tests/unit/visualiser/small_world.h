// SmallWorld: a small space made entity by entity, for tests of drawings.
#pragma once

#include <memory>

#include "common/experiment/body.h"
#include "common/math/elementary.h"
#include "common/space/space.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{

class SmallWorld
{
public:
  explicit SmallWorld(const Vector3& arena) { experiment_.arena_size = arena; }

  EntityConfiguration& Add(EntityKind kind, const std::string& id, const Vector3& position, double gamma_degrees = 0)
  {
    experiment_.entities.push_back(test::Entity(kind, id, position, DegreesToRadians(gamma_degrees)));
    return experiment_.entities.back();
  }
  void AddBody(EntityKind kind, const std::string& id, const Vector3& position, const Vector3& size,
               std::uint32_t colour = 0xc0c0c0)
  {
    EntityConfiguration& entity = Add(kind, id, position);
    entity.size = size;
    entity.colour = colour;
  }

  // Makes the space at the first call. Entities must be added before, attributes and poses set afterwards.
  CSwarmanoidSpace& Space()
  {
    if (space_ == nullptr) space_ = std::make_unique<CSwarmanoidSpace>(experiment_);
    return *space_;
  }
  CSwarmanoidSpaceEntity& operator[](const std::string& id) { return *Space().FindEntity(id); }
  void Set(const std::string& id, const std::string& attribute, double value, int element = 0)
  {
    Space().SetAttribute((*this)[id].SlotOf(attribute, element), value);
  }
  void SetLeds(const std::string& id, int count, std::uint32_t colour)
  {
    for (int led = 0; led < count; ++led) Set(id, "led", colour, led);
  }
  Experiment& GetExperiment() { return experiment_; }

private:
  Experiment experiment_;
  std::unique_ptr<CSwarmanoidSpace> space_;
};

}  // namespace swarmanoid
