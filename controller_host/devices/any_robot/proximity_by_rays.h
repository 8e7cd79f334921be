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
  void Sense(std::size_t k);

  std::shared_ptr<SensorWorld> world_;
  std::unique_ptr<FixedBodies> fixed_;
  double range_m_ = 0;
  double reach_m_ = 0;
  std::vector<std::uint32_t> near_;  // of the robot being sensed
};

}  // namespace swarmanoid
