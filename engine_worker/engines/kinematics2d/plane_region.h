// One region of a plane that is cut, in a process of its own. It knows nothing before the first task, which tells it
// all. It holds the bodies in its blocks and in the cells around them, at most `halo` cells away, with numbers of its
// own. It holds followers, members of groups and bodies that are too large for the cells wherever they are. One cell of
// halo is enough, but then the sets of held bodies change in each substep.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "common/messages/regions.h"

namespace swarmanoid::kinematics2d
{

class PlaneRegion final : public EngineRegion
{
public:
  static constexpr unsigned kHalo = 2;
  // The region exchanges messages with the others by `exchange`, which outlives it. Throws std::runtime_error if there
  // is no such region.
  PlaneRegion(unsigned region, RegionExchange& exchange, unsigned halo = kHalo);
  ~PlaneRegion() override;
  // Executes a task and writes its result. Throws std::runtime_error for a malformed task.
  void Work(std::span<const char> task, ByteWriter& result) override;
  // The number of bodies that it holds.
  std::size_t BodyCount() const;

private:
  struct World;

  const unsigned number_;
  RegionExchange& exchange_;
  const unsigned halo_;
  std::vector<char> plan_;  // the pieces so far
  std::unique_ptr<World> world_;
};

}  // namespace swarmanoid::kinematics2d
