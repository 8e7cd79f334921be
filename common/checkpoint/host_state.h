// The saved state of a controller host, robot by robot, so that any number of other hosts can continue with its robots.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/checkpoint/checkpoint.h"
#include "common/experiment/experiment.h"
#include "common/messages/assignment.h"
#include "common/serialisation/fields.h"

namespace swarmanoid
{

struct HostState
{
  // The state that the robots of a sensor share, by the numbers of their controller and of its sensor. It is the same
  // at all hosts.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::string> sensors;
  std::map<std::uint32_t, std::string> robots;  // by entity: the state of its controller and its devices

  static void Visit(auto& archive, auto& state)
  {
    archive.Map(state.sensors,
                [&](auto& sensor, auto& text)
                {
                  archive.Number(sensor.first);
                  archive.Number(sensor.second);
                  archive.Text(text);
                });
    archive.Map(state.robots,
                [&](auto& robot, auto& text)
                {
                  archive.Number(robot);
                  archive.Text(text);
                });
  }
};

// Returns the names of the parts that the processes of a run with so many controller hosts save.
std::vector<std::string> PartsOf(const Experiment& experiment, std::size_t hosts);

// Returns the parts with those of these controller hosts instead of the saved ones. Throws std::runtime_error if the
// state of a robot is missing.
std::vector<SavedPart> SharedOut(std::vector<SavedPart> parts, const Experiment& experiment, const HostTable& hosts);

}  // namespace swarmanoid
