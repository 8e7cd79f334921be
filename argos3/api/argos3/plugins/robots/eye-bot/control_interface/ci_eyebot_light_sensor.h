// The 24 light sensors around an eye-bot.
#pragma once

#include <argos3/plugins/robots/generic/control_interface/ring_sensor.h>

namespace argos
{

class CCI_EyeBotLightSensor : public CRingSensor
{
};

}  // namespace argos
