// These tests hold what an engine is told about entities that change their engine, and which of its results count.
#include "engine_worker/volume_members.h"

#include <gmock/gmock.h>

#include "common/math/elementary.h"
#include "common/messages/assignment.h"
#include "common/space/space.h"
#include "engine_worker/engine_worker.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::IsEmpty;

TEST(VelocityAfter, OnAStraightWayItIsTheWayByTheTime)
{
  const Pose from{{1, 2, 3}, QuaternionFromYaw(0.4)};
  const EntityVelocity velocity = VelocityAfter(from, {{1.2, 2, 2.9}, QuaternionFromYaw(0.4)}, 0.1);
  EXPECT_LT((velocity.linear - Vector3(2, 0, -1)).norm(), 1e-12);
  EXPECT_LT(velocity.angular.norm(), 1e-12);
}

TEST(VelocityAfter, OnAnArcItIsThatOfItsEnd)
{
  // A circle of 2 m about the origin at 0.5 rad/s, upwards at 0.3 m/s.
  const double rate = 0.5, seconds = 0.4, radius = 2;
  for (const double sense : {1.0, -1.0})
  {
    const double angle = sense * rate * seconds;
    const Pose from{{radius, 0, 0}, QuaternionFromYaw(0.1)};
    const Pose to{{radius * Cos(angle), radius * Sin(angle), 0.3 * seconds}, QuaternionFromYaw(0.1 + angle)};
    const EntityVelocity velocity = VelocityAfter(from, to, seconds);
    const double speed = sense * radius * rate;
    EXPECT_LT((velocity.linear - Vector3(-speed * Sin(angle), speed * Cos(angle), 0.3)).norm(), 1e-9);
    EXPECT_LT((velocity.angular - Vector3(0, 0, sense * rate)).norm(), 1e-9);
  }
}

// Moves each entity by 0.1 m along x in a tick, also those of other engines, and says that all grippers open.
class WalkingEngine : public CPhysicsEngine
{
public:
  static inline std::vector<std::string> calls;

  void Init(const EngineSetup& setup) override
  {
    space_ = &setup.space;
    layout_ = &setup.layout;
  }
  void AddEntity(const CSwarmanoidSpaceEntity& entity, EBinding binding) override
  {
    calls.push_back((binding == EBinding::kMirror ? "mirror " : "owned ") + entity.GetId());
  }
  void Update(const EngineCommands&, EngineUpdate& update, std::span<double>) override
  {
    const std::size_t count = layout_->owned.size();
    for (std::size_t k = 0; k < count; ++k)
    {
      const Pose pose = space_->GetPose(layout_->owned[k]);
      const Quaternion& q = pose.orientation;
      const double values[] = {
          pose.position.x() + 0.1, pose.position.y(), pose.position.z(), q.x(), q.y(), q.z(), q.w()};
      for (std::size_t part = 0; part < 7; ++part) update.poses[part * count + k] = values[part];
      update.attributes.Add(space_->GetEntity(layout_->owned[k]).SlotOf("gripper_aperture"), 0.5);
    }
  }
  void EntityMoved(std::uint32_t) override { calls.emplace_back("moved"); }
  void TakeOver(std::uint32_t entity, const EntityVelocity& velocity) override
  {
    calls.push_back("take " + std::to_string(entity) + " at " + std::to_string(velocity.linear.x()));
  }
  void HandOver(std::uint32_t entity) override { calls.push_back("hand " + std::to_string(entity)); }
  void SaveState(ByteWriter&) const override {}
  void LoadState(ByteReader&) override { calls.emplace_back("load"); }
  void Canonicalise() override {}

private:
  const CSwarmanoidSpace* space_ = nullptr;
  const EngineLayout* layout_ = nullptr;
};

REGISTER_PHYSICS_ENGINE(WalkingEngine, {.label = "walking_engine", .hands_over = true})

