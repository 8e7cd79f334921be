// The devices of any robot whose kind has the part (common/experiment/entity_kind.h). Size and positions are those of
// the kind's row.
#include "common/experiment/entity_kind.h"
#include "common/plugin_descriptions/device_tables.h"
#include "common/plugins/noise_parameters.h"

namespace swarmanoid
{

std::vector<ParameterSpec> GroundParameters()
{
  return Joined({{.name = "floor_colour",
                  .type = ParameterType::kColour,
                  .default_value = "#ffffff",
                  .description = "Colour of the floor outside all patches."}},
                NoiseParameters("each brightness", ""));
}

void DescribeAnyRobotDevices()
{
  using Kind = EntityKindDescription;
  DescribeActuator(
      {.label = "wheels",
       .implementation = "generic_wheels",
       .brief = "the two driven wheels of any robot that has them, at the commanded speed at once",
       .parameters =
           Joined({{.name = "max_speed",
                    .unit = "m/s",
                    .default_value = "0",
                    .description = "Speed of a wheel on the ground to which commands are clamped; 0: that of the kind.",
                    .minimum = 0,
                    .maximum = 1e6}},
                  NoiseParameters("the speed of each wheel while it moves", "rad/s")),
       .robots = TagsOfKinds([](const Kind& kind) { return kind.wheels.has_value(); }),
       .channel = "wheels",
       .channel_width = 2});
  DescribeActuator({.label = "led_ring",
                    .implementation = "generic_led_ring",
                    .brief = "the LEDs of any robot that has them",
                    .parameters = ColourNoiseParameters(),
                    .robots = TagsOfKinds([](const Kind& kind) { return kind.leds.has_value(); })});
  DescribeActuator(
      {.label = "directional_leds",
       .implementation = "generic_directional_leds",
       .brief = "the LEDs of any robot that has them, each seen from within a cone only",
       .parameters = Joined({{.name = "observable_angle",
                              .unit = "deg",
                              .default_value = "60",
                              .description = "Between the axis of an LED and the border of the cone from within which "
                                             "it is seen.",
                              .minimum = 0,
                              .maximum = 180},
                             {.name = "elevation",
                              .unit = "deg",
                              .default_value = "0",
                              .description = "Of the axes above the plane of the ring, unless the robot's kind says "
                                             "where its LEDs look. They look outwards.",
                              .minimum = -90,
                              .maximum = 90}},
                            ColourNoiseParameters()),
       .robots = TagsOfKinds([](const Kind& kind) { return kind.leds.has_value(); })});
  DescribeSensor(
      {.label = "proximity",
       .implementation = "generic_proximity",
       .brief = "the proximity sensors of any robot that has them; 1 touching, falling evenly to 0 at the range",
       .parameters =
           Joined({{.name = "range",
                    .unit = "m",
                    .default_value = "0",
                    .description = "Distance from the sensor beyond which nothing is seen; 0: that of the kind.",
                    .minimum = 0,
                    .maximum = 1e6}},
                  NoiseParameters("each reading", "")),
       .robots = TagsOfKinds([](const Kind& kind) { return kind.proximity.has_value(); })});
  DescribeSensor({.label = "light",
                  .implementation = "generic_light",
                  .brief = "light sensors in a ring, each with the lights that it sees by the inverse square of their "
                           "distance, whatever the angle",
                  .parameters = Joined({{.name = "sensors",
                                         .type = ParameterType::kInteger,
                                         .default_value = "24",
                                         .description = "How many there are, evenly around the body.",
                                         .minimum = 1,
                                         .maximum = 360},
                                        {.name = "first_angle",
                                         .unit = "deg",
                                         .default_value = "7.5",
                                         .description = "Of the first one from the front, counter-clockwise.",
                                         .minimum = -360,
                                         .maximum = 360},
                                        {.name = "radius",
                                         .unit = "m",
                                         .default_value = "0.085",
                                         .description = "Of the ring.",
                                         .minimum = 0,
                                         .maximum = 1e6},
                                        {.name = "height",
                                         .unit = "m",
                                         .default_value = "0.06",
                                         .description = "Of the ring above the position of the robot.",
                                         .minimum = 0,
                                         .maximum = 1e6}},
                                       NoiseParameters("each reading", ""))});
  DescribeSensor({.label = "ground",
                  .implementation = "generic_ground",
                  .brief = "brightness and colour of the floor under any robot that looks at it",
                  .parameters = GroundParameters(),
                  .robots = TagsOfKinds([](const Kind& kind) { return !kind.ground_points.empty(); })});
}

}  // namespace swarmanoid
