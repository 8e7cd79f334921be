// The proximity sensors of any robot whose kind has them: a ray for each, from where the row says, against the outlines
// of the bodies in range. Generic. (The footbot's own sensor does the same for its ring, several rays at a time.)
#include <algorithm>
#include <memory>
#include <stdexcept>

#include "common/control_interface/ci_proximity_sensor.h"
#include "common/math/elementary.h"
#include "controller_host/devices/any_robot/kind_of_batch.h"
#include "controller_host/devices/builtin_devices.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/sensing/sensor_world.h"
#include "controller_host/devices/value_devices.h"
#include "controller_host/split_sensor.h"

namespace swarmanoid
{
namespace
{

class Proximity : public CCI_ProximitySensor
{
public:
  Proximity(const double* readings, const ProximityRing& ring) : readings_(readings), ring_(ring) {}
  std::span<const double> GetAllSensorReadings() const override { return {readings_, ring_.sensors.size()}; }
  double GetAngle(unsigned sensor) const override
  {
    if (sensor >= ring_.sensors.size())
      throw std::out_of_range("proximity sensor " + std::to_string(sensor) + " of " +
                              std::to_string(ring_.sensors.size()));
    return ring_.sensors[sensor].direction;
  }

private:
  const double* readings_;
  const ProximityRing& ring_;
};

class ProximitySensor : public ValueSensor, public SplitSensor
{
public:
  void Init(const DeviceSetup& setup) override
  {
    ring_ = &*KindOfBatch(setup).proximity;
    Reset(setup, ring_->sensors.size());
    noise_ = NoiseFrom(setup.parameters);
    const double asked = setup.parameters.Number("range");
    range_ = asked > 0 ? asked : ring_->range_m;
    world_ = SensorWorld::Of(setup.space);
    for (const ProximityRing::Sensor& sensor : ring_->sensors)
    {
      const SinCos angle = SinCosOf(sensor.direction);
      rays_.push_back({{sensor.place.x(), sensor.place.y(), ring_->height_m}, {angle.cos, angle.sin, 0}});
      reach_ = std::max(reach_, rays_.back().from.norm() + range_);
    }
    fixed_ = std::make_unique<FixedBodies>(setup.space, world_->Bodies(), reach_);
    for (std::size_t k = 0; k < robots_.size(); ++k) sensors_.emplace_back(ValuesOf(k), *ring_);
  }

  CCI_Sensor* Sensor(std::size_t k) override { return &sensors_[k]; }

  void RefreshShared() override { world_->Refresh(); }
  void Update(const ChannelView&) override
  {
    world_->Refresh();
    for (std::size_t k = 0; k < robots_.size(); ++k) Sense(robots_[k], ValuesOf(k));
    if (!noise_.IsActive()) return;
    AddNoise();
    for (double& value : values_) value = std::clamp(value, 0.0, 1.0);
  }

private:
  struct Ray
  {
    Vector3 from, direction;  // in the frame of the robot
  };

  void Sense(std::uint32_t robot, double* readings)
  {
    const Pose pose = space_->GetPose(robot);
    near_.clear();
    const auto add = [&](std::uint32_t body)
    {
      if (body != robot && world_->Membership().ShareEngine(robot, body)) near_.push_back(body);
    };
    world_->Grid().ForEachNear(pose.position.x(), pose.position.y(), reach_, add);
    for (const std::uint32_t body : fixed_->Near(pose.position.x(), pose.position.y())) add(body);
    const auto is_there = [&](std::uint32_t terrain) { return world_->Membership().ShareEngine(robot, terrain); };
    for (std::size_t i = 0; i < rays_.size(); ++i)
    {
      const Vector3 from = pose.Apply(rays_[i].from);
      const Vector3 to = pose.Apply(rays_[i].from + range_ * rays_[i].direction);
      double nearest = 1;
      for (const std::uint32_t body : near_)
        if (const auto hit = world_->HitOn(body, from, to)) nearest = std::min(nearest, *hit);
      if (!world_->Terrain().IsEmpty()) nearest = std::min(nearest, world_->Terrain().FirstHit(from, to, is_there));
      readings[i] = 1 - nearest;
    }
  }

  std::shared_ptr<SensorWorld> world_;
  const ProximityRing* ring_ = nullptr;
  std::unique_ptr<FixedBodies> fixed_;
  double range_ = 0;  // m
  double reach_ = 0;  // m: from the origin of the robot
  std::vector<Ray> rays_;
  std::vector<std::uint32_t> near_;  // of the robot being sensed
  std::vector<Proximity> sensors_;
};

}  // namespace

void RegisterProximity() { BindSensor<ProximitySensor>("proximity", "generic_proximity"); }

}  // namespace swarmanoid
