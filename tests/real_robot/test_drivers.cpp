// Drivers of a user: wheels that print their commands, and a proximity sensor that was never connected.
#include <cstdio>

#include "footbot/ci_footbot_proximity_sensor.h"
#include "footbot/ci_footbot_wheels_actuator.h"
#include "real_robot/driver.h"

namespace
{

class CPrintedWheels : public CActuatorDriver, public CCI_FootBotWheelsActuator
{
public:
  void Init(const swarmanoid::DriverSetup& setup) override { scale_ = setup.parameters.Number("scale"); }
  CCI_Actuator* Actuator() override { return this; }
  void SetFootBotWheelsAngularVelocity(double left, double right) override
  {
    left_ = left;
    right_ = right;
  }
  void Push() override { std::printf("wheels %g %g\n", scale_ * left_, scale_ * right_); }
  void Stop() override { std::printf("wheels stop\n"); }

private:
  double scale_ = 1;
  double left_ = 0;
  double right_ = 0;
};

REGISTER_ACTUATOR_DRIVER(
    CPrintedWheels, DescribeDriver("footbot_wheels", "printed", "prints what it is told", {"footbot"},
                                   {{.name = "scale", .default_value = "1", .description = "Factor.", .minimum = 0}}))

}  // namespace
