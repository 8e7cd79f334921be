// Messages of a plane in regions: what the engine tells the regions and hears from them (region_tasks.cpp writes it,
// plane_region.cpp reads it), and the form of a body, which regions also send each other. Both sides include this file.
//
// A task has, in this order: TaskStart; a piece of the plan if the regions know nothing; then, unless more pieces
// follow: seconds, steps, cuts (none if they are known), changed models, FollowerTask of all followers, all grips. At
// last, a region that knows nothing gets its bodies (PutBody), another one ChangedBody, Twist, TurretRate.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "common/messages/regions.h"
#include "engine_worker/engines/kinematics2d/plane_step.h"

namespace swarmanoid::kinematics2d
{

struct TaskStart
{
  std::uint32_t piece;             // the number of the piece of the plan
  std::uint8_t is_plan_alone : 1;  // another piece comes before there is something to do
  std::uint8_t tells_all : 1;
  std::uint8_t has_changes : 1;
  std::uint8_t padding[3];
};
// The first part of a plan. All models, all static shapes, and FollowerPlan of all followers come next.
struct PlanStart
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

// A body as another region gets it. Bodies have the numbers of the whole plane.
struct BodyMessage
{
  struct Fixed
  {
    std::uint32_t number;
    std::uint32_t model : 30, is_present : 1, has_turret : 1;
    Pose2 pose;
    Twist twist;
  };
  struct TurretState
  {
    double angle, rate;
  };
  struct Travel
  {
    double forward, turn;
  };

  Fixed body;
  TurretState turret;  // sent if has_turret is true
  Travel travel;       // sent if the plane keeps travel
};

void PutBody(const Bodies& bodies, std::uint32_t body, std::uint32_t number, ByteWriter& message);
// Throws std::runtime_error for a body of an unknown model.
BodyMessage GetBody(const Bodies& bodies, ByteReader& message);

void PutModel(const CollisionModel& model, ByteWriter& message);
// Reads a model. Throws std::runtime_error for malformed data.
CollisionModel GetModel(ByteReader& message);

// Throws std::runtime_error: an engine and its regions, or two regions, do not fit together.
[[noreturn]] void RefuseRegion(const char* reason);
// Throws std::runtime_error if the cuts do not fit the plane and the number of regions.
void CheckCuts(const BroadPhase& broad, std::span<const std::uint8_t> region_of_block, unsigned regions);

}  // namespace swarmanoid::kinematics2d
