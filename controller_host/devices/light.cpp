// The 24 light sensors around footbots and eyebots. Each bulb in line of sight adds its brightness to the sensors that
// face it, falling off linearly to nothing at 90 degrees. Generic.
#include <algorithm>
#include <memory>

#include "common/control_interface/eyebot/ci_eyebot_light_sensor.h"
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

// How bright a bulb is by its intensity I and the square of its distance d in m, and from which height above the base
// it is seen.
struct InverseSquare  // (I / d)^2
{
  template <class Interface>
  static constexpr double kHeight = Interface::RING_HEIGHT_M;
  static double Brightness(double intensity, double square) { return intensity * intensity / std::max(square, 1e-12); }
};

struct Argos3  // exp(-2 d / I), nothing beyond d / I = 2.5: footbot_light_rotzonly_sensor.cpp of ARGoS3
{
  template <class Interface>
  static constexpr double kHeight = 0;
  static double Brightness(double intensity, double square)
  {
    const double scaled = __builtin_sqrt(square) / intensity;
    return scaled > 2.5 ? 0 : Exp(-2 * scaled);
  }
};

template <class Interface, class Model>
class LightSensor : public SensorsOf<ValueSensor, ReadingsOf<Interface, Interface::NUM_SENSORS>>
{
public:
  void Init(const DeviceSetup& setup) override
  {
    this->Reset(setup, Interface::NUM_SENSORS);
    this->noise_ = NoiseFrom(setup.parameters);
    world_ = SensorWorld::Of(setup.space);
    bulbs_.clear();
    for (std::uint32_t e = 0; e < setup.space.Size(); ++e)
      if (DescriptionOf(setup.space.GetEntity(e).GetKind()).role == EntityRole::kLight)
        bulbs_.push_back({e, setup.space.GetEntity(e).SlotOf("intensity")});
    this->MakeDevices();
  }

  void Update(const ChannelView&) override
  {
    world_->Refresh();
    std::fill(this->values_.begin(), this->values_.end(), 0.0);
    for (std::size_t k = 0; k < this->robots_.size(); ++k)
      for (const Bulb& bulb : bulbs_) AddBulb(this->robots_[k], bulb, this->ValuesOf(k));
    for (double& value : this->values_) value = std::min(value, 1.0);
    if (!this->noise_.IsActive()) return;
    this->AddNoise();
    for (double& value : this->values_) value = std::clamp(value, 0.0, 1.0);
  }

private:
  struct Bulb
  {
    std::uint32_t entity;
    std::uint32_t intensity_slot;
  };

  void AddBulb(std::uint32_t robot, const Bulb& bulb, double* readings) const
  {
    const CSwarmanoidSpace& space = *this->space_;
    const double intensity = space.Attributes()[bulb.intensity_slot];
    if (intensity <= 0 || !space.IsPresent(bulb.entity)) return;
    const Pose pose = space.GetPose(robot);
    const Vector3 from = pose.Apply({0, 0, Model::template kHeight<Interface>});
    const Vector3 to = space.GetPose(bulb.entity).position;
    const auto hides = [&](std::uint32_t body) { return body != robot && world_->CanHideFrom(robot, body); };
    if (world_->FirstHit(from, to, hides) <= 1) return;

    const Vector3 place = pose.orientation.conjugate() * (to - from);
    const double brightness = Model::Brightness(intensity, place.squaredNorm());
    const double angle = Atan2(place.y(), place.x());
    for (unsigned i = 0; i < Interface::NUM_SENSORS; ++i)
    {
      const double off = __builtin_fabs(WrapAngle(Interface::AngleOf(i) - angle));
      readings[i] += brightness * std::max(1 - off / (kPi / 2), 0.0);
    }
  }

  std::shared_ptr<SensorWorld> world_;
  std::vector<Bulb> bulbs_;
};

}  // namespace

void RegisterLight()
{
  BindSensor<LightSensor<CCI_FootBotLightSensor, InverseSquare>>("footbot_light", "generic_footbot_light");
  BindSensor<LightSensor<CCI_FootBotLightSensor, Argos3>>("footbot_light", "argos3_footbot_light");
  BindSensor<LightSensor<CCI_EyeBotLightSensor, InverseSquare>>("eyebot_light", "generic_eyebot_light");
  BindSensor<LightSensor<CCI_EyeBotLightSensor, Argos3>>("eyebot_light", "argos3_eyebot_light");
}

}  // namespace swarmanoid
