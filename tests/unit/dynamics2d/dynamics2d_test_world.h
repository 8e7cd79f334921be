// The tests of dynamics2d use this world. Bodies are given by their positions on the plane z = 0.
#pragma once

#include "common/plugin_descriptions/engines.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_engine.h"
#include "tests/unit/engines/engine_test_world.h"

namespace swarmanoid
{

class Dynamics2dTestWorld : public EngineTestWorld<CDynamics2dEngine>
{
public:
  Dynamics2dTestWorld() : EngineTestWorld(Dynamics2dDescription()) {}
  template <class... More>
  Dynamics2dTestWorld(const std::string& parameter, const std::string& value, const More&... more)
      : Dynamics2dTestWorld()
  {
    Set(parameter, value, more...);
  }

  std::uint32_t AddFootbot(double x, double y, double yaw = 0) { return EngineTestWorld::AddFootbot({x, y, 0}, yaw); }
  std::uint32_t AddPrey(double x, double y, double mass, double radius = 0.1)
  {
    return EngineTestWorld::AddPrey({x, y, 0}, mass, radius);
  }
  void Drive(std::uint32_t footbot, double left_m_per_s, double right_m_per_s)
  {
    const double radius = DescriptionOf(EntityKind::kFootbot).wheels->radius_m;
    Command("footbot_wheels", footbot, {left_m_per_s / radius, right_m_per_s / radius});
  }
};

}  // namespace swarmanoid
