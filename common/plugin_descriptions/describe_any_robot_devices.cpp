// The devices of any robot whose kind has the part (common/experiment/entity_kind.h). Size and positions are those of
// the kind's row.
#include "common/experiment/entity_kind.h"
#include "common/plugin_descriptions/device_tables.h"
#include "common/plugins/noise_parameters.h"
#include "common/plugins/parameter_checks.h"

namespace swarmanoid
{

using enum ParameterType;

std::vector<ParameterSpec> GroundParameters()
{
  return Joined({{"floor_colour", kColour, "", "#ffffff", "Colour of the floor outside all patches."}},
                NoiseParameters("each brightness", ""));
}

std::vector<ParameterSpec> LedRingParameters()
{
  return Joined({{.name = "separate",
                  .type = ParameterType::kBoolean,
                  .default_value = "false",
                  .description = "Whether cameras see each LED as a blob of its own, unless the robot's body hides it; "
                                 "otherwise LEDs of one colour are one blob."}},
                ColourNoiseParameters());
}

namespace
{

// Devices for all robots have an empty list of tags, and none of the simulator's own kinds has links.
constexpr const char* kJointed = "kinds with joints";

std::vector<ConfigurationError> MistakesInDirections(const Parameters& parameters)
{
  constexpr std::size_t kMost = 360;
  const std::string text = parameters.Text("directions");
  const auto directions = ParseNumbers(text);
  if (directions && !directions->empty() && directions->size() <= kMost) return {};
  return {ConfigurationError(parameters.Tree().ValueLocation("directions"),
                             "'directions' of <" + parameters.Tree().Name() + "> is '" + text +
                                 "'; it must be 1 to 360 angles in degrees, with commas between them")};
}

void DescribeExponentialLight()
{
  const PluginDescription light{
      .label = "light",
      .implementation = "argos3_light",
      .brief =
          "light sensors at one point, each with exp(-2 d / I) of the lights of intensity I at d m that it sees, "
          "less by the angle; as on the robots of ARGoS3's plug-ins",
      .parameters = Joined(
          {{"directions", kText, "deg", "0, 45, 90, 135, 180, 225, 270, 315",
            "Of the sensors from the front, counter-clockwise."},
           {"half_angle", kNumber, "deg", "90", "Between a sensor and a light that it does not see any more.", 1, 180},
           {"position", kVector3, "m", "0, 0, 0", "Of the sensors, in the frame of the robot, which hides no light.",
            -1e6, 1e6},
           {"index_step", kNumber, "deg", "0",
            "If not 0, a light reaches the five sensors about number bearing / step, as in ARGoS3's Khepera IV.", 0,
            360}},
          NoiseParameters("each reading", ""))};
  ParameterChecks::Instance().Add(PluginKind::kSensor, light, MistakesInDirections);
  DescribeSensor(light);
}

}  // namespace

void DescribeAnyRobotDevices()
{
  using Kind = EntityKindDescription;
  DescribeActuator(
      {.label = "wheels",
       .implementation = "generic_wheels",
       .brief = "the two driven wheels of any robot that has them, at the commanded speed at once",
       .parameters =
           Joined({{"max_speed", kNumber, "m/s", "0",
                    "Speed of a wheel on the ground to which commands are clamped; 0: that of the kind.", 0, 1e6}},
                  NoiseParameters("the speed of each wheel while it moves", "rad/s")),
       .robots = TagsOfKinds([](const Kind& kind) { return kind.wheels.has_value(); }),
       .channel = "wheels",
       .channel_width = 2});
  DescribeActuator(
      {.label = "joints",
       .implementation = "generic_joints",
       .brief = "the joints of any robot that has them, by name: positions to go to, or speeds to keep",
       .parameters = Joined({{.name = "control",
                              .type = kChoice,
                              .default_value = "position",
                              .description = "Whether its columns, one for each joint, are positions or speeds.",
                              .choices = {"position", "velocity"}}},
                            NoiseParameters("each command of a joint that moves", "")),
       .robots = {kJointed},
       .channel = "joints",
       .channel_width = kJointCommandWidth,
       .channel_is_per_joint = true});
  DescribeSensor({.label = "joints",
                  .implementation = "generic_joints",
                  .brief = "position, speed and effort of each joint of any robot that has them",
                  .parameters = NoiseParameters("each reading", ""),
                  .robots = {kJointed},
                  .channel = "joints",
                  .channel_width = kJointReadingWidth,
                  .channel_is_per_joint = true});
  DescribeActuator({.label = "led_ring",
                    .implementation = "generic_led_ring",
                    .brief = "the LEDs of any robot that has them",
                    .parameters = LedRingParameters(),
                    .robots = TagsOfKinds([](const Kind& kind) { return kind.leds.has_value(); })});
  DescribeActuator(
      {.label = "directional_leds",
       .implementation = "generic_directional_leds",
       .brief = "the LEDs of any robot that has them, each seen from within a cone only",
       .parameters =
           Joined({{"observable_angle", kNumber, "deg", "60",
                    "Between the axis of an LED and the border of the cone from within which it is seen.", 0, 180},
                   {"elevation", kNumber, "deg", "0",
                    "Of the axes above the plane of the ring, unless the robot's kind says where its LEDs look. They "
                    "look outwards.",
                    -90, 90}},
                  ColourNoiseParameters()),
       .robots = TagsOfKinds([](const Kind& kind) { return kind.leds.has_value(); })});
  DescribeSensor(
      {.label = "proximity",
       .implementation = "generic_proximity",
       .brief = "the proximity sensors of any robot that has them; 1 touching, falling evenly to 0 at the range",
       .parameters = Joined({{"range", kNumber, "m", "0",
                              "Distance from the sensor beyond which nothing is seen; 0: that of the kind.", 0, 1e6}},
                            NoiseParameters("each reading", "")),
       .robots = TagsOfKinds([](const Kind& kind) { return kind.proximity.has_value(); })});
  DescribeSensor(
      {.label = "light",
       .implementation = "generic_light",
       .brief = "light sensors in a ring, each with the lights that it sees by the inverse square of their "
                "distance, whatever the angle",
       .parameters = Joined(
           {{"sensors", kInteger, "", "24", "How many there are, evenly around the body.", 1, 360},
            {"first_angle", kNumber, "deg", "7.5", "Of the first one from the front, counter-clockwise.", -360, 360},
            {"radius", kNumber, "m", "0.085", "Of the ring.", 0, 1e6},
            {"height", kNumber, "m", "0.06", "Of the ring above the position of the robot.", 0, 1e6}},
           NoiseParameters("each reading", ""))});
  DescribeExponentialLight();
  DescribeSensor({.label = "ground",
                  .implementation = "generic_ground",
                  .brief = "brightness and colour of the floor under any robot that looks at it",
                  .parameters = GroundParameters(),
                  .robots = TagsOfKinds([](const Kind& kind) { return !kind.ground_points.empty(); })});
}

}  // namespace swarmanoid
