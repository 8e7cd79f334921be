// RecordedRobotStates: the inside of robots at a past tick. The journal has the inputs of their controller hosts, not
// the readings of sensors. So the hosts of these robots step again in this process, from the newest saved state, and
// their commands are compared with the journal. Engines need not step. `swarmanoid inspect` uses it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/experiment/experiment.h"
#include "common/messages/assignment.h"
#include "idl/robot_status.h"

namespace swarmanoid
{

class RecordedRun;

class RecordedRobotStates
{
public:
  // `run_folder` has the journal of a run of the experiment. The experiment must be loaded with the users' libraries
  // and outlive the object. `robots`: entities with controllers. Throws std::runtime_error, with a text for the user,
  // if the tick cannot be computed again or the commands differ. Throws ActivityError if a controller throws; a
  // controller that crashes ends the process.
  RecordedRobotStates(const Experiment& experiment, const std::string& run_folder, std::uint64_t tick,
                      std::span<const std::uint32_t> robots);

  // Returns the robots after their control steps at the tick, in the given order.
  const std::vector<RobotStatus>& Robots() const { return robots_; }

private:
  std::vector<RobotStatus> robots_;
};

// Returns the same for a run of one process, whose loop functions of ARGoS3 work with controllers directly: the whole
// run is computed again, and its state is compared with the journal. `output_folder`: for what the run writes.
std::vector<RobotStatus> StatesInWholeRun(const Experiment& experiment, RecordedRun& run, std::uint64_t tick,
                                          std::span<const std::uint32_t> robots, const std::string& output_folder);

}  // namespace swarmanoid
