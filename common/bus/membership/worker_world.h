// A worker builds its world from the space server's description: experiment, assignment and its own space. Engine
// workers, controller hosts and visualisers use it.
#pragma once

#include <memory>
#include <optional>

#include "common/bus/membership/tick_limits.h"
#include "common/checkpoint/checkpoint.h"
#include "common/experiment/load_experiment.h"
#include "common/messages/assignment.h"
#include "common/run/visualiser_name.h"
#include "common/space/space.h"
#include "idl/messages.h"

namespace swarmanoid
{

// Loads the world's experiment. The plug-in registries are filled. Throws ConfigurationError that names every mistake.
std::unique_ptr<Experiment> LoadWorld(const WorldMessage& world, const LoadOptions& options);

struct WorkerWorld
{
  // Throws like LoadWorld. `load_controllers`: only controller hosts need the users' libraries.
  WorkerWorld(const WorldMessage& world, bool load_controllers);

  std::unique_ptr<Experiment> experiment;
  Assignment assignment;
  // The space is at tick 0 until Restore is called. So all processes build it alike, whether the run starts or resumes.
  std::unique_ptr<CSwarmanoidSpace> space;
  std::unique_ptr<const TickLimits> limits;
  std::optional<Checkpoint> checkpoint;  // the point where the run resumes
  std::uint64_t FirstTick() const { return checkpoint ? checkpoint->snapshot.tick : 0; }

  // Brings the space and a role (by its LoadState) to the checkpoint. Does nothing if the run starts.
  template <class Role>
  void Restore(const std::string& name, Role& role)
  {
    if (!checkpoint) return;
    RestoreSpace();
    checkpoint->LoadPart(name, [&](ByteReader& state) { role.LoadState(state); });
  }
  void RestoreSpace();
};

// Returns the space server's description of its world.
WorldMessage DescribeWorld(const CSwarmanoidSpace& space, std::uint64_t run, const std::string& file,
                           const HostTable& hosts);

// Returns whether hosts hear LocalState, if they know their reach. It saves nothing in shared memory, and a single host
// knows all entities.
bool HostsAskForParts(const WorldMessage& world);
// Returns the same for engines, which report the positions of their own entities themselves.
bool EnginesHearParts(const WorldMessage& world);
// Returns the name behind the slash of the engine's partition.
std::string PartNameOfEngine(std::size_t engine);

// Returns whether the server waits for the commands of a host.
bool ServerHears(const HostLayout& host);

}  // namespace swarmanoid
