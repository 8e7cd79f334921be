// The 24 infrared sensors around an eye-bot.
#pragma once

#include <argos3/plugins/robots/generic/control_interface/ring_sensor.h>

namespace argos
{

class CCI_EyeBotProximitySensor : public CRingSensor
{
};

}  // namespace argos
