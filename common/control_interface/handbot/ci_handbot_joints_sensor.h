// The state of a handbot's joints, hands and rope, and the entities that the hands hold.
#pragma once

#include <span>
#include <string>

#include "common/control_interface/ci_device.h"
#include "common/control_interface/handbot/ci_handbot_hands_actuator.h"

namespace swarmanoid
{

class CCI_HandBotJointsSensor : public CCI_SensorOf<CCI_HandBotJointsSensor>
{
public:
  enum Reading
  {
    HEAD,      // radians
    ARM_LEFT,  // radians, 0 along the robot
    ARM_RIGHT,
    WRIST_LEFT,  // radians
    WRIST_RIGHT,
    HAND_LEFT,  // aperture in radians, 0 is closed
    HAND_RIGHT,
    HOLDS_LEFT,  // 1 while the hand holds something, else 0
    HOLDS_RIGHT,
    ROPE_ATTACHED,  // 1 while the rope is attached, else 0
    ROPE_LENGTH,    // m
    NUM_READINGS
  };
  // Returns all readings in the order and the units of Reading.
  virtual std::span<const double, NUM_READINGS> GetAllSensorReadings() const = 0;
  double GetReading(Reading reading) const { return GetAllSensorReadings()[reading]; }
  // Returns the id of the entity that a hand holds, or an empty text. Real robots cannot know it, so there it is always
  // empty.
  virtual std::string GetHeldId(CCI_HandBotHandsActuator::Hand) const { return {}; }

  static void Declare(Declaration& columns)
  {
    columns.AddAll({{"head", "rad"},
                    {"left arm", "rad"},
                    {"right arm", "rad"},
                    {"left wrist", "rad"},
                    {"right wrist", "rad"},
                    {"left hand", "rad"},
                    {"right hand", "rad"},
                    {"left hand holds", "yes/no", 0, 1},
                    {"right hand holds", "yes/no", 0, 1},
                    {"rope attached", "yes/no", 0, 1},
                    {"rope length", "m", 0}},
                   &CCI_HandBotJointsSensor::GetAllSensorReadings);
  }
};

}  // namespace swarmanoid

using swarmanoid::CCI_HandBotJointsSensor;
