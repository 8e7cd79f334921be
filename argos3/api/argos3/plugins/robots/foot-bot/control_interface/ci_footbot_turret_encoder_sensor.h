// The angle of the turret of a foot-bot.
#pragma once

#include <argos3/core/control_interface/ci_sensor.h>
#include <argos3/core/utility/math/angles.h>
#include <argos3/core/utility/math/vector2.h>

namespace argos
{

class CCI_FootBotTurretEncoderSensor : public CCI_Sensor
{
public:
  const CRadians& GetRotation() const { return m_cRotation; }

protected:
  CRadians m_cRotation;
};

}  // namespace argos
