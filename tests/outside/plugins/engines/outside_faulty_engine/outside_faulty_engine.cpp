// An engine in which nothing moves, and which fails by OUTSIDE_FAULT.
#include "controllers/outside_faults/faults.h"

#include "engine_worker/physics_engine.h"

using namespace swarmanoid;

class COutsideFaultyEngine : public CPhysicsEngine
{
public:
  void Init(const EngineSetup& setup) override { space_ = &setup.space; }
  void AddEntity(const CSwarmanoidSpaceEntity& entity, EBinding binding) override
  {
    if (binding == EBinding::kOwned) owned_.push_back(entity.GetIndex());
  }
  void Update(const EngineCommands&, EngineUpdate& update, std::span<double>) override
  {
    faults::FailIfAsked("engine", space_->GetTick());
    const std::size_t count = owned_.size();
    for (std::size_t k = 0; k < count; ++k)
    {
      const Pose pose = space_->GetPose(owned_[k]);
      const double values[] = {pose.position.x(),    pose.position.y(),    pose.position.z(),   pose.orientation.x(),
                               pose.orientation.y(), pose.orientation.z(), pose.orientation.w()};
      for (std::size_t part = 0; part < 7; ++part) update.poses[part * count + k] = values[part];
    }
  }
  void EntityMoved(std::uint32_t) override {}
  void SaveState(ByteWriter&) const override {}
  void LoadState(ByteReader&) override {}
  void Canonicalise() override {}

private:
  const CSwarmanoidSpace* space_ = nullptr;
  std::vector<std::uint32_t> owned_;
};

REGISTER_PHYSICS_ENGINE(COutsideFaultyEngine, {.label = "outside_faulty_engine",
                                               .brief = "an engine that fails when it is told to",
                                               .entity_tags = {"footbot"}})
