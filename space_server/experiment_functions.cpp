#include "space_server/experiment_functions.h"

#include <stdexcept>

#include "common/space/attributes.h"
#include "space_server/space_changes.h"
#include "space_server/space_server.h"

namespace swarmanoid
{
namespace
{

CSwarmanoidSpaceEntity& FindOrThrow(CSwarmanoidSpace& space, std::string_view id)
{
  if (CSwarmanoidSpaceEntity* entity = space.FindEntity(id)) return *entity;
  throw std::invalid_argument("there is no entity '" + std::string(id) + "'");
}

}  // namespace

template <>
PluginRegistry<CExperimentFunctions>& PluginRegistry<CExperimentFunctions>::Instance()
{
  static PluginRegistry registry(PluginKind::kExperimentFunctions);
  return registry;
}

template class PluginRegistry<CExperimentFunctions>;

const CSwarmanoidSpace& SpaceEditor::GetSpace() const { return server_.Space(); }

SpaceQuery& SpaceEditor::GetQuery()
{
  if (query_ == nullptr) query_ = std::make_unique<SpaceQuery>(server_.Space());
  return *query_;
}

const StructuralTree& SpaceEditor::GetStructure()
{
  if (structure_ == nullptr) structure_ = std::make_unique<StructuralTree>(server_.Space());
  structure_->Rebuild();
  return *structure_;
}

void SpaceEditor::MoveCompound(std::string_view id, const Pose& pose)
{
  CSwarmanoidSpace& space = server_.Space();
  const std::uint32_t entity = FindToMove(space, id).GetIndex();
  GetStructure();
  const CCompoundEntity compound = structure_->GetCompound(entity);
  const Pose root_in_entity = space.GetPose(entity).Inverse().Compose(space.GetPose(compound.GetRoot()));
  const std::vector<Pose> poses = compound.PosesAt(pose.Compose(root_in_entity));
  for (std::size_t k = 0; k < poses.size(); ++k) server_.Move({compound.GetMembers()[k], poses[k]});
}

void SpaceEditor::MoveEntity(std::string_view id, const Pose& pose)
{
  server_.Move({FindToMove(server_.Space(), id).GetIndex(), pose});
}

bool SpaceEditor::IsFree(std::string_view id, const Pose& pose) const
{
  const CSwarmanoidSpace& space = server_.Space();
  return FindInTheWay(space, FindToAdd(space, id), pose) == nullptr;
}

std::string SpaceEditor::AddEntity(std::string_view id, const Pose& pose)
{
  const CSwarmanoidSpace& space = server_.Space();
  if (!pose.position.allFinite() || pose.position.x() < kWaitingBelow)
    throw std::invalid_argument("'" + std::string(id) + "' cannot be added there: it is outside all arenas");
  const CSwarmanoidSpaceEntity& added = FindToAdd(space, id);
  RequireFree(space, added, pose);
  server_.Move({added.GetIndex(), pose});
  return added.GetId();
}

void SpaceEditor::RemoveEntity(std::string_view id)
{
  const CSwarmanoidSpaceEntity& entity = FindToRemove(server_.Space(), id);
  server_.Move({entity.GetIndex(), WaitingPose(entity)});
}

void SpaceEditor::SetAttribute(std::string_view id, std::string_view attribute, double value, int element)
{
  const CSwarmanoidSpaceEntity& entity = FindOrThrow(server_.Space(), id);
  if (AttributeOffset(entity.GetKind(), attribute) < 0)
    throw std::invalid_argument("entity '" + std::string(id) + "' has no attribute '" + std::string(attribute) + "'");
  server_.SetAttribute(entity.SlotOf(attribute, element), value);
}

}  // namespace swarmanoid
