// The controller of the benchmark's scenes for footbots with proximity sensors alone, all robots by one call. It drives
// as bench_swarm does.
#include "ci_batch_controller.h"
#include "footbot/ci_footbot_proximity_sensor.h"
#include "footbot/ci_footbot_wheels_actuator.h"

using namespace swarmanoid;

class CBenchBatch : public CCI_BatchController
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlSteps(CCI_Batch& robots) override
  {
    constexpr double kSpeed = 0.05 / CCI_FootBotWheelsActuator::WHEEL_RADIUS_M;  // rad/s
    constexpr unsigned kLast = CCI_FootBotProximitySensor::NUM_SENSORS - 1;
    const CCI_Readings proximity = robots.Readings("footbot_proximity");
    const CCI_Commands wheels = robots.Commands("footbot_wheels");
    for (std::size_t k = 0; k < robots.Size(); ++k)
    {
      const std::span<const double> readings = proximity[k];
      double turn = 0;
      for (unsigned i = 0; i < 4; ++i) turn -= readings[i] - readings[kLast - i];
      wheels[k][0] = turn > 0 ? 0 : kSpeed;
      wheels[k][1] = turn < 0 ? 0 : kSpeed;
    }
  }
  bool HasState() const override { return true; }
  bool StepsInParallel() const override { return true; }
};

REGISTER_CONTROLLER(CBenchBatch, {.label = "bench_batch", .brief = "footbots of the benchmark's scenes, by one call"})
