// The devices that any robot can carry, whatever its shape: position, hearing, touch, reading and messages.
#include <string>
#include <utility>

#include "common/experiment/battery_model.h"
#include "common/plugin_descriptions/device_tables.h"
#include "common/plugin_descriptions/shared_channel_parameters.h"
#include "common/plugins/noise_parameters.h"
#include "common/plugins/parameter_checks.h"

namespace swarmanoid
{
namespace
{

using enum ParameterType;

constexpr long long kMostBeams = 65536;  // of a range scanner

ParameterSpec Share(const char* name, const char* description) { return {name, kNumber, "", "0", description, 0, 1}; }

ParameterSpec Length(const char* name, const char* value, const char* description, double least = 0)
{
  return {name, kNumber, "m", value, description, least, 1e6};
}

ParameterSpec Consumption(const char* name, const char* unit, const char* value, const char* description)
{
  return {name, kNumber, unit, value, description, 0, 1e6};
}

void DescribeMotionSensors()
{
  DescribeSensor({.label = "positioning",
                  .implementation = "generic_positioning",
                  .brief = "position and orientation in the space, as a tracking system tells them",
                  .parameters = Joined(NoiseParameters("each coordinate", "m", "position_"),
                                       NoiseParameters("the heading", "rad", "heading_"))});
  DescribeSensor({.label = "gyroscope",
                  .implementation = "generic_gyroscope",
                  .brief = "angular velocities about the axes of the robot, mean over the last tick",
                  .parameters = NoiseParameters("each angular velocity", "rad/s")});
  DescribeSensor(
      {.label = "battery",
       .implementation = "generic_battery",
       .brief = "a charge that falls with time, way and turning",
       .parameters = Joined({{"start_charge", kNumber, "", "1", "Charge at the start; 1 is full.", 0, 1},
                             Consumption("per_second", "1/s", "1e-4", "Charge that a second takes."),
                             Consumption("per_metre", "1/m", "1e-3", "Charge that a metre of way takes."),
                             Consumption("per_radian", "1/rad", "1e-3", "Charge that a radian of turning takes.")},
                            NoiseParameters("the charge that is read", ""))});
  DescribeSensor({.label = "battery",
                  .implementation = kEnergyBattery,
                  .brief = "the charge of a battery that the robot's parts draw from and charging stations fill",
                  .parameters = Joined(BatteryParameters(), NoiseParameters("the charge that is read", ""))});
}

void DescribeMicrophones()
{
  const std::vector<ParameterSpec> common =
      Joined({Length("height", "0.1", "Of the microphone above the base."),
              {"threshold", kNumber, "", "0.001",
               "Sound pressure below which nothing is heard; 1 is that of intensity 1 at 1 m.", 0, 1e6}},
             NoiseParameters("the pressure of each sound", "", "loudness_"));
  const std::vector<ParameterSpec> directional =
      Joined(common, NoiseParameters("bearing and elevation of each sound", "rad", "angle_"));
  const auto describe = [](const char* model, const char* brief, std::vector<ParameterSpec> parameters)
  {
    DescribeSensor({.label = "microphone",
                    .implementation = model + std::string("_microphone"),
                    .brief = brief,
                    .parameters = std::move(parameters)});
  };
  describe("generic", "an array that hears each sound source with its direction; pressure is intensity / distance",
           directional);
  describe("shadowed", "the same; bodies between muffle the sound",
           Joined({{"shadow", kNumber, "", "0.25", "Multiplies the pressure of a source that is hidden.", 0, 1}},
                  directional));
  describe("capsule", "a single capsule: the pressure of all sounds together, without direction", common);
}

void DescribeDistanceScanners()
{
  DescribeSensor(
      {.label = "footbot_distance_scanner",
       .implementation = "generic_footbot_distance_scanner",
       .brief = "two beams of 0.26 m and two of 0.12 to 1.42 m on a head that turns",
       .parameters = Joined(
           {{"rotation_speed", kNumber, "rad/s", "0",
             "Of the head; while it turns each beam measures six times a tick. 0: the short beams look ahead and back.",
             -1e6, 1e6}},
           NoiseParameters("each distance", "m")),
       .robots = {"footbot"}});
  DescribeSensor({.label = "footbot_distance_scanner",
                  .implementation = "argos3_footbot_distance_scanner",
                  .brief = "two beams of 0.26 m and two of 0.12 to 1.42 m, off until the controller turns the head",
                  .parameters = NoiseParameters("each distance", "m"),
                  .robots = {"footbot"}});
  DescribeSensor({.label = "eyebot_distance_scanner",
                  .implementation = "generic_eyebot_distance_scanner",
                  .brief = "32 beams of 15 m all around",
                  .parameters = NoiseParameters("each distance", "m"),
                  .robots = {"eyebot"}});
}

ParameterSpec Count(const char* name, const char* value, const char* description, double most)
{
  return {name, kInteger, "", value, description, 1, most};
}

ParameterSpec Angle(const char* name, const char* value, const char* description, double least, double most)
{
  return {name, kNumber, "deg", value, description, least, most};
}

std::vector<ConfigurationError> MistakesInDepths(const Parameters& parameters)
{
  if (parameters.Number("nearest") < parameters.Number("range")) return {};
  return {ConfigurationError(parameters.Tree().ValueLocation(parameters.IsGiven("nearest") ? "nearest" : "range"),
                             "'nearest' of <" + parameters.Tree().Name() + "> is " + parameters.Text("nearest") +
                                 " m and 'range' " + parameters.Text("range") + " m; nearest must be less")};
}

void DescribeDepthCamera()
{
  const PluginDescription camera{
      .label = "depth_camera",
      .implementation = "generic_depth_camera",
      .brief = "a small image of depths and colours, by a ray through the middle of each pixel",
      .parameters = Joined(
          Joined(
              {Count("width", "32", "Pixels of a row.", 256),
               Count("height", "24", "Rows.", 256),
               Angle("field_of_view", "60", "Between the left and the right border of the image.", 1, 150),
               Length("range", "5", "Greatest depth that is measured.", 0.001),
               Length("nearest", "0", "Least depth; what is nearer is not seen, and hides nothing."),
               {"position", kVector3, "m", "0, 0, 0.1",
                "Of the camera, in the frame of the robot, which it does not see itself.", -1e6, 1e6},
               Angle("pan", "0", "Of its axis to the left of the robot's front.", -180, 180),
               Angle("tilt", "0", "Of its axis above the plane of the robot's base; -90 looks straight down.", -90, 90),
               {"floor_colour", kColour, "", "#ffffff", "Colour of the floor outside all patches."}},
              NoiseParameters("each depth", "m", "depth_")),
          NoiseParameters("red, green and blue of each pixel", "1/255", "colour_"))};
  ParameterChecks::Instance().Add(PluginKind::kSensor, camera, MistakesInDepths);
  DescribeSensor(camera);
}

std::vector<ConfigurationError> MistakesInBeams(const Parameters& parameters)
{
  std::vector<ConfigurationError> mistakes = MistakesInDepths(parameters);
  const long long beams = parameters.Integer("beams"), layers = parameters.Integer("layers");
  if (beams * layers > kMostBeams)
    mistakes.push_back(ConfigurationError(
        parameters.Tree().ValueLocation(parameters.IsGiven("layers") ? "layers" : "beams"),
        "<" + parameters.Tree().Name() + "> has " + std::to_string(beams) + " beams in each of " +
            std::to_string(layers) + " layers; " + std::to_string(kMostBeams) + " beams in all are the most"));
  return mistakes;
}

void DescribeRangeScanner()
{
  const PluginDescription scanner{
      .label = "range_scanner",
      .implementation = "generic_range_scanner",
      .brief = "a laser scanner: distances along many beams, in one or several layers",
      .parameters = Joined({Count("beams", "360", "Beams of a layer, evenly spaced from right to left.", 8192),
                            Angle("field_of_view", "360",
                                  "Between the first and the last beam; 360: all around, from the back.", 1, 360),
                            Count("layers", "1", "Layers of beams, from the lowest up.", 256),
                            Angle("vertical_field_of_view", "30",
                                  "Between the lowest and the highest layer, if there are several.", 1, 170),
                            Length("range", "10", "Longest distance that is measured.", 0.001),
                            Length("nearest", "0", "Shortest distance that is measured; what is nearer reads 0."),
                            {"position", kVector3, "m", "0, 0, 0.1",
                             "Of the scanner, in the frame of the robot, which it does not see itself.", -1e6, 1e6},
                            Angle("pan", "0", "Of its middle beam to the left of the robot's front.", -180, 180)},
                           NoiseParameters("each distance", "m"))};
  ParameterChecks::Instance().Add(PluginKind::kSensor, scanner, MistakesInBeams);
  DescribeSensor(scanner);
}

void DescribeRadio()
{
  DescribeActuator(
      {.label = "radio",
       .implementation = "generic_radio",
       .brief = "sends packets of up to 30 bytes, one a tick, within a bandwidth",
       .parameters =
           Joined({{"bandwidth", kNumber, "bytes/s", "0",
                    "Packets wait until the ones before are through; 0: one packet a tick is the only limit.", 0, 1e6},
                   Count("queue", "16", "Packets that may wait, with the one that is sent in the tick.", 16)},
                  NoiseParameters("each byte that is sent", "1/255")),
       .robots = {"footbot", "eyebot", "handbot"}});
  DescribeSensor(
      {.label = "radio",
       .implementation = "generic_radio",
       .brief = "receives the packets of all radios in range, whatever stands between",
       .parameters = Joined(
           {Length("range", "10", "Distance from which packets are received.", 0.001),
            Share("loss_probability", "Share of the packets that get lost."),
            {"latency", kNumber, "s", "0",
             "Time that packets take beyond the one tick that everything takes; whole ticks, rounded up.", 0, 3600}},
           NoiseParameters("each signal strength", "dB")),
       .robots = {"footbot", "eyebot", "handbot"}});
  DescribeSensor(
      {.label = "radio",
       .implementation = "shared_radio",
       .brief = "receives what gets through a channel that all radios share: packets collide and links are shadowed",
       .parameters =
           Joined(Joined(SharedChannelParameters("10"),
                         {{"latency", kNumber, "s", "0",
                           "Time that packets take beyond the one tick that everything takes; whole ticks, rounded up.",
                           0, 3600}}),
                  NoiseParameters("each signal strength", "dB")),
       .robots = {"footbot", "eyebot", "handbot"}});
}

}  // namespace

void DescribeSurroundingsDevices()
{
  DescribeMotionSensors();
  DescribeMicrophones();
  DescribeDistanceScanners();
  DescribeDepthCamera();
  DescribeRangeScanner();
  DescribeRadio();
  DescribeActuator({.label = "report",
                    .implementation = "generic_report",
                    .brief = "tells the experiment functions something, once a tick",
                    .robots = {"footbot", "eyebot", "handbot"}});
  DescribeSensor({.label = "instruction",
                  .implementation = "generic_instruction",
                  .brief = "what the experiment functions tell the robot",
                  .robots = {"footbot", "eyebot", "handbot"}});
  DescribeSensor({.label = "contact",
                  .implementation = "generic_contact",
                  .brief = "a bumper: the directions of all bodies that touch the robot",
                  .parameters = Joined({Length("reach", "0.002", "Gap up to which bodies count as touching.")},
                                       NoiseParameters("each direction", "rad"))});
  DescribeSensor(
      {.label = "tag_reader",
       .implementation = "generic_tag_reader",
       .brief = "reads the ids of tagged entities near its antenna (RFID)",
       .parameters = Joined({Length("range", "0.15", "Distance within which tags answer.", 0.001),
                             Length("height", "0", "Of the antenna above the base."),
                             {"tagged", kText, "", "*",
                              "Ids of the entities with tags, or patterns such as prey_*, with commas between."},
                             Share("miss_probability", "Share of the tags that do not answer in a tick.")},
                            NoiseParameters("each distance", "m"))});
}

}  // namespace swarmanoid
