// Assignment: which host runs which robots, which engine owns which entities, and the position of each value of a
// specific device in the messages between them. It is a pure function of the experiment and the host table, so it is
// equal in every process.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "common/experiment/experiment.h"
#include "idl/host_table.h"

namespace swarmanoid
{

// Returns whether all robots are of existing hosts, and there are at least one and at most as many hosts as robots.
bool IsSound(const HostTable& table);

// The values of one channel for some robots, contiguous: robot after robot, `width` doubles each.
struct ChannelBlock
{
  std::string name;
  int width = 0;
  std::vector<std::uint32_t> entities;  // ascending
  std::size_t offset = 0;               // of the first double within the message
};

struct ValueCopy
{
  std::uint32_t source = 0;  // host (commands) or engine (sensor frames)
  std::size_t from = 0;
  std::size_t to = 0;
  std::size_t count = 0;  // doubles
};

// The copy of one robot's values.
struct RobotCopy
{
  std::uint32_t robot = 0;
  ValueCopy copy;
};

struct HostLayout
{
  std::vector<std::uint32_t> robots;  // ascending
  std::vector<ChannelBlock> commands;
  std::size_t command_size = 0;  // doubles in ControlCommands::values
  std::vector<ChannelBlock> sensors;
  std::size_t sensor_size = 0;
  std::vector<ValueCopy> sensor_copies;  // from the engines' frames
  // From the frames of all engines that can move a robot that changes its engine. Those of the engine that moved the
  // robot in the last tick count (CSwarmanoidSpace::EngineBefore).
  std::vector<RobotCopy> sensor_choices;
  std::vector<std::uint32_t> frames_from;  // engines whose frames the host waits for
  bool reports_to_server =
      false;  // the server waits for its commands: generic actuators, robots in no engine, or that may fail
};

// An owned entity of engines with volumes: its places in EngineLayout::owned and Experiment::engine_choices.
struct VolumeMember
{
  std::uint32_t place = 0;
  std::uint32_t choice = 0;
};

struct EngineLayout
{
  std::vector<std::uint32_t> owned;     // movable entities that this engine moves or can move, ascending
  std::vector<std::uint32_t> mirrored;  // movable entities that another engine moves or can move, ascending
  std::vector<std::uint32_t> changing;  // those in both lists, which change their engine
  std::vector<VolumeMember> members;    // owned ones that stay in volumes, ascending
  std::vector<std::uint32_t> fixed;     // static entities
  std::vector<ChannelBlock> commands;
  std::size_t command_size = 0;
  std::vector<ValueCopy> command_copies;
  std::vector<std::uint32_t> commands_from;  // hosts whose commands the engine waits for
  std::vector<ChannelBlock> sensors;
  std::size_t sensor_size = 0;
};

struct Assignment
{
  HostTable table;
  std::vector<HostLayout> hosts;
  std::vector<EngineLayout> engines;
  std::vector<int> owner;  // of each entity: engine index, -1 for none
  std::vector<int> host;   // of each entity: host index, -1 for none
};

// Distributes robots to hosts. Each host has about as many robots, near each other and of one engine if possible: the
// swarm is halved across its longer side, again and again. There is at least one host, and never more hosts than
// robots. `poses` are as in SpaceState; if empty, the start poses count. Throws std::runtime_error if they are of other
// entities.
HostTable DealRobots(const Experiment& experiment, unsigned hosts, std::span<const double> poses = {});
// Needs the device registries. Throws std::runtime_error if the table is of other robots.
Assignment MakeAssignment(const Experiment& experiment, const HostTable& table);
// Makes the assignment with robots distributed by their start poses.
Assignment MakeAssignment(const Experiment& experiment, unsigned hosts);

std::string EngineName(const Experiment& experiment, std::size_t engine);  // "engine 'ground'"
std::string HostName(std::size_t host);                                    // "controller host 1"
// "region 2 of engine 'ground'"; and its number, counted over the regions of all engines that are split.
std::string RegionName(const Experiment& experiment, std::size_t engine, unsigned region);
unsigned RegionNumber(const Experiment& experiment, std::size_t engine, unsigned region);
// How many processes an engine has beside its worker: 0 if it is not split.
unsigned RegionsOf(const EngineConfiguration& engine);
// Return the engine that moves an entity at the start, and the host that runs its controller. The text is empty if
// there is no such process.
std::string OwnerName(const Experiment& experiment, const Assignment& assignment, std::size_t entity);
std::string HostNameOf(const Assignment& assignment, std::size_t entity);

}  // namespace swarmanoid
