#include "common/plugin_descriptions/device_tables.h"
#include "common/plugins/noise_parameters.h"

namespace swarmanoid
{
namespace
{

using enum ParameterType;

void DescribePropellers()
{
  const std::vector<ParameterSpec> limits = {
      {"max_speed", kNumber, "m/s", "",
       "Horizontal and vertical speed to which commands are clamped, along each axis; by default that of the kind, 1 "
       "m/s for an eyebot.",
       0, 1e6},
      {"max_yaw_rate", kNumber, "rad/s", "",
       "Yaw rate to which commands are clamped; by default that of the kind, 90 degrees/s for an eyebot.", 0, 1e6}};
  const std::vector<ParameterSpec> noise = NoiseParameters("each velocity that is not 0", "m/s, rad/s");
  const auto describe = [](const char* implementation, const char* brief, std::vector<ParameterSpec> parameters)
  {
    DescribeActuator({.label = "eyebot_propellers",
                      .implementation = implementation,
                      .brief = brief,
                      .parameters = std::move(parameters),
                      .robots = {"eyebot"},
                      .channel = "eyebot_propellers",
                      .channel_width = 4});
  };
  describe("dummy_eyebot_propellers", "flies at given velocities", Joined(limits, noise));
  describe("position_eyebot_propellers", "flies at given velocities or to a given position and heading",
           Joined(Joined(limits, {{"gain", kNumber, "1/s", "1",
                                   "Speed for each metre (and yaw rate for each radian) that is left; larger values "
                                   "arrive sooner and overshoot more.",
                                   0, 1e6}}),
                  noise));
}

}  // namespace

void DescribeEyebotDevices()
{
  DescribePropellers();
  DescribeLight("eyebot");
  DescribeActuator(
      {.label = "eyebot_attachment",
       .implementation = "dummy_eyebot_attachment",
       .brief = "hangs the robot on the ceiling by its magnet",
       .parameters = NoiseParameters("the strength of the magnet, 0 to 1, while it is on; it holds above 0.5", ""),
       .robots = {"eyebot"},
       .channel = "eyebot_attach",
       .channel_width = 1});
  DescribeSensor({.label = "eyebot_altitude",
                  .implementation = "generic_eyebot_altitude",
                  .brief = "distance down to the floor or to what stands there",
                  .parameters = NoiseParameters("the altitude", "m"),
                  .robots = {"eyebot"}});
  DescribeActuator({.label = "eyebot_laser",
                    .implementation = "generic_eyebot_laser",
                    .brief = "projects a coloured spot that cameras see",
                    .parameters = NoiseParameters("pan and tilt", "rad"),
                    .robots = {"eyebot"}});
  DescribeActuator({.label = "eyebot_leds",
                    .implementation = "generic_eyebot_leds",
                    .brief = "the 16 LEDs around the robot",
                    .parameters = LedRingParameters(),
                    .robots = {"eyebot"}});
}

}  // namespace swarmanoid
