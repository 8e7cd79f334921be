// Finds our devices for a device of ARGoS3.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "argos3/converter/nodes.h"

namespace swarmanoid::argos3
{

// The properties of robots that share a controller of ours.
struct Bearers
{
  std::set<std::string> kinds;       // our kinds (robot_rows.h); empty: no robot of the file has it
  double camera_aperture = 70;       // degrees
  double perspective_aperture = 30;  // degrees
  double perspective_range = 2;      // m
  double radio_range = 3;            // m
  long long radio_bytes = 10;
  const ConfigurationNode* battery = nullptr;  // <battery>, or nullptr
  const ConfigurationNode* params = nullptr;   // <params> at the robots, or nullptr: those of the controller
};

// The map has each of our devices once, by type.
using Devices = std::map<std::string, Made>;

struct DeviceLists
{
  Devices sensors;
  Devices actuators;
};

// Receives a mistake or a note.
using Report = std::function<void(const SourceLocation&, const std::string&)>;

struct DeviceContext
{
  const Bearers& bearers;
  bool floor_is_painted = false;  // loop functions paint it
  double ticks_per_second = 10;
  double largest_radio_range = 3;  // m, of all robots
  // Messages end with a byte that tells the medium and the size. Otherwise there is one medium and one size.
  bool has_radio_channels = false;
  bool hears = false;                                   // the controller has the sensor range_and_bearing
  std::set<std::pair<std::string, std::string>> media;  // types and ids
  // Returns whether bodies hide senders of a medium from its receivers.
  std::function<bool(const std::string& medium)> checks_occlusions;
  Report mistake;
  Report note;
};

// The noise attributes of differential_steering. Each also exists with the suffix _left or _right.
inline constexpr std::array<const char*, 4> kWheelNoise{"bias_avg", "bias_stddev", "factor_avg", "factor_stddev"};

void ConvertSensor(const ConfigurationNode& node, const DeviceContext& context, DeviceLists& ours);
void ConvertActuator(const ConfigurationNode& node, const DeviceContext& context, DeviceLists& ours);
// Adds a sender, for robots that others only hear.
void AddSender(const SourceLocation& location, const DeviceContext& context, DeviceLists& ours);

}  // namespace swarmanoid::argos3
