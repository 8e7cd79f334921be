// Which devices of ours stand for one of ARGoS3.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "argos3/converter/nodes.h"

namespace swarmanoid::argos3
{

// What the robots of a controller are.
struct Bearers
{
  std::set<std::string> kinds;       // "footbot", "eyebot", "argos3_epuck"
  double camera_aperture = 70;       // degrees
  double perspective_aperture = 30;  // degrees
  double perspective_range = 2;      // m
  double radio_range = 3;            // m
  long long radio_bytes = 10;
  const ConfigurationNode* battery = nullptr;  // <battery>, if there is one
};

// Ours, by type, each once.
using Devices = std::map<std::string, Made>;

struct DeviceLists
{
  Devices sensors;
  Devices actuators;
};

// Where a mistake or a note goes.
using Report = std::function<void(const SourceLocation&, const std::string&)>;

struct DeviceContext
{
  const Bearers& bearers;
  bool floor_is_painted = false;  // by loop functions
  double ticks_per_second = 10;
  Report mistake;
  Report note;
};

// Of differential_steering; each also with _left or _right behind it.
inline constexpr std::array<const char*, 4> kWheelNoise{"bias_avg", "bias_stddev", "factor_avg", "factor_stddev"};

void ConvertSensor(const ConfigurationNode& node, const DeviceContext& context, DeviceLists& ours);
void ConvertActuator(const ConfigurationNode& node, const DeviceContext& context, DeviceLists& ours);
// A sender, for robots that only others hear.
void AddSender(const SourceLocation& location, const DeviceContext& context, DeviceLists& ours);

}  // namespace swarmanoid::argos3
