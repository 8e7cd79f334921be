// The engine worker checks the results of its engine, and a mistake names the engine.
#include "engine_worker/engine_worker.h"
#include "common/space/attributes.h"
#include "controller_host/device.h"
#include "tests/world/message_of.h"
#include "tests/world/small_experiment.h"

#include <gmock/gmock.h>

#include <functional>

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

const double kNan = __builtin_nan("");

// No body moves; then `fault` changes the results.
class StillEngine : public CPhysicsEngine
{
public:
  static inline std::function<void(EngineUpdate& update, std::span<double> sensors)> fault;
  static inline std::vector<std::uint32_t> moved;
  static inline std::vector<double> commanded;

  void Init(const EngineSetup& setup) override
  {
    space_ = &setup.space;
    layout_ = &setup.layout;
  }
  void AddEntity(const CSwarmanoidSpaceEntity&, EBinding) override {}
  void Update(const EngineCommands& commands, EngineUpdate& update, std::span<double> sensors) override
  {
    commanded.assign(commands.values.begin(), commands.values.end());
    const std::size_t count = layout_->owned.size();
    for (std::size_t k = 0; k < count; ++k)
    {
      const Pose pose = space_->GetPose(layout_->owned[k]);
      const Quaternion& q = pose.orientation;
      const double values[] = {pose.position.x(), pose.position.y(), pose.position.z(), q.x(), q.y(), q.z(), q.w()};
      for (std::size_t part = 0; part < 7; ++part) update.poses[part * count + k] = values[part];
    }
    if (fault) fault(update, sensors);
  }
  void EntityMoved(std::uint32_t entity) override { moved.push_back(entity); }
  void SaveState(ByteWriter&) const override {}
  void LoadState(ByteReader&) override {}
  void Canonicalise() override {}

private:
  const CSwarmanoidSpace* space_ = nullptr;
  const EngineLayout* layout_ = nullptr;
};

REGISTER_PHYSICS_ENGINE(StillEngine, {.label = "worker_test_engine"})

class Worker : public testing::Test
{
protected:
  static Experiment ThreeFootbots(BeyondLimit policy)
  {
    Experiment experiment;
    experiment.arena_size = {10, 10, 2};
    experiment.limit_m = 100;
    experiment.beyond_limit = policy;
    for (int i = 0; i < 3; ++i)
    {
      EntityConfiguration entity = test::Entity(EntityKind::kFootbot, "fb_" + std::to_string(i), {1.0 + i, 2, 0});
      entity.waits = i == 1;
      test::Add(experiment, entity);
    }
    experiment.engines[0].tag = "worker_test_engine";
    experiment.engines[0].id = "ground";
    return experiment;
  }

  // Returns the text of the error, or "" for none.
  static std::string Step(std::function<void(EngineUpdate& update, std::span<double> sensors)> fault,
                          BeyondLimit policy = BeyondLimit::kStop)
  {
    const Experiment experiment = ThreeFootbots(policy);
    const Assignment assignment = MakeAssignment(experiment, 1);
    CSwarmanoidSpace space(experiment);
    space.SetTick(4);
    EngineWorker worker(space, assignment, 0);
    StillEngine::fault = std::move(fault);
    const std::string error = test::MessageOf<ActivityError>([&] { worker.Tick({}, {}); });
    if (!error.empty()) return error;
    EXPECT_EQ(worker.Update().tick, 5U);
    EXPECT_EQ(worker.Update().engine, 0U);
    return "";
  }
  static std::string StepPoses(const std::function<void(std::vector<double>& poses)>& fault,
                               BeyondLimit policy = BeyondLimit::kStop)
  {
    return Step([&](EngineUpdate& update, std::span<double>) { fault(update.poses); }, policy);
  }
};

TEST_F(Worker, ASoundUpdatePasses) { EXPECT_EQ(Step({}), ""); }

TEST_F(Worker, PosesThatCannotBeAreTheEnginesMistake)
{
  EXPECT_THAT(
      StepPoses([](auto& poses) { poses[0] = kNan; }),
      HasSubstr(
          "engine 'ground' (worker_test_engine): Update at tick 4 failed: the footbot 'fb_0' has a pose with x = nan"));
  EXPECT_THAT(StepPoses([](auto& poses) { poses[5] = -__builtin_inf(); }),
              HasSubstr("'fb_2' has a pose with y = -inf"));
  EXPECT_THAT(StepPoses([](auto& poses) { poses[18] = kNan; }), HasSubstr("'fb_0' has a pose with qw = nan"));
  EXPECT_THAT(StepPoses([](auto& poses) { poses[20] = 0.9; }), HasSubstr("'fb_2' has an orientation of norm 0.9"));
  EXPECT_THAT(StepPoses([](auto& poses) { poses.resize(3); }),
              HasSubstr("engine 'ground' (worker_test_engine): Update at tick 4 failed: there are 3 numbers for the "
                        "poses of 3 entities"));
  EXPECT_THAT(StepPoses([](auto& poses) { poses.resize(22); }), HasSubstr("there are 22 numbers"));
}

