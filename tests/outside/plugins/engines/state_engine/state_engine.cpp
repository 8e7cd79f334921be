// An engine in which nothing moves. In the step to tick 5 it returns a value that cannot be part of the state; the mode
// says which.
#include <limits>

#include "engine_worker/physics_engine.h"

using namespace swarmanoid;

class CStateEngine : public CPhysicsEngine
{
public:
  void Init(const EngineSetup& setup) override
  {
    space_ = &setup.space;
    layout_ = &setup.layout;
    mode_ = setup.parameters.Text("mode");
  }
  void AddEntity(const CSwarmanoidSpaceEntity&, EBinding) override {}

  void Update(const EngineCommands&, EngineUpdate& update, std::span<double> sensors) override
  {
    const std::size_t count = layout_->owned.size();
    for (std::size_t k = 0; k < count; ++k)
    {
      const Pose pose = space_->GetPose(layout_->owned[k]);
      const Quaternion& q = pose.orientation;
      const double values[] = {pose.position.x(), pose.position.y(), pose.position.z(), q.x(), q.y(), q.z(), q.w()};
      for (std::size_t part = 0; part < 7; ++part) update.poses[part * count + k] = values[part];
    }
    if (space_->GetTick() >= 4) Fail(update, sensors);
  }

  void EntityMoved(std::uint32_t) override {}
  void SaveState(ByteWriter&) const override {}
  void LoadState(ByteReader&) override {}
  void Canonicalise() override {}

private:
  void Fail(EngineUpdate& update, std::span<double> sensors)
  {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    const std::size_t count = layout_->owned.size();
    const std::uint32_t slot = space_->GetEntity(layout_->owned[0]).SlotOf("gripped");
    if (mode_ == "nan") update.poses[0] = kNan;
    if (mode_ == "infinite") update.poses[count] = std::numeric_limits<double>::infinity();
    if (mode_ == "huge") update.poses[0] = 1e300;
    if (mode_ == "fall") update.poses[2 * count] -= 300;
    if (mode_ == "nan_quaternion") update.poses[6 * count] = kNan;
    if (mode_ == "half_quaternion") update.poses[6 * count] = 0.5;
    if (mode_ == "few_poses") update.poses.resize(3);
    if (mode_ == "more_poses") update.poses.resize(7000);
    if (mode_ == "far_slot") update.attributes.Add(1000000, 1);
    if (mode_ == "presence") update.attributes.Add(space_->PresenceSlot(layout_->owned[0]), 0);
    if (mode_ == "bad_grip") update.attributes.Add(slot, 1e6);
    if (mode_ == "nan_reading") sensors[0] = kNan;
    if (mode_ == "other_tick") update.tick = update.engine = 77;
    if (mode_ == "throw") throw std::runtime_error("it has had enough");
  }

  const CSwarmanoidSpace* space_ = nullptr;
  const EngineLayout* layout_ = nullptr;
  std::string mode_;
};

REGISTER_PHYSICS_ENGINE(
    CStateEngine, {.label = "state_engine",
                   .brief = "gives what cannot be part of the state",
                   .parameters = {{.name = "mode", .type = ParameterType::kText, .description = "What is given."}},
                   .channels = {"footbot_wheels", "footbot_encoders"},
                   .entity_tags = {"footbot"}})
