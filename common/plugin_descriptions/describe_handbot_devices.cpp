#include "common/plugin_descriptions/device_tables.h"
#include "common/plugins/noise_parameters.h"

namespace swarmanoid
{

using enum ParameterType;

void DescribeHandbotDevices()
{
  // Head and arms share a channel of five values: head, left arm, right arm, left wrist, right wrist.
  constexpr int kArmChannelWidth = 5;
  DescribeActuator({.label = "handbot_head",
                    .implementation = "dummy_handbot_head",
                    .brief = "turns the head with the two arms",
                    .parameters = NoiseParameters("the speed while the head is told to move", "rad/s"),
                    .robots = {"handbot"},
                    .channel = "handbot_arms",
                    .channel_width = kArmChannelWidth});
  DescribeActuator({.label = "handbot_arms",
                    .implementation = "dummy_handbot_arms",
                    .brief = "moves arms and wrists at given speeds",
                    .parameters = NoiseParameters("the speed of each joint that is told to move", "rad/s"),
                    .robots = {"handbot"},
                    .channel = "handbot_arms",
                    .channel_width = kArmChannelWidth});
  DescribeActuator({.label = "handbot_hands",
                    .implementation = "dummy_handbot_hands",
                    .brief = "opens and closes the two hands",
                    .parameters = NoiseParameters(
                        "how far each hand closes, 0 to 1, while it is told to close; it holds above 0.5", ""),
                    .robots = {"handbot"},
                    .channel = "handbot_hands",
                    .channel_width = 2});
  DescribeSensor({.label = "handbot_joints",
                  .implementation = "generic_handbot_joints",
                  .brief = "angles of head, arms, wrists and hands, what the hands hold, the rope",
                  .parameters = NoiseParameters("each angle", "rad"),
                  .robots = {"handbot"}});
  DescribeSensor({.label = "handbot_proximity",
                  .implementation = "generic_handbot_proximity",
                  .brief = "12 proximity sensors in each hand; 1 touching, falling evenly to 0 at the range",
                  .parameters = Joined({{"range", kNumber, "m", "0.05",
                                         "Distance from the sensor beyond which nothing is seen.", 0.001, 1e6}},
                                       NoiseParameters("each reading", "")),
                  .robots = {"handbot"}});
  DescribeActuator({.label = "handbot_rope",
                    .implementation = "dummy_handbot_rope",
                    .brief = "shoots the rope to the ceiling and climbs by its winch",
                    .parameters = NoiseParameters("the speed of the winch while it runs", "m/s"),
                    .robots = {"handbot"},
                    .channel = "handbot_rope",
                    .channel_width = 2});
  DescribeActuator({.label = "handbot_beacon",
                    .implementation = "generic_handbot_beacon",
                    .brief = "the LED on top of the robot",
                    .parameters = ColourNoiseParameters(),
                    .robots = {"handbot"}});
  DescribeActuator({.label = "handbot_leds",
                    .implementation = "generic_handbot_leds",
                    .brief = "the 12 LEDs around the robot",
                    .parameters = LedRingParameters(),
                    .robots = {"handbot"}});
}

}  // namespace swarmanoid
