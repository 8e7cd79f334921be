// The proximity sensors of any robot whose kind has them: one ray for each sensor in the row of the kind. Generic. The
// footbot's own sensor computes its ring of rays several at a time.
#include <algorithm>

#include "common/control_interface/ci_proximity_sensor.h"
#include "common/math/elementary.h"
#include "controller_host/devices/any_robot/proximity_by_rays.h"
#include "controller_host/devices/any_robot/ring_readings.h"
#include "controller_host/devices/device_plugins.h"
#include "controller_host/devices/kind_of_batch.h"

namespace swarmanoid
{
namespace
{

class ProximitySensor : public ProximityByRays
{
public:
  void Init(const DeviceSetup& setup) override
  {
    const ProximityRing& ring = *KindOfBatch(setup).proximity;
    const double asked = setup.parameters.Number("range");
    const double range = asked > 0 ? asked : ring.range_m;
    double reach = 0;
    for (const ProximityRing::Sensor& sensor : ring.sensors)
    {
      const SinCos angle = SinCosOf(sensor.direction);
      rays_.push_back({{sensor.place.x(), sensor.place.y(), ring.height_m}, {angle.cos, angle.sin, 0}});
      angles_.push_back(sensor.direction);
      reach = std::max(reach, rays_.back().from.norm() + range);
    }
    InitRays(setup, rays_.size(), range, reach);
    for (std::size_t k = 0; k < robots_.size(); ++k) sensors_.emplace_back(ValuesOf(k), angles_, *this, k);
  }

  RingReadings<CCI_ProximitySensor>* Sensor(std::size_t k) override { return &sensors_[k]; }

protected:
  std::span<const ProximitySensorRay> RaysOf(std::size_t) override { return rays_; }

private:
  std::vector<ProximitySensorRay> rays_;
  std::vector<double> angles_;
  std::vector<RingReadings<CCI_ProximitySensor>> sensors_;
};

}  // namespace

const DeviceCode kProximityCode([] { BindSensor<ProximitySensor>("proximity", "generic_proximity"); });

}  // namespace swarmanoid
