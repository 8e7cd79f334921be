// The 24 light sensors of the footbot: each bulb in line of sight adds (intensity / distance)^2 to the sensors that
// face it, falling off linearly to nothing at 90 degrees (ARGoS3, foot-bot light sensor). Generic.
#include <algorithm>
#include <memory>

#include "common/control_interface/footbot/ci_footbot_light_sensor.h"
#include "common/math/elementary.h"
#include "controller_host/devices/builtin_devices.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/sensing/sensor_world.h"
#include "controller_host/devices/value_devices.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kSensors = CCI_FootBotLightSensor::NUM_SENSORS;
constexpr double kHeight = 0.06;  // m: on the ring of the proximity sensors

using Light = ReadingsOf<CCI_FootBotLightSensor, kSensors>;

class LightSensor : public SensorsOf<ValueSensor, Light>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    Reset(setup, kSensors);
    noise_ = NoiseFrom(setup.parameters);
    world_ = SensorWorld::Of(setup.space);
    bulbs_.clear();
    for (std::uint32_t e = 0; e < setup.space.Size(); ++e)
      if (DescriptionOf(setup.space.GetEntity(e).GetKind()).role == EntityRole::kLight)
        bulbs_.push_back({e, setup.space.GetEntity(e).SlotOf("intensity")});
    MakeDevices();
  }

  void Update(const ChannelView&) override
  {
    world_->Refresh();
    std::fill(values_.begin(), values_.end(), 0.0);
    for (std::size_t k = 0; k < robots_.size(); ++k)
      for (const Bulb& bulb : bulbs_) AddBulb(robots_[k], bulb, ValuesOf(k));
    for (double& value : values_) value = std::min(value, 1.0);
    if (!noise_.IsActive()) return;
    AddNoise();
    for (double& value : values_) value = std::clamp(value, 0.0, 1.0);
  }

private:
  struct Bulb
  {
    std::uint32_t entity;
    std::uint32_t intensity_slot;
  };

  void AddBulb(std::uint32_t robot, const Bulb& bulb, double* readings) const
  {
    const double intensity = space_->Attributes()[bulb.intensity_slot];
    if (intensity <= 0 || !space_->IsPresent(bulb.entity)) return;
    const Pose pose = space_->GetPose(robot);
    const Vector3 from = pose.Apply({0, 0, kHeight});
    const Vector3 to = space_->GetPose(bulb.entity).position;
    const auto hides = [&](std::uint32_t body) { return body != robot && world_->CanHideFrom(robot, body); };
    if (world_->FirstHit(from, to, hides) <= 1) return;

    const Vector3 place = pose.orientation.conjugate() * (to - from);
    const double brightness = intensity * intensity / std::max(place.squaredNorm(), 1e-12);
    const double angle = Atan2(place.y(), place.x());
    for (unsigned i = 0; i < kSensors; ++i)
    {
      const double off = __builtin_fabs(WrapAngle(CCI_FootBotLightSensor::AngleOf(i) - angle));
      readings[i] += brightness * std::max(1 - off / (kPi / 2), 0.0);
    }
  }

  std::shared_ptr<SensorWorld> world_;
  std::vector<Bulb> bulbs_;
};

}  // namespace

void RegisterFootbotLight() { BindSensor<LightSensor>("footbot_light", "generic_footbot_light"); }

}  // namespace swarmanoid
