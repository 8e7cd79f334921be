// A region of a split dynamics2d, in a process of its own: it solves the groups that its engine gives it. It needs no
// other region. remote_groups.h has the tasks and results.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "common/threads/worker_pool.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_world.h"
#include "engine_worker/engines/dynamics2d/remote_groups.h"
#include "engine_worker/engines/rigid_bodies/region_streams.h"

namespace swarmanoid::dynamics2d
{

// One group, in a world that has no other bodies. Bodies have the engine's numbers in orders, and numbers of their own
// in the world.
class GroupReplica
{
public:
  explicit GroupReplica(const RegionSettings& settings);
  // Executes orders. Throws std::runtime_error for orders that cannot be executed.
  void Execute(std::span<const char> orders);
  void PutResult(ByteWriter& result) const;

private:
  struct Member
  {
    std::uint32_t number;  // the engine's
    std::uint32_t own;
  };

  std::uint32_t OwnNumber(std::uint32_t number);
  void ReadGrip(Dynamics2dWorld::Body& body, ByteReader& orders);
  void BuildBody(std::uint32_t number, ByteReader& orders);
  void TakeOut(std::uint32_t number);
  void Change(EGroupOrder order, std::uint32_t number, ByteReader& orders);
  void MakeSteps(ByteReader& orders);
  GroupWorld& Group() { return *world_.worlds_.front(); }

  Dynamics2dWorld world_;
  std::vector<Member> known_;   // all bodies that were ever ordered, by number
  std::vector<Member> moving_;  // bodies in the world that are not static, by number
};

class GroupRegion final : public StreamedRegion
{
private:
  struct Due
  {
    GroupReplica* group;
    std::span<const char> orders;
  };

  void Execute(std::span<const char> stream, ByteWriter& result) override;
  void ReadSettings(ByteReader& task);

  RegionSettings settings_{};
  std::unique_ptr<WorkerPool> pool_;  // nullptr for one thread
  std::vector<Due> due_;              // of the task
  // By the engine's number of the world.
  std::unordered_map<std::uint32_t, std::unique_ptr<GroupReplica>> groups_;
};

}  // namespace swarmanoid::dynamics2d
