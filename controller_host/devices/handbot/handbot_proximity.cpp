// The proximity sensors in the hands of the handbot: rays from palms and claws, which turn with head, arms, wrists and
// hands. Generic.
#include <array>
#include <span>

#include "common/control_interface/handbot/ci_handbot_proximity_sensor.h"
#include "common/math/elementary.h"
#include "common/plugin_descriptions/engine_bodies.h"
#include "common/plugin_descriptions/robot_parts.h"
#include "common/space/space.h"
#include "controller_host/devices/any_robot/proximity_by_rays.h"
#include "controller_host/devices/device_plugins.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kOfGroup = 3;
constexpr double kPalm_m = HandbotParts::kArmLength - HandbotParts::kClawLength;  // from the shoulder, along the arm
// No place of a hand is farther from the origin of the robot, wherever the joints stand.
constexpr double kHandReach_m = 0.4;

using HandRays = std::span<ProximitySensorRay, CCI_HandBotProximitySensor::SENSORS_OF_HAND>;

// Sets the rays in the frame of a hand, from the middle of its palm, with x along the arm. Rays 0 to 2 on the left claw
// and 9 to 11 on the right one look at the other claw. If the hand is wide open, the other claw is ahead. Rays 3 to 5
// above and 6 to 8 below look ahead.
void SetRays(double aperture, HandRays rays)
{
  constexpr double kWidth = HandbotParts::kClawWidth;
  const SinCos half = SinCosOf(aperture / 2);
  for (std::size_t i = 0; i < kOfGroup; ++i)
  {
    const double outwards = HandbotParts::kClawLength * (5 - 2 * static_cast<double>(i)) / 6;
    const Vector3 left(half.cos, half.sin, 0), right(half.cos, -half.sin, 0);
    rays[i] = {outwards * left, {half.sin, -half.cos, 0}};
    rays[11 - i] = {outwards * right, {half.sin, half.cos, 0}};
    const double beside = kWidth / 2 * (1 - static_cast<double>(i));
    rays[3 + i] = {{0, beside, kWidth}, Vector3::UnitX()};
    rays[6 + i] = {{0, beside, -kWidth}, Vector3::UnitX()};
  }
}

using HandProximity = ReadingsOnDemand<CCI_HandBotProximitySensor, CCI_HandBotProximitySensor::NUM_SENSORS>;

class HandbotProximitySensor : public ProximityByRays
{
public:
  void Init(const DeviceSetup& setup) override
  {
    const double range = setup.parameters.Number("range");
    InitRays(setup, rays_.size(), range, kHandReach_m + range);
    for (std::size_t k = 0; k < robots_.size(); ++k) sensors_.emplace_back(ValuesOf(k), *this, k);
    for (const std::uint32_t robot : robots_)
    {
      const auto slot = [&](const char* name) { return setup.space.GetEntity(robot).SlotOf(name); };
      slots_.push_back({slot("head_angle"), slot("arm"), slot("wrist"), slot("hand_aperture")});
    }
  }

  HandProximity* Sensor(std::size_t k) override { return &sensors_[k]; }

protected:
  std::span<const ProximitySensorRay> RaysOf(std::size_t k) override
  {
    const Slots& slots = slots_[k];
    const SparseVector<double>& attributes = space_->Attributes();
    for (std::uint32_t hand = 0; hand < 2; ++hand)
    {
      const HandRays rays(&rays_[hand * HandRays::extent], HandRays::extent);
      const double wrist = attributes[slots.wrist + hand];
      const Pose palm = HandbotShoulder(hand, attributes[slots.head], attributes[slots.arm + hand])
                            .Compose({Vector3(kPalm_m, 0, 0), QuaternionFromEuler({hand == 0 ? wrist : -wrist, 0, 0})});
      SetRays(attributes[slots.aperture + hand], rays);
      for (ProximitySensorRay& ray : rays) ray = {palm.Apply(ray.from), palm.orientation * ray.direction};
    }
    return rays_;
  }

private:
  struct Slots
  {
    std::uint32_t head, arm, wrist, aperture;  // of the left one, where there are two
  };

  std::vector<Slots> slots_;  // of each robot
  std::array<ProximitySensorRay, CCI_HandBotProximitySensor::NUM_SENSORS> rays_;
  std::vector<HandProximity> sensors_;
};

}  // namespace

const DeviceCode kHandbotProximityCode(
    [] { BindSensor<HandbotProximitySensor>("handbot_proximity", "generic_handbot_proximity"); });

}  // namespace swarmanoid