TEST_F(Worker, AnEntityThatIsNotInTheArenaStaysWhereItWaits)
{
  EXPECT_EQ(StepPoses(
                [](auto& poses)
                {
                  poses[1] = kNan;
                  poses[7] = 1e300;
                }),
            "");
}

TEST_F(Worker, WhoIsNotInTheArenaDoesNothing)
{
  RegisterBuiltinDevices();
  Experiment experiment = ThreeFootbots(BeyondLimit::kHold);
  ControllerConfiguration& controller = experiment.controllers.emplace_back();
  controller.id = "driver";
  DeviceConfiguration& wheels = controller.actuators.emplace_back();
  wheels.type = "footbot_wheels";
  wheels.implementation = "dummy_footbot_wheels";
  for (EntityConfiguration& entity : experiment.entities) entity.controller = "driver";
  const Assignment assignment = MakeAssignment(experiment, 1);
  CSwarmanoidSpace space(experiment);
  EngineWorker worker(space, assignment, 0);
  StillEngine::fault = {};
  const ControlCommands commands{0, 0, {1, 2, 3, 4, 5, 6}, {}};
  const ControlCommands* const here[] = {&commands};
  worker.Tick({}, here);
  EXPECT_THAT(StillEngine::commanded, ElementsAre(1, 2, 0, 0, 5, 6));
  space.SetAttribute(space.PresenceSlot(1), 1);
  space.SetAttribute(space.PresenceSlot(2), 0);
  worker.Tick({}, here);
  EXPECT_THAT(StillEngine::commanded, ElementsAre(1, 2, 3, 4, 0, 0));
}

TEST_F(Worker, BeyondTheLimitThePolicyDecides)
{
  const auto far = [](auto& poses) { poses[2] = 1e300; };
  EXPECT_THAT(StepPoses(far), HasSubstr("engine 'ground' (worker_test_engine): Update at tick 4 failed: the footbot "
                                        "'fb_2' left the world: it is at 1e+300"));
  EXPECT_EQ(StepPoses(far, BeyondLimit::kHold), "");
  EXPECT_EQ(StepPoses(far, BeyondLimit::kRemove), "");
}

TEST_F(Worker, AttributesThatCannotBeAreTheEnginesMistake)
{
  const auto add = [](std::uint32_t slot, double value)
  { return Step([=](EngineUpdate& update, std::span<double>) { update.attributes.Add(slot, value); }); };
  const std::uint32_t gripped = 14;
  EXPECT_EQ(add(gripped, 3), "");
  EXPECT_THAT(add(gripped, 4), HasSubstr("engine 'ground' (worker_test_engine): Update at tick 4 failed: the attribute "
                                         "'gripped' of the footbot 'fb_0' is 4"));
  EXPECT_THAT(add(0x7ffffff0, 1), HasSubstr("there is no attribute slot 2147483632"));
  EXPECT_THAT(add(3 * static_cast<std::uint32_t>(AttributeCount(EntityKind::kFootbot)), 0),
              HasSubstr("the presence of the footbot 'fb_0' is 0"));
  EXPECT_THAT(Step([](EngineUpdate& update, std::span<double>) { update.attributes.values.resize(2); }),
              HasSubstr("there are 2 values for 0 slots"));
}

TEST_F(Worker, ExceptionsAreToldWithTheEngineAndTheTick)
{
  EXPECT_EQ(Step([](EngineUpdate&, std::span<double>) { throw std::runtime_error("it has had enough"); }),
            "engine 'ground' (worker_test_engine): Update at tick 4 failed: it has had enough");
}

TEST_F(Worker, AnUpdateIsOfItsEngineAndItsTickWhateverTheEngineWrites)
{
  EXPECT_EQ(Step([](EngineUpdate& update, std::span<double>) { update.tick = update.engine = 77; }), "");
}

TEST_F(Worker, OwnedEntitiesThatWereMovedAreToldToTheEngine)
{
  const Experiment experiment = ThreeFootbots(BeyondLimit::kHold);
  const Assignment assignment = MakeAssignment(experiment, 1);
  const CSwarmanoidSpace space(experiment);
  EngineWorker worker(space, assignment, 0);
  StillEngine::fault = {};
  StillEngine::moved.clear();
  const std::array<std::uint32_t, 2> moved{0, 2};
  worker.Tick(moved, {});
  EXPECT_THAT(StillEngine::moved, ElementsAre(0, 2));
}

}  // namespace
}  // namespace swarmanoid
