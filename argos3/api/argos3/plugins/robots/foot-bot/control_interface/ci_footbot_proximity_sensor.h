// The 24 infrared sensors around a foot-bot.
#pragma once

#include <argos3/plugins/robots/generic/control_interface/ring_sensor.h>

namespace argos
{

class CCI_FootBotProximitySensor : public CRingSensor
{
};

}  // namespace argos
