#include <string>
#include <string_view>

#include "common/plugin_descriptions/device_tables.h"
#include "common/plugins/noise_parameters.h"
#include "common/plugins/parameter_checks.h"

namespace swarmanoid
{
namespace
{

using enum ParameterType;

std::vector<ParameterSpec> Argos3WheelParameters()
{
  std::vector<ParameterSpec> parameters{
      {"max_speed", kNumber, "m/s", "0",
       "Speed of a wheel on the ground to which commands are clamped; 0: none, as in ARGoS3.", 0, 1e6}};
  for (const std::string side : {"left", "right"})
  {
    const auto add = [&](const char* name, const char* unit, const char* value, const std::string& description)
    {
      parameters.push_back({name + ("_" + side), kNumber, unit, value, description + " of the " + side + " wheel."});
      parameters.back().minimum = std::string_view(name).ends_with("stddev") ? 0 : -1e6;
      parameters.back().maximum = 1e6;
    };
    add("bias_avg", "m/s", "0", "Mean of the bias");
    add("bias_stddev", "m/s", "0", "Standard deviation of the bias");
    add("factor_avg", "", "1", "Mean of the factor");
    add("factor_stddev", "", "0", "Standard deviation of the factor");
  }
  return parameters;
}

void DescribeWheels()
{
  const std::vector<ParameterSpec> common =
      Joined({{"max_speed", kNumber, "m/s", "0.3",
               "Speed of a wheel on the ground to which commands are clamped; 0.3 on the robot.", 0, 1e6}},
             NoiseParameters("the speed of each wheel while it moves", "m/s"));
  const auto describe = [](const char* implementation, const char* brief, std::vector<ParameterSpec> parameters)
  {
    DescribeActuator({.label = "footbot_wheels",
                      .implementation = implementation,
                      .brief = brief,
                      .parameters = std::move(parameters),
                      .robots = {"footbot"},
                      .channel = "footbot_wheels",
                      .channel_width = 2});
  };
  describe("dummy_footbot_wheels", "wheels that turn at the commanded speed at once, up to max_speed", common);
  describe(
      "noisy_footbot_wheels", "wheels with a bias and a factor on their speed while they move",
      Joined(common,
             {{"bias_left", kNumber, "m/s", "0", "Added to the speed of the left wheel while it moves.", -1e6, 1e6},
              {"bias_right", kNumber, "m/s", "0", "Added to the speed of the right wheel while it moves.", -1e6, 1e6},
              {"factor_left", kNumber, "", "1", "Multiplies the speed of the left wheel.", -1e6, 1e6},
              {"factor_right", kNumber, "", "1", "Multiplies the speed of the right wheel.", -1e6, 1e6}}));
  describe("argos3_footbot_wheels",
           "ARGoS3's noise: while a wheel moves, each turns at factor * (speed + bias), a bias drawn once and a factor "
           "drawn in every tick",
           Joined(Argos3WheelParameters(), NoiseParameters("the speed of each wheel while it moves", "m/s")));
  describe(
      "pid_footbot_wheels", "wheels that approach the commanded speed with the lag of a speed controller",
      Joined(common, {{"time_constant", kNumber, "s", "0.1",
                       "Time in which 63 % of a step in the commanded speed is reached; 0 follows at once.", 0, 1e6},
                      {"max_acceleration", kNumber, "m/s^2", "0",
                       "Largest change of a wheel's speed on the ground; 0 sets no limit.", 0, 1e6}}));
}

// The coefficients approximate the response of footbot_proximity.cpp: y = 1 below a contact distance, else a / (d + b).
// They are a Chebyshev interpolation of degree 8 between contact and 0.1 m; the largest error is 0.0036.
constexpr const char* kDefaultCoefficients =
    "2.910682, -347.09805, 22120.741, -833767.85, 19426124, -282177360, 2484022100, -12111713000, 25077147000";
constexpr double kFittedRange = 0.1;  // m

void DescribeProximity()
{
  const std::vector<ParameterSpec> common =
      Joined({{"range", kNumber, "m", "0.1", "Distance from the body beyond which nothing is seen.", 0, 1e6}},
             NoiseParameters("each reading", ""));
  DescribeSensor({.label = "footbot_proximity",
                  .implementation = "generic_footbot_proximity",
                  .brief = "24 rays of 0.1 m against robots, preys and blocks; response measured on the robot",
                  .parameters = common,
                  .robots = {"footbot"}});
  const PluginDescription polynomial{
      .label = "footbot_proximity",
      .implementation = "generic_footbot_polynomial_proximity",
      .brief = "the same rays; the response is a polynomial of the distance with given coefficients",
      .parameters = Joined({{"coefficients", kText, "", kDefaultCoefficients,
                             "c0, c1, c2 ... of the reading c0 + c1 d + c2 d^2 + ..., d the distance in m; cut to "
                             "0..1. The default is a fit up to 0.1 m."}},
                           common),
      .robots = {"footbot"}};
  ParameterChecks::Instance().Add(PluginKind::kSensor, polynomial, MistakesInPolynomial);
  DescribeSensor(polynomial);
}

void DescribeGripper()
{
  DescribeActuator({.label = "footbot_gripper",
                    .implementation = "dummy_footbot_gripper",
                    .brief = "opens and closes the gripper; closed, it holds what it touches",
                    .parameters = NoiseParameters("how far it closes, 0 to 1, while it is told to close", ""),
                    .robots = {"footbot"},
                    .channel = "footbot_gripper",
                    .channel_width = 1});
  DescribeSensor({.label = "footbot_gripper",
                  .implementation = "generic_footbot_gripper",
                  .brief = "aperture of the gripper, whether it holds something and what",
                  .parameters = NoiseParameters("the aperture", "rad"),
                  .robots = {"footbot"}});
}

void DescribeTurret()
{
  DescribeActuator({.label = "footbot_turret",
                    .implementation = "dummy_footbot_turret",
                    .brief = "turns the turret with gripper and LED ring at a given speed",
                    .parameters = Joined(
                        {{"max_speed", kNumber, "rad/s", "3.14159265", "Speed to which commands are clamped.", 0, 1e6}},
                        NoiseParameters("the speed while the turret is told to move", "rad/s")),
                    .robots = {"footbot"},
                    .channel = "footbot_turret",
                    .channel_width = 1});
  DescribeSensor({.label = "footbot_turret_encoder",
                  .implementation = "generic_footbot_turret_encoder",
                  .brief = "angle of the turret against the body",
                  .parameters = NoiseParameters("the angle", "rad"),
                  .robots = {"footbot"}});
  DescribeSensor({.label = "footbot_turret_torque",
                  .implementation = "engine_footbot_turret_torque",
                  .brief = "torque and pull between body and turret, as the engine computes them",
                  .parameters = NoiseParameters("each of the three readings", ""),
                  .robots = {"footbot"},
                  .channel = "footbot_turret_torque",
                  .channel_width = 3});
}

void DescribeLights()
{
  DescribeActuator({.label = "footbot_leds",
                    .implementation = "generic_footbot_leds",
                    .brief = "the 12 LEDs around the turret",
                    .parameters = LedRingParameters(),
                    .robots = {"footbot"}});
  DescribeActuator({.label = "footbot_beacon",
                    .implementation = "generic_footbot_beacon",
                    .brief = "the LED on top of the robot",
                    .parameters = ColourNoiseParameters(),
                    .robots = {"footbot"}});
  DescribeActuator(
      {.label = "footbot_preferential_direction",
       .implementation = "led_ring_preferential_direction",
       .brief = "shows a direction by lighting the LEDs that point to it",
       .parameters =
           Joined({{"width", kNumber, "degrees", "60",
                    "LEDs within half of this angle of the direction are lit; the nearest one always is.", 0, 360}},
                  NoiseParameters("the direction", "rad")),
       .robots = {"footbot"}});
}

}  // namespace

std::vector<ConfigurationError> MistakesInPolynomial(const Parameters& parameters)
{
  const std::string text = parameters.Text("coefficients");
  const auto coefficients = ParseNumbers(text);
  if (!coefficients || coefficients->empty())
    return {ConfigurationError(parameters.Tree().ValueLocation("coefficients"),
                               "<coefficients> '" + text + "' is not a list of numbers; write \"c0, c1, c2\"")};
  if (parameters.Number("range") > kFittedRange && !parameters.IsGiven("coefficients"))
    return {ConfigurationError(parameters.Tree().ValueLocation("range"),
                               "'range' of <" + parameters.Tree().Name() + "> is " + parameters.Text("range") +
                                   " m, but the default coefficients are a fit up to 0.1 m; give <coefficients> too, "
                                   "or use generic_footbot_proximity")};
  return {};
}

void DescribeLight(const std::string& robot)
{
  const auto describe = [&](const char* model, const char* brief)
  {
    DescribeSensor({.label = robot + "_light",
                    .implementation = model + ("_" + robot + "_light"),
                    .brief = brief,
                    .parameters = NoiseParameters("each reading", ""),
                    .robots = {robot}});
  };
  describe("generic", "24 sensors that see the light bulbs in line of sight, by the inverse square of the distance");
  describe("argos3", "the same with ARGoS3's brightness, exp(-2 d / intensity), up to d = 2.5 intensities");
}

void DescribeFootbotDevices()
{
  DescribeWheels();
  DescribeProximity();
  DescribeGripper();
  DescribeTurret();
  DescribeLights();
  DescribeSensor({.label = "footbot_encoders",
                  .implementation = "engine_footbot_encoders",
                  .brief = "how the wheels turned in the last tick, collisions and pulls included",
                  .parameters = NoiseParameters("the speed of each wheel", "rad/s"),
                  .robots = {"footbot"},
                  .channel = "footbot_encoders",
                  .channel_width = 2});
  DescribeSensor({.label = "footbot_accelerometer",
                  .implementation = "engine_footbot_accelerometer",
                  .brief = "acceleration of the body, gravity included, in engines that know forces",
                  .parameters = NoiseParameters("each component", "m/s^2"),
                  .robots = {"footbot"},
                  .channel = "footbot_accelerometer",
                  .channel_width = 3});
  DescribeLight("footbot");
  DescribeSensor({.label = "footbot_ground",
                  .implementation = "generic_footbot_ground",
                  .brief = "brightness and colour of the floor: finds the nest",
                  .parameters = GroundParameters(),
                  .robots = {"footbot"}});
  DescribeSensor({.label = "footbot_base_ground",
                  .implementation = "generic_footbot_base_ground",
                  .brief = "eight sensors around the base that tell black from white",
                  .parameters = GroundParameters(),
                  .robots = {"footbot"}});
  DescribeSensor({.label = "footbot_motor_ground",
                  .implementation = "generic_footbot_motor_ground",
                  .brief = "four sensors between the tracks that see greys",
                  .parameters = GroundParameters(),
                  .robots = {"footbot"}});
}

}  // namespace swarmanoid
