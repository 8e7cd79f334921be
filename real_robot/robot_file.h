// Reading what a robot is to run: an experiment file, of which one controller is taken, or a robot file that names one
// and chooses drivers. Nothing here knows the simulator: the world of the experiment file is passed over.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/configuration/configuration_tree.h"

namespace swarmanoid
{

// A device that the controller lists, with the choice of its driver.
struct RobotDevice
{
  std::string type;
  std::string driver;       // implementation of the driver; empty: the preferred one
  TConfigurationTree tree;  // of the driver: its parameters; does not exist if the file says nothing
  SourceLocation location;  // where the controller lists it
};

struct RobotConfiguration
{
  std::string id;
  std::string kind;  // "footbot", "eyebot" or "handbot"
  std::string name_space;
  std::uint32_t clock_tick_ms = 100;
  std::uint64_t seed = 1;
  std::string controller_tag;
  std::string controller_id;
  std::string controller_library;
  TConfigurationTree parameters;
  std::string folder;       // of the experiment file: relative paths of parameters start here
  SourceLocation location;  // of the controller
  SourceLocation library_location;
  std::vector<std::string> controller_path;
  std::vector<RobotDevice> sensors;
  std::vector<RobotDevice> actuators;
  std::vector<std::string> driver_libraries;
  std::vector<std::string> driver_path;
  std::string preferred_driver;
};

// What the command line says; empty: as in the file, or the default.
struct RobotChoice
{
  std::string controller{};  // its id in the experiment file
  std::string id{};
  std::string kind{};
  std::string name_space{};
  std::vector<std::string> controller_path{};
  std::vector<std::string> driver_libraries{};
  std::vector<std::string> driver_path{};
};

// Throws ConfigurationError with file:line:col and the cure.
RobotConfiguration ReadRobotFile(const std::string& path, const RobotChoice& choice);

}  // namespace swarmanoid
