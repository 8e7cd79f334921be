// Scenes of dynamics3d that threads and regions must compute with the bits of one thread.
#pragma once

#include <octomap/octomap.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/math/random.h"
#include "dynamics3d_test_world.h"
#include "engine_worker/engines/dynamics3d/terrain_shape.h"
#include "tests/unit/engines/local_team.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{

inline void DriveAtRandom(Dynamics3dTestWorld& world, std::uint32_t robot, std::uint64_t name, std::uint64_t tick)
{
  RandomStream random(3, name, 0, static_cast<std::uint32_t>(tick / 9));
  world.Drive(robot, random.Uniform(-0.1, 0.3), random.Uniform(-0.1, 0.3));
  world.Command("footbot_gripper", robot, {random.Uniform() < 0.6 ? 1.0 : 0.0});
  world.Command("footbot_turret", robot, {random.Uniform(-2, 2)});
}

enum class Ground
{
  kPlane,
  kHills,
  kCells
};

// The regions of dynamics3d in the thread of the caller. A region has an engine of its own, made by `make`.
class TeamOfDynamics3d : public LocalTeam
{
public:
  using MakeEngine = std::function<std::unique_ptr<CDynamics3dEngine>()>;
  TeamOfDynamics3d(unsigned regions, const MakeEngine& make)
      : LocalTeam(regions, [make] { return std::make_unique<Region>(make()); })
  {
  }

private:
  class NoExchange : public RegionExchange
  {
  public:
    unsigned RegionCount() const override { return 1; }
    void Swap(std::span<const ByteWriter>, std::span<std::vector<char>>) override { FAIL(); }
  };
  class Region : public EngineRegion
  {
  public:
    explicit Region(std::unique_ptr<CDynamics3dEngine> engine)
        : engine_(std::move(engine)), region_(engine_->MakeRegion(0, exchange_))
    {
    }
    void Work(std::span<const char> task, ByteWriter& result) override { region_->Work(task, result); }

  private:
    NoExchange exchange_;
    std::unique_ptr<CDynamics3dEngine> engine_;
    std::unique_ptr<EngineRegion> region_;
  };
};

// Robots that drive, grip and turn among preys, stacks, walls, eyebots above them and a mirror. Handbots hang on ropes.
class RigidSwarm : public Dynamics3dTestWorld
{
public:
  RigidSwarm(const std::string& threads, double pitch, Ground ground, const std::string& iterations = "8",
             unsigned regions = 0)
      : Dynamics3dTestWorld("threads", threads, "iterations", iterations), ground_(ground)
  {
    if (regions > 0)
    {
      team_ = MakeTeam(regions);
      team = team_.get();
    }
    experiment.arena_size = {6, 6, 3};
    Set("arena_walls", "true", "ceiling", "true");
    if (ground != Ground::kPlane) Set("ground", "false");
    for (int i = 0; i < 36; ++i) robots_.push_back(AddFootbot({1 + pitch * (i % 6), 1 + pitch * (i / 6), 0}, 0.7 * i));
    for (int i = 0; i < 5; ++i) AddPrey({1 + pitch * (i + 0.5), 1 + pitch * 3.5, 0}, 0.5 + 0.3 * i, 0.05);
    for (int i = 0; i < 8; ++i) AddBlock({0.6 + 3 * (i % 2), 0.5, 0.05 + 0.1 * (i / 2)}, {0.1, 0.1, 0.1}, 0.2);
    for (int i = 0; i < 3; ++i) AddEyebot({1 + pitch * i, 1.5, 0.5}, i);
    for (int i = 0; i < 3; ++i) handbots_.push_back(AddHandbot({4.6 + 0.35 * i, 5, 0}, 1.6 * i));
    AddBlock({4.95, 5.25, 0.1}, {0.06, 0.1, 0.2}, 0.2);
    AddWall({1 + 5.5 * pitch, 2, 0.2}, {0.05, 2, 0.4}, 0.1);
    mirror_ = AddFootbot({0.5, 0.9, 0});
    MakeMirror(mirror_);
    if (ground == Ground::kCells)
    {
      octomap::OcTree tree(0.1);
      for (int x = 0; x < 60; ++x)
        for (int y = 0; y < 60; ++y)
          tree.updateNode(
              octomap::point3d(0.05F + 0.1F * static_cast<float>(x), 0.05F + 0.1F * static_cast<float>(y), -0.05F),
              true, true);
      tree.updateInnerOccupancy();
      tree.writeBinary((folder_ / "map.bt").string());
      AddTerrain("octomap", {{"file", (folder_ / "map.bt").string()}}, {0, 0, 0});
    }
    UseTurrets();
    Start();
    AddHills(*engine);
  }
  ~RigidSwarm()
  {
    engine.reset();
    team_.reset();
  }
  std::unique_ptr<TeamOfDynamics3d> MakeTeam(unsigned regions)
  {
    return std::make_unique<TeamOfDynamics3d>(regions,
                                              [this]
                                              {
                                                auto made = MakeEngine(nullptr);
                                                AddHills(*made);
                                                return made;
                                              });
  }
  // The team from the start.
  TeamOfDynamics3d& Team() { return *team_; }
  RigidSwarm(const RigidSwarm&) = delete;
  RigidSwarm& operator=(const RigidSwarm&) = delete;

  void Step()
  {
    const std::uint64_t tick = Space().GetTick();
    for (const std::uint32_t robot : robots_) DriveAtRandom(*this, robot, robot, tick);
    for (const std::uint32_t handbot : handbots_)
    {
      RandomStream random(4, handbot, 0, static_cast<std::uint32_t>(tick / 12));
      const auto any = [&] { return random.Uniform(-0.5, 0.5); };
      Command("handbot_rope", handbot, {random.Uniform() < 0.8 ? 1.0 : 0.0, random.Uniform(-0.15, 0.05)});
      Command("handbot_hands", handbot, {random.Uniform() < 0.6 ? 1.0 : 0.0, random.Uniform() < 0.6 ? 1.0 : 0.0});
      Command("handbot_arms", handbot, {any(), any(), any(), any(), any()});
    }
    const double along = 0.01 * static_cast<double>(tick);
    Space().SetPose(mirror_, {Vector3(0.5 + along, 0.9 + along, 0), QuaternionFromYaw(along)});
    Tick();
  }
  // Makes the engine again from its saved state, with other regions.
  void Restore(RegionTeam* regions)
  {
    team = regions;
    ReplaceEngineBySavedState();
  }
  const std::vector<std::uint32_t>& Robots() const { return robots_; }
  std::vector<char> Saved() const
  {
    ByteWriter state;
    engine->SaveState(state);
    return state.Bytes();
  }

private:
  void AddHills(CDynamics3dEngine& to)
  {
    if (ground_ != Ground::kHills) return;
    std::vector<double> heights;
    for (int k = 0; k < 61 * 61; ++k) heights.push_back(0.01 * Sin(k % 61) * Sin(k / 61 * 0.7) - 0.01);
    const auto hills = std::make_shared<const HeightTerrain>(heights, 61, 61, 6.0, 6.0);
    hills_.push_back(AddHeightfield(to.WorldForTest(), 0xfffffff0U, hills, Pose()));
  }

  Ground ground_;
  test::TemporaryFolder folder_;
  std::vector<std::unique_ptr<dynamics3d::TerrainShape>> hills_;
  std::unique_ptr<TeamOfDynamics3d> team_;
  std::vector<std::uint32_t> robots_, handbots_;
  std::uint32_t mirror_ = 0;
};

}  // namespace swarmanoid
