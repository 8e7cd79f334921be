// Runs experiments of configs/ with all roles in this process, and looks at what becomes of the entities.
#include <gtest/gtest.h>

#include "common/experiment/load_experiment.h"
#include "common/math/elementary.h"
#include "common/space/terrain/terrain.h"
#include "controller_host/controller_host.h"
#include "controller_host/device.h"
#include "engine_worker/engine_worker.h"
#include "space_server/space_server.h"
#include "test_folders.h"

namespace swarmanoid
{
namespace
{

class RunningExperiment
{
public:
  explicit RunningExperiment(const std::string& name)
  {
    RegisterBuiltinEngines();
    RegisterBuiltinDevices();
    LoadedExperiment loaded = LoadExperimentFile(std::string(SWARMANOID_SOURCE_FOLDER) + "/configs/" + name);
    for (const Diagnostic& error : loaded.errors) ADD_FAILURE() << error.Text();
    experiment_ = std::move(loaded.experiment);
    if (experiment_ == nullptr) throw std::runtime_error("the experiment has mistakes");
    assignment_ = MakeAssignment(*experiment_, 1);
    server_ = std::make_unique<SpaceServer>(*experiment_, assignment_, testing::TempDir());
    engine_ = std::make_unique<EngineWorker>(server_->Space(), assignment_, 0);
    host_ = std::make_unique<ControllerHost>(server_->Space(), assignment_, 0);
  }

  void Run(int ticks)
  {
    for (int k = 0; k < ticks; ++k)
    {
      const SensorFrame* frame = &engine_->Sensors();
      const bool has_frame = Space().GetTick() > 0 && !assignment_.hosts[0].frames_from.empty();
      const ControlCommands* commands = &host_->Step({&frame, has_frame ? 1U : 0U});
      engine_->Step(server_->Moved(), {&commands, assignment_.engines[0].commands_from.empty() ? 0U : 1U});
      const EngineUpdate* update = &engine_->Update();
      server_->Advance({&update, 1}, {&commands, 1});
    }
  }
  CSwarmanoidSpace& Space() { return server_->Space(); }
  CSwarmanoidSpaceEntity& Entity(const std::string& id) { return *Space().FindEntity(id); }
  const Experiment& File() const { return *experiment_; }

private:
  std::unique_ptr<Experiment> experiment_;
  Assignment assignment_;
  std::unique_ptr<SpaceServer> server_;
  std::unique_ptr<EngineWorker> engine_;
  std::unique_ptr<ControllerHost> host_;
};

TEST(HandbotShelf, TheHandbotBringsTheBookToTheFloor)
{
  RunningExperiment run("handbot_shelf.xml");
  const auto book = run.Entity("book").GetIndex();
  bool lifted = false;
  for (int tick = 0; tick < 350; ++tick)
  {
    run.Run(1);
    lifted = lifted ||
             (run.Entity("book").GetPosition().z() > 1.13 && run.Entity("hb").GetAttribute("gripped", 0) == 1 + book);
  }
  EXPECT_TRUE(lifted) << "it was to be held in the hand above the shelf";
  EXPECT_LT(run.Entity("book").GetPosition().z(), 0.15);
  EXPECT_LT(std::abs(run.Entity("hb").GetPosition().z()), 0.02);
  EXPECT_EQ(run.Entity("hb").GetAttribute("gripped", 0), 0) << "it was to be put down";
}

TEST(RoughTerrain, TheFootbotsDriveOverTheHillsWithoutFallingOver)
{
  RunningExperiment run("rough_terrain.xml");
  const auto terrain = LoadTerrain(run.Entity("hills").GetConfiguration(), run.File().folder);
  std::vector<Vector3> starts;
  for (int k = 0; k < 9; ++k) starts.push_back(run.Entity("fb_" + std::to_string(k)).GetPosition());
  run.Run(300);
  double travelled = 0;
  for (std::size_t k = 0; k < 9; ++k)
  {
    const Pose pose = run.Entity("fb_" + std::to_string(k)).GetPose();
    travelled += (pose.position - starts[k]).head<2>().norm();
    const auto ground = terrain->GroundBelow({pose.position.x(), pose.position.y(), 1});
    ASSERT_TRUE(ground.has_value());
    EXPECT_NEAR(pose.position.z(), *ground, 0.015);
    EXPECT_GT((pose.orientation * Vector3::UnitZ()).z(), Cos(DegreesToRadians(30)));
  }
  EXPECT_GT(travelled / 9, 0.3);
}

}  // namespace
}  // namespace swarmanoid
