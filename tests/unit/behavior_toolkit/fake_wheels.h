// Wheels that remember what a behaviour tells them.
#pragma once

#include <array>

#include "common/control_interface/footbot/ci_footbot_wheels_actuator.h"

namespace swarmanoid
{

class FakeWheels : public CCI_FootBotWheelsActuator
{
public:
  void SetFootBotWheelsAngularVelocity(double left, double right) override
  {
    speeds = {left * WHEEL_RADIUS_M, right * WHEEL_RADIUS_M};
  }
  std::array<double, 2> speeds{};  // m/s
};

}  // namespace swarmanoid
