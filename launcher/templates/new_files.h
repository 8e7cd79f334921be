// The files that `swarmanoid new` makes. Each function writes files, and prints their names and the next step. It
// throws UsageError if a name is invalid, a file exists already, or the folder is the wrong one.
#pragma once

#include <filesystem>
#include <string>

#include "common/space/terrain/rough_terrain.h"

namespace swarmanoid
{

// Returns the user directory around the current folder: the nearest folder upwards that has controllers/ and build.sh.
// The path is empty if there is none.
std::filesystem::path UserDirectoryHere();

void NewUserDirectory(const std::string& directory);
void NewController(const std::string& name);
void NewExperiment(const std::string& name);
void NewFunctions(const std::string& name);
void NewEngine(const std::string& name);
void NewRenderer(const std::string& name);
void NewDevice(const std::string& name);
void NewEntity(const std::string& name);
void NewLua(const std::string& name);
void NewPython(const std::string& name);
// Makes an OctoMap file and an experiment on it, here or in the user directory.
void NewTerrain(const std::string& name, const RoughTerrain& terrain);

// The names of a behaviour controller. Empty names follow from that of the controller.
struct BehaviorControllerNames
{
  std::string name;            // wall_follower: its folder, files, library and tag
  std::string class_name;      // CWallFollower
  std::string behavior;        // bt_footbot_wall_follower: the files of the root behaviour
  std::string behavior_class;  // CBTFootbotWallFollower
  std::string robot = "footbot";
  bool experiment = true;
};
void NewBehaviorController(BehaviorControllerNames names);

struct BehaviorNames
{
  std::string name;        // bt_footbot_wall_watch: its files
  std::string class_name;  // the behaviour controller that uses it; empty: the one in this folder
  std::string controller;  // must be the robot of that controller; empty: that robot
  std::string robot;       // refused if it is not that controller's; empty: whatever that is
};
void NewBehavior(BehaviorNames names);

}  // namespace swarmanoid
