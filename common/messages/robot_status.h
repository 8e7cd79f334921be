// The inside of one robot for users: its readings, its commands, the state of its controller. Controller hosts make it
// for the robots that a visualiser watches.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/control_interface/ci_device.h"

namespace swarmanoid
{

struct DeviceStatus
{
  std::string type;  // "footbot_proximity"
  std::vector<CCI_Reading> readings;
};

struct RobotStatus
{
  std::uint32_t entity = 0;
  std::uint64_t tick = 0;  // of the control step that this is the outcome of
  std::string controller;  // its id in <controllers>
  std::string text;        // CCI_Controller::StatusText
  std::string state;       // CCI_Controller::StateName: of its state machine, where it has one
  std::vector<DeviceStatus> sensors;
  std::vector<DeviceStatus> actuators;
};

}  // namespace swarmanoid
