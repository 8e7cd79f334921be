// The engine's side of a plane that is cut into regions, which compute its steps in processes of their own. The world
// keeps what an engine asks for: poses, turrets, grips, travel. In each tick it sends each region the commands of its
// bodies (a task) and takes their new states (a result). Regions remember the rest.
#pragma once

#include <vector>

#include "engine_worker/engines/kinematics2d/region_messages.h"

namespace swarmanoid::kinematics2d
{

class RegionTasks
{
public:
  // `team` outlives it.
  RegionTasks(const PlaneState& plane, RegionTeam& team);

  // Sets the cuts: region region_of_block[k] computes block k. Throws std::runtime_error for invalid cuts.
  void SetCuts(const PlaneState& plane, std::span<const std::uint8_t> region_of_block);
  // The caller reports each change that is no command: a body was put elsewhere, or came or went; a model was replaced;
  // all is other than the regions know.
  void BodyChanged(std::uint32_t body) { changed_.push_back(body); }
  void ModelChanged(std::uint32_t model) { changed_models_.push_back(model); }
  void AllChanged() { knows_all_ = false; }

  // Has the regions move all bodies. Returns false, and does nothing, if they are not ready.
  bool Advance(PlaneState& plane, double seconds, int steps);

private:
  void WriteForAll(const PlaneState& plane, bool all_data, double seconds, int steps, ByteWriter& task) const;
  void WriteBodies(const Bodies& bodies, const BroadPhase& broad, std::span<ByteWriter> tasks);
  void WriteChanges(const Bodies& bodies, std::span<ByteWriter> tasks) const;
  void ReadResult(PlaneState& plane, unsigned region);

  RegionTeam& team_;
  bool knows_all_ = false;  // the regions know all but the changes below
  bool knows_cuts_ = false;
  std::vector<std::uint32_t> changed_, changed_models_;
  std::vector<std::uint8_t> region_of_block_, region_of_cell_;
  std::vector<std::uint8_t> region_of_body_;        // the region that computed it last
  std::vector<std::vector<std::uint32_t>> bodies_;  // of each region, in the order of its last result
  std::vector<std::vector<char>> results_;
  std::vector<std::uint32_t> cells_;  // of the tick; here to be used again
};

}  // namespace swarmanoid::kinematics2d
