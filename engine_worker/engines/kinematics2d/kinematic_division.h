// What a kinematic world has and does more if processes of their own have the regions of it. Private to it.
//
// The world keeps what an engine asks for: poses, turrets, grips, travel. Each tick it tells each region what its
// bodies do (a task), and takes over what became of them (a result). Regions remember the rest; how they speak with one
// another is in kinematic_region.h. A region that is told all gets the plan of the world before: models, static shapes,
// cells, followers; in pieces, since there may be any number of walls. Tasks and results are written and read in
// kinematic_division.cpp alone.
#pragma once

#include <vector>

#include "common/messages/regions.h"
#include "engine_worker/engines/kinematics2d/kinematic_world.h"

namespace swarmanoid::kinematics2d
{

class KinematicWorld::Division
{
public:
  Division(const KinematicWorld& world, RegionTeam& team);

  void SetCuts(const KinematicWorld& world, std::span<const std::uint8_t> region_of_block);
  // A body was put elsewhere, or came or went; a model was replaced; all is other than the regions know.
  void BodyChanged(std::uint32_t body) { changed_.push_back(body); }
  void ModelChanged(std::uint32_t model) { changed_models_.push_back(model); }
  void AllChanged() { knows_all_ = false; }

  // False, and nothing is done, if the regions are not ready.
  bool Advance(KinematicWorld& world, double seconds, int steps);

private:
  friend class PlaneRegion;

  // What comes first in a task.
  struct TaskStart
  {
    std::uint32_t piece;             // of the plan, which follows
    std::uint8_t is_plan_alone : 1;  // another piece comes before there is something to do
    std::uint8_t tells_all : 1;
    std::uint8_t has_changes : 1;
    std::uint8_t padding[3];
  };
  // The parts of plans, tasks and results.
  struct Outset
  {
    PlaneGrid grid;
    double elasticity, median_core, smallest_limit;
    std::uint32_t threads, keeps_travel;
  };
  struct FollowerPlan
  {
    std::uint32_t number, model;
  };
  struct FollowerTask
  {
    Pose2 now, from, goal;
    std::uint64_t is_present;
  };
  struct ChangedBody
  {
    std::uint32_t number;
    std::uint32_t is_present;
    Pose2 pose;
  };
  struct TurretRate
  {
    std::uint32_t number;
    std::uint32_t padding;
    double rate;
  };
  struct TurretAngle
  {
    std::uint32_t number;
    std::uint32_t padding;
    double angle;
  };

  static ByteWriter PlanOf(const KinematicWorld& world);
  void WriteForAll(const KinematicWorld& world, bool anew, double seconds, int steps, ByteWriter& task) const;
  void WriteBodies(const KinematicWorld& world, std::span<ByteWriter> tasks);
  void WriteChanges(const KinematicWorld& world, std::span<ByteWriter> tasks);
  void ReadResult(KinematicWorld& world, unsigned region, std::span<const char> bytes);
  [[noreturn]] static void Refuse(const char* what);

  // The other side.
  static std::unique_ptr<KinematicWorld> WorldOf(std::span<const char> plan, unsigned region, RegionExchange& exchange,
                                                 unsigned halo);
  static void DoTask(KinematicWorld& world, bool anew, ByteReader& task, ByteWriter& result);
  static void TakeChanges(KinematicWorld& world, ByteReader& task);
  static void WriteResult(const KinematicWorld& world, ByteWriter& result);

  RegionTeam& team_;
  bool knows_all_ = false;  // the regions, but for what follows
  bool knows_cuts_ = false;
  std::vector<std::uint32_t> changed_, changed_models_;
  std::vector<std::uint8_t> region_of_block_;
  std::vector<std::uint8_t> region_of_cell_;
  std::vector<std::uint8_t> region_of_body_;        // that computed it last
  std::vector<std::vector<std::uint32_t>> bodies_;  // of each region, as it told them last
  std::vector<std::vector<char>> results_;
  std::vector<std::uint32_t> cells_;  // of the tick; here to be used again
};

}  // namespace swarmanoid::kinematics2d
