// RemoteGroups: the engine's side of groups that the regions of a split engine solve, in processes of their own
// (group_region.h). The engine finds the groups and moves isolated bodies. In each tick it gives each group to the
// region with the fewest bodies, with all that its motion follows from. So a region computes the same bits as the
// engine would, and remembers nothing but the models of all bodies.
//
// The stream to a region (region_streams.h) has: whether it gets the models; SolverSettings, threads and all models if
// it does; seconds of a step and steps in the tick; then for each group its bodies and forces (PutGroup). The result
// has for each group the steps done, whether a body goes too far, the bodies that move and their measures, and the
// contacts.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine_worker/engines/dynamics2d/group_solver.h"
#include "engine_worker/engines/rigid_bodies/region_streams.h"

namespace swarmanoid::dynamics2d
{

class RemoteGroups
{
public:
  // `team` outlives it.
  RemoteGroups(RegionTeam& team, unsigned threads);

  bool AreReady() const { return streams_.AreReady(); }
  void ForgetLoads();
  // Lists a group for Run, and chooses its region.
  void Add(GroupRun& run);
  // The regions solve the groups of the list. Calls meanwhile() while they do. The list is empty then.
  void Run(std::span<Body> bodies, const SolverSettings& settings, double seconds, int steps,
           const std::function<void()>& meanwhile);

private:
  RegionStreams streams_;
  unsigned threads_;
  std::vector<std::vector<GroupRun*>> runs_;  // by region
};

void PutModel(const Body& body, ByteWriter& stream);
void GetModel(Body& body, ByteReader& stream);
void PutGroup(std::span<const Body> bodies, const GroupRun& run, ByteWriter& stream);
// Refuses a group with bodies that do not exist.
void GetGroup(std::span<Body> bodies, GroupRun& run, ByteReader& stream);
void PutResult(std::span<const Body> bodies, const GroupRun& run, const SolverSettings& settings, ByteWriter& result);
void GetResult(std::span<Body> bodies, GroupRun& run, const SolverSettings& settings, ByteReader& result);

// Throws std::runtime_error: an engine and its regions do not fit together.
[[noreturn]] void RefuseGroup(const char* reason);

}  // namespace swarmanoid::dynamics2d
