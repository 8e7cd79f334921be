// How a run goes, as visualisers show it: its pace, its processes, and the results of users' requests.
#pragma once

#include <cstdint>
#include <string>

#include "idl/run_status.h"

namespace swarmanoid
{

// A request to the run and its result.
struct RunNote
{
  std::uint64_t tick = 0;    // at which it took effect
  bool done = true;          // false: refused
  std::string text;          // "moved 'fb_0' at tick 12", "move: there is no entity 'fb_x'"
  std::string from;          // "host:pid" of the asker; empty in one process
  std::uint32_t number = 0;  // of the request, among those of its sender
};

}  // namespace swarmanoid
