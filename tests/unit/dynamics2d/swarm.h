// Scenes of dynamics2d that threads and regions must compute with the bits of one thread.
#pragma once

#include <vector>

#include "common/math/random.h"
#include "dynamics2d_test_world.h"
#include "engine_worker/engines/dynamics2d/group_region.h"
#include "tests/unit/engines/local_team.h"

namespace swarmanoid
{

// The regions of dynamics2d in the thread of the caller.
class TeamOfDynamics2d : public LocalTeam
{
public:
  explicit TeamOfDynamics2d(unsigned regions)
      : LocalTeam(regions, [] { return std::make_unique<dynamics2d::GroupRegion>(); })
  {
  }
};

inline void DriveAtRandom(Dynamics2dTestWorld& world, std::uint32_t robot, std::uint64_t name, std::uint64_t tick,
                          bool uses_turret = true)
{
  RandomStream random(3, name, 0, static_cast<std::uint32_t>(tick / 9));
  world.Drive(robot, random.Uniform(-0.1, 0.3), random.Uniform(-0.1, 0.3));
  world.Command("footbot_gripper", robot, {random.Uniform(0, 1) < 0.6 ? 1.0 : 0.0});
  const double turret = random.Uniform(0, 1) < 0.5 ? 0.0 : random.Uniform(-2, 2);
  if (uses_turret) world.Command("footbot_turret", robot, {turret});
}

// Robots that drive, grip and turn turrets among preys, boxes, walls and mirrors. One mirror is a box that rolls, so
// that its outline changes and it leaves the plane.
class Swarm : public Dynamics2dTestWorld
{
public:
  Swarm(const std::string& threads, double pitch, RegionTeam* regions = nullptr)
      : Dynamics2dTestWorld("threads", threads)
  {
    team = regions;
    experiment.arena_size = {10, 10, 3};
    for (int i = 0; i < 81; ++i) robots_.push_back(AddFootbot(1 + pitch * (i % 9), 1 + pitch * (i / 9), 0.7 * i));
    for (int i = 0; i < 8; ++i) AddPrey(1 + pitch * (i + 0.5), 1 + pitch * 3.5, 0.5 + 0.3 * i, 0.06);
    for (int i = 0; i < 4; ++i)
      AddBlock({1 + pitch * (2 * i + 0.5), 1 + pitch * 5.5, 0.1}, {0.1 + 0.02 * i, 0.08, 0.2}, 0.5);
    mirror_ = AddFootbot(0.5, 0.5);
    MakeMirror(mirror_);
    box_ = AddBlock(BoxPose(0).position, {0.2, 0.15, 0.3}, 1);
    MakeMirror(box_);
    AddWall({1 + 8.5 * pitch, 3, 0.2}, {0.1, 6, 0.4}, 0.1);
    AddWall({0.8, 3, 0.2}, {0.1, 6, 0.4}, -0.05);
    UseTurrets();
    Start();
  }
  void Step()
  {
    const std::uint64_t tick = Space().GetTick();
    for (const std::uint32_t robot : robots_) DriveAtRandom(*this, robot, robot, tick);
    const double along = 0.01 * static_cast<double>(tick);
    Space().SetPose(mirror_, {Vector3(0.5 + along, 0.5 + along, 0), QuaternionFromYaw(along)});
    Space().SetPose(box_, BoxPose(along));
    Tick();
    if (tick % 40 == 39) engine->Canonicalise();
  }
  std::vector<char> Saved() const
  {
    ByteWriter state;
    engine->SaveState(state);
    return state.Bytes();
  }

  const std::vector<std::uint32_t>& Robots() const { return robots_; }

private:
  static Pose BoxPose(double along)
  {
    const Quaternion lean(Eigen::AngleAxisd(4 * along, Vector3::UnitX()));
    return {Vector3(3 - 2 * along, 1.3, 0.2 * Sin(20 * along)), lean};
  }

  std::vector<std::uint32_t> robots_;
  std::uint32_t mirror_ = 0, box_ = 0;
};

}  // namespace swarmanoid
