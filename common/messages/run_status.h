// How a run goes, as visualisers show it: its pace, its processes, and what users asked of it. Made by the space server
// or by the runner of a single process.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace swarmanoid
{

struct ProcessStatus
{
  std::string name;        // "space server", "engine 'ground'", "controller host 0", "visualiser 'window'"
  std::string process;     // "host:pid"
  std::uint64_t tick = 0;  // the last one that it answered
  // How long the run has been waiting for it by now; 0 if it is in time.
  double late_s = 0;
  std::string doing;  // what it says of that, such as "runs the controller of fb_3"; mostly empty
};

struct RunStatus
{
  enum class Phase
  {
    kUnknown,  // nothing has been heard yet
    kWaiting,  // for processes, before the first tick
    kRunning,
    kPaused,
    kFinished
  };

  Phase phase = Phase::kUnknown;
  std::uint64_t tick = 0;                // of the run; a picture may show an earlier one
  double speed_wanted = 0;               // simulated seconds in a second; 0: as fast as possible
  double real_time_factor = 0;           // simulated seconds in a second, over the last second or so; 0 while paused
  double ticks_per_second = 0;           // as above
  std::string ended;                     // kFinished: why, if it is not for maxclock or the experiment's own decision
  std::vector<ProcessStatus> processes;  // the space server first; in one process that alone
};

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
