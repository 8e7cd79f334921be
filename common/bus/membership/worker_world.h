// The world as a worker builds it from the space server's description: experiment, assignment and a space of its own.
// Used by engine workers, controller hosts and visualisers.
#pragma once

#include <memory>
#include <optional>

#include "common/bus/membership/tick_limits.h"
#include "common/bus/topics/session_messages.h"
#include "common/checkpoint/checkpoint.h"
#include "common/experiment/load_experiment.h"
#include "common/messages/assignment.h"
#include "common/space/space.h"

namespace swarmanoid
{

// What the world's experiment file says. The plug-in registries are filled. Throws ConfigurationError naming every
// mistake.
std::unique_ptr<Experiment> LoadWorld(const WorldMessage& world, const LoadOptions& options);

struct WorkerWorld
{
  // Throws as LoadWorld. `load_controllers`: only controller hosts need the users' libraries.
  WorkerWorld(const WorldMessage& world, bool load_controllers);

  std::unique_ptr<Experiment> experiment;
  Assignment assignment;
  // At tick 0 until Restore is called, so that all are made alike, whether the run starts or goes on.
  std::unique_ptr<CSwarmanoidSpace> space;
  std::unique_ptr<const TickLimits> limits;
  std::optional<Checkpoint> checkpoint;  // to go on from
  std::uint64_t FirstTick() const { return checkpoint ? checkpoint->snapshot.tick : 0; }

  // Brings the space, and a role by its LoadState, to where the run goes on; does nothing if it starts.
  template <class Role>
  void Restore(const std::string& name, Role& role)
  {
    if (!checkpoint) return;
    RestoreSpace();
    checkpoint->LoadPart(name, [&](ByteReader& state) { role.LoadState(state); });
  }
  void RestoreSpace();
};

// What the space server says of its world.
WorldMessage DescribeWorld(const CSwarmanoidSpace& space, std::uint64_t run, const std::string& file,
                           const HostTable& hosts);

// Whether hosts hear LocalState, if they know how far they reach: in memory that processes share it would save nothing,
// and a single host knows all.
bool HostsAskForParts(const WorldMessage& world);
// Likewise engines, which say themselves where their own entities are.
bool EnginesHearParts(const WorldMessage& world);
// Behind the slash of its partition.
std::string PartNameOfEngine(std::size_t engine);

// Whether the server waits for the commands of a host.
bool ServerHears(const HostLayout& host);

std::string VisualiserName(const RenderConfiguration& render);  // "visualiser 'text'"

}  // namespace swarmanoid
