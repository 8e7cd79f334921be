// Reads the configuration of a robot: an experiment file, of which one controller is used, or a robot file that names
// one and chooses drivers. It does not depend on the simulator, and ignores the world of the experiment file.
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
  TConfigurationTree tree;  // the driver's parameters; does not exist if the file has none
  SourceLocation location;  // the position in the controller's list
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
  std::string folder;       // the experiment file's folder, where relative paths of parameters start
  SourceLocation location;  // the position of the controller
  SourceLocation library_location;
  std::vector<std::string> controller_path;
  std::vector<RobotDevice> sensors;
  std::vector<RobotDevice> actuators;
  std::vector<std::string> driver_libraries;
  std::vector<std::string> driver_path;
  std::string preferred_driver;
};

// The choices of the command line; an empty one leaves that of the file, or the default.
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
