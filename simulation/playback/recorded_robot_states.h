// RecordedRobotStates: the inside of robots at a tick of the past. The journal has what their controller hosts took in,
// not what sensors read from it; so the hosts of these robots step again in this process, from the newest state that
// was saved, and what they command is compared with the journal. Engines need not step. Used by `swarmanoid inspect`.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/experiment/experiment.h"
#include "common/messages/assignment.h"
#include "common/messages/robot_status.h"

namespace swarmanoid
{

class RecordedRobotStates
{
public:
  // `run_folder` has the journal of a run of the experiment, which was read with the users' libraries and outlives
  // this. `robots`: entities that have controllers. Throws std::runtime_error, with a text for the user, if the tick
  // cannot be computed again or another one comes of it, and ActivityError for what controllers throw; one that crashes
  // ends the process.
  RecordedRobotStates(const Experiment& experiment, const std::string& run_folder, std::uint64_t tick,
                      std::span<const std::uint32_t> robots);

  // After their control steps at the tick, in the order in which they were given.
  const std::vector<RobotStatus>& Robots() const { return robots_; }

private:
  std::vector<RobotStatus> robots_;
};

}  // namespace swarmanoid
