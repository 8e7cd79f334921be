// CPhysicsEngine: how long a tick is. One engine has all that an experiment in ARGoS3's XML gives to several.
#pragma once

#include <argos3/core/utility/datatypes/datatypes.h>

namespace argos
{

class CPhysicsEngine
{
public:
  // s
  static Real GetSimulationClockTick() { return tick_s_; }
  // Ticks a second.
  static Real GetInverseSimulationClockTick() { return 1 / tick_s_; }
  // For the bridge: of the experiment.
  static void SetSimulationClockTick(Real tick_s) { tick_s_ = tick_s; }

private:
  static Real tick_s_;
};

}  // namespace argos
