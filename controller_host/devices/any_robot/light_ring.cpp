// Light sensors in a ring around the body, as ARGoS3 has them on any robot (light_default_sensor.cpp). Each sensor adds
// up (I / d)^2 of the lights of intensity I that it sees at a distance of d m, at any angle. The own body hides lights
// on the other side. Generic.
#include <algorithm>
#include <memory>

#include "common/control_interface/ci_light_sensor.h"
#include "common/math/elementary.h"
#include "common/space/space.h"
#include "controller_host/devices/any_robot/ring_readings.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/sensing/sensor_world.h"
#include "controller_host/devices/sensing/shadows.h"
#include "controller_host/devices/value_devices.h"
#include "controller_host/on_demand_sensor.h"

namespace swarmanoid
{
namespace
{

class LightRing : public ValueSensor, public OnDemandSensor
{
public:
  void Init(const DeviceSetup& setup) override
  {
    const auto count = static_cast<std::size_t>(setup.parameters.Integer("sensors"));
    Reset(setup, count);
    noise_ = NoiseFrom(setup.parameters);
    const double first = DegreesToRadians(setup.parameters.Number("first_angle"));
    for (std::size_t i = 0; i < count; ++i)
    {
      angles_.push_back(WrapAngle(first + 2 * kPi * static_cast<double>(i) / static_cast<double>(count)));
      const SinCos angle = SinCosOf(angles_.back());
      outwards_.emplace_back(angle.cos, angle.sin, 0);
    }
    radius_ = setup.parameters.Number("radius");
    height_ = setup.parameters.Number("height");
    world_ = SensorWorld::Of(setup.space);
    for (std::uint32_t e = 0; e < setup.space.Size(); ++e)
      if (DescriptionOf(setup.space.GetEntity(e).GetKind()).role == EntityRole::kLight)
        bulbs_.push_back({e, setup.space.GetEntity(e).SlotOf("intensity")});
    fixed_.resize(bulbs_.size());
    shadows_ = std::make_unique<MovingShadows>(*world_);
    points_.Reserve(robots_.size() * count);
    sensor_of_point_.resize(robots_.size() * count);
    InitDemand(robots_.size());
    devices_.reserve(robots_.size());
    for (std::size_t k = 0; k < robots_.size(); ++k) devices_.emplace_back(ValuesOf(k), angles_, *this, k);
  }
  RingReadings<CCI_LightSensor>* Sensor(std::size_t k) override { return &devices_[k]; }

  void RefreshShared(WorkerPool* pool) override { world_->Refresh(pool); }
  void Update(const ChannelView&) override { MakeAhead(); }

private:
  struct Bulb
  {
    std::uint32_t entity;
    std::uint32_t intensity_slot;
  };

  void MakeDue() override
  {
    for (std::size_t k = 0; k < robots_.size(); ++k)
      if (IsDue(k)) std::fill_n(ValuesOf(k), width_, 0.0);
    for (std::size_t b = 0; b < bulbs_.size(); ++b) AddBulb(b);
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      if (!IsDue(k)) continue;
      if (noise_.IsActive()) AddNoise(k);
      for (std::size_t i = 0; i < width_; ++i) ValuesOf(k)[i] = std::clamp(ValuesOf(k)[i], 0.0, 1.0);
    }
  }

  void AddBulb(std::size_t b)
  {
    const double intensity = space_->Attributes()[bulbs_[b].intensity_slot];
    if (intensity <= 0 || !space_->IsPresent(bulbs_[b].entity)) return;
    const Vector3 source = space_->GetPose(bulbs_[b].entity).position;
    CollectFacing(source);
    // Darker lights are not seen: this is half a step of a 12-bit converter.
    constexpr double kNegligible = 1e-4;
    fixed_[b].Place(*world_, source);
    shadows_->Sort(source, intensity / __builtin_sqrt(kNegligible));
    seen_.clear();
    shadows_->Look(points_, fixed_[b], seen_);
    for (const std::uint32_t p : seen_)
    {
      const double square = (source - Vector3(points_.x[p], points_.y[p], points_.z[p])).squaredNorm();
      const double brightness = intensity * intensity / std::max(square, 1e-12);
      if (brightness >= kNegligible) values_[sensor_of_point_[p]] += brightness;
    }
  }

  // Collects the sensors on the side of their bodies that faces the source.
  void CollectFacing(const Vector3& source)
  {
    points_.count = 0;
    for (std::size_t k = 0; k < robots_.size(); ++k)
    {
      if (!IsDue(k)) continue;
      const Pose pose = space_->GetPose(robots_[k]);
      for (std::size_t i = 0; i < width_; ++i)
      {
        const Vector3 point = pose.Apply(Vector3(radius_ * outwards_[i] + Vector3(0, 0, height_)));
        if ((source - point).dot(pose.orientation * outwards_[i]) <= 0) continue;
        points_.x[points_.count] = point.x();
        points_.y[points_.count] = point.y();
        points_.z[points_.count] = point.z();
        sensor_of_point_[points_.count] = k * width_ + i;
        points_.robot[points_.count++] = robots_[k];
      }
    }
  }

  std::shared_ptr<SensorWorld> world_;
  std::vector<double> angles_;
  std::vector<Vector3> outwards_;  // in the frame of the robot, of length 1
  double radius_ = 0, height_ = 0;
  std::vector<Bulb> bulbs_;
  std::vector<FixedShadows> fixed_;  // by bulb
  std::unique_ptr<MovingShadows> shadows_;
  SightedPoints points_;  // of the bulb in turn
  std::vector<std::size_t> sensor_of_point_;
  std::vector<std::uint32_t> seen_;
  std::vector<RingReadings<CCI_LightSensor>> devices_;
};

}  // namespace

const DeviceCode kLightRingCode([] { BindSensor<LightRing>("light", "generic_light"); });

}  // namespace swarmanoid
