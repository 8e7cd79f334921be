// How the same robot differs between the simulator's own engines: one table for docs/engines.md, `swarmanoid check
// --engine` and the test that runs each device in each engine.
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace swarmanoid
{

struct EngineDifference
{
  std::string_view subject;                // for users: the devices, or what all bodies do
  std::vector<std::string_view> channels;  // of these devices; empty: it concerns every experiment
  std::string_view kinematics2d, dynamics2d, dynamics3d;

  // Returns the text of an engine, by its tag; empty for engines of users.
  std::string_view In(std::string_view engine) const;
};

std::span<const EngineDifference> EngineDifferences();

}  // namespace swarmanoid
