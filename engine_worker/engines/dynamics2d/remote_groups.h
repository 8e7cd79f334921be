// RemoteGroups: the engine's side of groups that the regions of a split engine solve, in processes of their own
// (group_region.h). The engine finds the groups, moves isolated bodies, and gives each group that begins to the region
// with the fewest bodies. All calls on a group's world become orders, which the region executes as they would have been
// here. So it computes the same bits, whatever else it has.
//
// The stream to a region (region_streams.h) has: whether it gets everything; then RegionSettings, or the numbers of
// closed worlds; then for each world its number, whether it is new, and its orders. The result has the steps done,
// whether a body goes too far, contacts, and the motion and measures of each body that moves, in the order of the
// bodies.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine_worker/engines/dynamics2d/group_world.h"
#include "engine_worker/engines/rigid_bodies/region_streams.h"

namespace swarmanoid::dynamics2d
{

// The number of a body follows each order but kSteps, and then its motion and grip, unless stated otherwise.
enum class EGroupOrder : std::uint8_t
{
  kBuild,        // the body comes; its model comes first, the distance of its wheels and its command last
  kTakeOut,      // the body leaves; nothing follows
  kPlace,        // it has another pose
  kSetVelocity,  // it has another velocity
  kSetSolid,     // it begins or ceases to touch others
  kSetOutline,   // its corners come first
  kGrip,         // a joint to the gripped body begins
  kEndGrip,
  kTurnGripper,
  kSteps  // seconds of a step, steps in the tick, steps done, whether all bodies are one group; of each dynamic body
          // the largest way, and its command if that is another one
};

// The settings of a region. They are the same for all its groups.
struct RegionSettings
{
  std::int32_t velocity_iterations, position_iterations;
  double turret_torque;  // N m
  std::uint32_t measures_loads;
  std::uint32_t threads;
};

class RemoteGroups
{
public:
  // `team` outlives it.
  RemoteGroups(RegionTeam& team, unsigned threads);

  bool AreReady() const { return streams_.AreReady(); }

  // Choose the region of a group that begins, by the numbers of bodies.
  void ForgetLoads() { streams_.ForgetLoads(); }
  void AddLoad(std::uint32_t region, std::size_t bodies) { streams_.AddLoad(region, bodies); }
  std::uint32_t ChooseRegion(std::size_t bodies) { return streams_.ChooseRegion(bodies); }

  // The world of a region has ended.
  void Close(std::uint32_t region, std::uint32_t number) { closed_[region].push_back(number); }

  // Lists a world that a region has, for Run.
  void Add(std::uint32_t group, std::uint32_t number, GroupWorld& world) { parts_.push_back({group, number, &world}); }
  // The regions execute the new orders of all worlds in the list. Calls meanwhile() while they do, and then take(group,
  // result) for each world that had some. The list is empty then.
  void Run(RegionSettings settings, const std::function<void()>& meanwhile,
           const std::function<void(std::uint32_t, ByteReader&)>& take);

private:
  struct Part
  {
    std::uint32_t group, number;
    GroupWorld* world;
  };
  void Write(bool all_data, const RegionSettings& settings, std::span<ByteWriter> streams);

  RegionStreams streams_;
  unsigned threads_;
  std::vector<std::vector<std::uint32_t>> closed_;  // worlds, by region
  std::vector<Part> parts_;
  std::vector<std::vector<std::size_t>> sent_;  // parts, by region
};

void PutPolygon(std::span<const Vector2> polygon, ByteWriter& orders);
// Throws std::runtime_error: an engine and its regions do not fit together.
[[noreturn]] void RefuseGroup(const char* reason);

}  // namespace swarmanoid::dynamics2d
