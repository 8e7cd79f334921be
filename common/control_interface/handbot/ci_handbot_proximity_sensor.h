// The infrared proximity sensors of the handbot's two hands.
#pragma once

#include <span>
#include <string>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

class CCI_HandBotProximitySensor : public CCI_SensorOf<CCI_HandBotProximitySensor>
{
public:
  static constexpr unsigned SENSORS_OF_HAND = 12;
  static constexpr unsigned NUM_SENSORS = 2 * SENSORS_OF_HAND;

  // Returns all readings, 0 (nothing in range) to 1 (touching), valid until the next control step: the left hand's,
  // then the right hand's. For each hand, while its wrist is at 0: 0 to 2 are on the left claw, the outermost first. 3
  // to 5 are above the claws and 6 to 8 below, from left to right. 9 to 11 are on the right claw, the outermost last.
  virtual std::span<const double, NUM_SENSORS> GetAllSensorReadings() const = 0;

  static void Declare(Declaration& columns)
  {
    using Hand = std::span<const double, SENSORS_OF_HAND>;
    columns
        .Add({"left #", "", 0, 1},
             [](const CCI_HandBotProximitySensor& sensor) -> Hand
             { return sensor.GetAllSensorReadings().first<SENSORS_OF_HAND>(); })
        .Add({"right #", "", 0, 1},
             [](const CCI_HandBotProximitySensor& sensor) -> Hand
             { return sensor.GetAllSensorReadings().last<SENSORS_OF_HAND>(); });
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_HandBotProximitySensor;