// Engine 0 has x below 2 m and engine 1 the rest. Footbot 0 starts at 1 m, footbot 1 at 3 m.
class Members : public testing::Test
{
protected:
  Members()
  {
    WalkingEngine::calls.clear();
    experiment_.arena_size = {4, 4, 1};
    experiment_.engines.resize(2);
    for (std::size_t e = 0; e < 2; ++e)
    {
      experiment_.engines[e].tag = "walking_engine";
      experiment_.engines[e].id = e == 0 ? "west" : "east";
      EXPECT_EQ(experiment_.engines[e].volume.ReadOutlines(e == 0 ? "-9, -9, 2, 9" : "2, -9, 9, 9"), "");
    }
    for (const double x : {1.0, 3.0})
    {
      const std::uint32_t number =
          test::Add(experiment_, test::Entity(EntityKind::kFootbot, "fb_" + std::to_string(x), {x, 1, 0}));
      experiment_.engines[1].entities.push_back(number);
    }
    experiment_.engine_choices = FindEngineChoices(experiment_);
    assignment_ = MakeAssignment(experiment_, 1);
    space_ = std::make_unique<CSwarmanoidSpace>(experiment_);
  }

  void GiveTo(std::uint32_t entity, int engine)
  {
    space_->SetAttribute(space_->EngineSlot(entity) + EngineSlots::kEngine, engine);
  }

  Experiment experiment_;
  Assignment assignment_;
  std::unique_ptr<CSwarmanoidSpace> space_;
};

TEST_F(Members, TheEngineGetsThemTwiceAndHandsOverThoseOfOthers)
{
  EngineWorker worker(*space_, assignment_, 0);
  EXPECT_THAT(WalkingEngine::calls, ElementsAre("mirror fb_1.000000", "owned fb_1.000000", "mirror fb_3.000000",
                                                "owned fb_3.000000", "hand 1"));
  EXPECT_THAT(std::vector<std::uint32_t>(worker.Elsewhere().begin(), worker.Elsewhere().end()), ElementsAre(1));
}

TEST_F(Members, ResultsAboutEntitiesOfOtherEnginesAreLeftOut)
{
  EngineWorker worker(*space_, assignment_, 0);
  worker.Tick({}, {});
  EXPECT_DOUBLE_EQ(worker.Update().poses[0], 1.1);
  EXPECT_EQ(worker.Update().poses[1], 3);
  EXPECT_THAT(worker.Update().attributes.slots, ElementsAre(space_->GetEntity(0).SlotOf("gripper_aperture")));
}

TEST_F(Members, ThoseThatLeaveTheVolumeTellTheirVelocity)
{
  EngineWorker worker(*space_, assignment_, 0);
  space_->SetPose(0, {{1.95, 1, 0}, Quaternion::Identity()});
  worker.Tick({}, {});
  const std::uint32_t slot = space_->EngineSlot(0) + EngineSlots::kVelocity;
  const AttributeChanges& changes = worker.Update().attributes;
  ASSERT_EQ(changes.slots.size(), 7U);
  EXPECT_EQ(changes.slots[1], slot);
  EXPECT_NEAR(changes.values[1], 0.1 / space_->GetTickSeconds(), 1e-9);
}

TEST_F(Members, ChangesComeBeforeTheNextUpdateOnce)
{
  EngineWorker worker(*space_, assignment_, 0);
  WalkingEngine::calls.clear();
  GiveTo(0, 1);
  GiveTo(1, 0);
  space_->SetAttribute(space_->EngineSlot(1) + EngineSlots::kVelocity, 0.25);
  const std::vector<std::uint32_t> moved{0, 1};
  worker.Tick(moved, {});
  EXPECT_THAT(WalkingEngine::calls, ElementsAre("hand 0", "take 1 at 0.250000", "moved"));
  WalkingEngine::calls.clear();
  worker.Tick({}, {});
  EXPECT_THAT(WalkingEngine::calls, IsEmpty());
}

TEST_F(Members, ASavedStateBringsAnEngineToItsDivisionFirst)
{
  EngineWorker worker(*space_, assignment_, 0);
  GiveTo(0, 1);
  worker.Tick({}, {});
  ByteWriter state;
  worker.SaveState(state);
  EngineWorker other(*space_, assignment_, 0);
  WalkingEngine::calls.clear();
  ByteReader reader(state.Bytes());
  other.LoadState(reader);
  EXPECT_THAT(WalkingEngine::calls, ElementsAre("hand 0", "load"));
  other.Tick({}, {});
  EXPECT_THAT(WalkingEngine::calls, ElementsAre("hand 0", "load"));
}

}  // namespace
}  // namespace swarmanoid
