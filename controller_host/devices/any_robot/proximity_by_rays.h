// Proximity sensors as rays from a robot against the outlines of bodies in range and terrain. A reading is 1 at contact
// and falls linearly to 0 at the range. The base of sensors with positions from a kind or a joint. Generic.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "controller_host/devices/sensing/sensor_world.h"
#include "controller_host/devices/value_devices.h"
#include "controller_host/on_demand_sensor.h"

namespace swarmanoid
{

struct ProximitySensorRay
{
  Vector3 from, direction;  // in the frame of the robot
};

class ProximityByRays : public ValueSensor, public OnDemandSensor
{
public:
  void RefreshShared(WorkerPool* pool) override;
  void Update(const ChannelView&) override { MakeAhead(); }
  double Reach() const override { return reach_m_; }

protected:
  // Takes the noise from the parameters. What controllers hold has to Want its readings. `reach`: how far from the
  // origin of its robot a ray can end, m.
  void InitRays(const DeviceSetup& setup, std::size_t count, double range_m, double reach_m);
  // Returns the rays of robot k at the current tick, as many as Init was given. The result is valid until the next
  // call.
  virtual std::span<const ProximitySensorRay> RaysOf(std::size_t k) = 0;

private:
  void MakeDue() override;
  bool MakeAlone(std::size_t k) override;
  // In a world of upright bodies without moving parts, neighbours are remembered while MovedSince holds.
  bool KnowsNear() const;
  void FindNear();
  void Sense(std::size_t k);
  // Computes the readings of a robot from near_ and the terrain.
  void CastRays(std::size_t k);
  // Adds a body that the robot can sense to the bodies near it.
  void AddNear(std::uint32_t robot, std::uint32_t body)
  {
    if (body != robot && world_->Membership().ShareEngine(robot, body)) near_.push_back(body);
  }

  std::shared_ptr<SensorWorld> world_;
  std::unique_ptr<FixedBodies> fixed_;
  double range_m_ = 0;
  double reach_m_ = 0;
  std::vector<std::uint32_t> near_;  // of the robot being sensed
  bool remembers_ = false;
  std::uint64_t near_since_ = 0;                 // MovedSince::Number
  std::unique_ptr<FixedBodies> fixed_for_long_;  // bodies that may come near while MovedSince holds
  std::vector<std::uint32_t> remembered_;        // the bodies near each robot, one robot after the other
  std::vector<std::uint32_t> first_remembered_;  // of robot k there; has one number more than there are robots
};

}  // namespace swarmanoid
