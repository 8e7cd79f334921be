// Makes the simulators that a user's watch function gets at each tick, in one process and as a cluster.
#pragma once

#include "common/checkpoint/checkpoint.h"
#include "idl/robot_status.h"
#include "simulation/simulator.h"

namespace swarmanoid
{

using WatchFunction = std::function<void(CSimulator&)>;

class RunLink;

// What accompanies a run in one process.
struct RunCompanions
{
  WatchFunction watch{};
  // File for the journal, or empty. The journal has the states of all ticks and what controllers commanded, but no
  // saved states: no run continues from it.
  std::string journal_file{};
  RunLink* link = nullptr;  // nullptr: no user outside of this process finds the run
};

struct WatchedSimulator
{
  // Returns a simulator that runs the experiment with companions. Throws std::runtime_error if the journal cannot be
  // made.
  static CSimulator Running(const Experiment& experiment, const SimulatorOptions& options, RunCompanions companions)
  {
    return {experiment, options, std::move(companions)};
  }
  // Returns a simulator with as many controller hosts as the cluster whose checkpoints it reads and takes.
  static CSimulator Computing(const Experiment& experiment, const SimulatorOptions& options, unsigned hosts)
  {
    return {experiment, options, RunCompanions(), hosts};
  }
  static Checkpoint CheckpointOf(CSimulator& simulator, bool canonicalise)
  {
    return simulator.TakeCheckpoint(canonicalise);
  }
  static bool IsCanonical(const CSimulator& simulator) { return simulator.IsCanonical(); }
  // Describes a robot after its last control step. Returns false for an entity without a controller.
  static bool Describe(const CSimulator& simulator, std::uint32_t robot, RobotStatus& status);
  // Returns a simulator for reading the space server of a cluster.
  static CSimulator Of(SpaceServer& server) { return CSimulator(server); }
};

}  // namespace swarmanoid
