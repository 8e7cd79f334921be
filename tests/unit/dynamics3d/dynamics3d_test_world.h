// The tests of dynamics3d use this world.
#pragma once

#include "common/math/elementary.h"
#include "common/plugin_descriptions/engines.h"
#include "engine_worker/engines/dynamics3d/dynamics3d_engine.h"
#include "engine_worker/engines/dynamics3d/footbot.h"
#include "tests/unit/engines/engine_test_world.h"

namespace swarmanoid
{

inline constexpr double kGravity = 9.81;  // m/s², the default of the engine

class Dynamics3dTestWorld : public EngineTestWorld<CDynamics3dEngine>
{
public:
  Dynamics3dTestWorld() : EngineTestWorld(Dynamics3dDescription()) {}
  template <class... More>
  Dynamics3dTestWorld(const std::string& parameter, const std::string& value, const More&... more)
      : Dynamics3dTestWorld()
  {
    Set(parameter, value, more...);
  }

  std::uint32_t AddHandbot(const Vector3& position, double yaw = 0)
  {
    return Add(EntityKind::kHandbot, position, QuaternionFromYaw(yaw), DescriptionOf(EntityKind::kHandbot).size);
  }
  void Drive(std::uint32_t footbot, double left_m_per_s, double right_m_per_s)
  {
    constexpr double kRadius = dynamics3d::FootbotShape::kWheelRadius;
    Command("footbot_wheels", footbot, {left_m_per_s / kRadius, right_m_per_s / kRadius});
  }
  // Returns the angle between the entity's z axis and that of the space.
  double Tilt(std::uint32_t entity) { return Acos((Orientation(entity) * Vector3::UnitZ()).z()); }
};

// Returns how far (m) a footbot drives in `t` seconds from rest at full power: m v' = F (1 - v / v0). F is the largest
// grip of its wheels, and v0 = 0.6 m/s. A geared wheel of 0.2 kg counts with 4 times its mass along the ground.
inline double WayOfStartingFootbot(double t)
{
  constexpr double kFreeSpeed = 0.6;
  constexpr double kTime = (1.6 + 2 * 4 * 0.2) * kFreeSpeed / (0.73 * 1.6 * 9.81);
  return kFreeSpeed * (t - kTime * (1 - Exp(-t / kTime)));
}

}  // namespace swarmanoid
