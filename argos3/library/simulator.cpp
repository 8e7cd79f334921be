// The space and the changes that loop functions make to it.
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/plugins/simulator/entities/light_entity.h>

#include "argos3/library/running.h"
#include "space_server/space_changes.h"

namespace argos
{
namespace
{

using swarmanoid::Pose;
using swarmanoid::argos3::OurOrientation;
using swarmanoid::argos3::Running;
using swarmanoid::argos3::TheRunning;

swarmanoid::SpaceEditor& Editor()
{
  if (TheRunning().editor == nullptr)
    THROW_ARGOSEXCEPTION("entities are changed by loop functions alone, and not in their constructor");
  return *TheRunning().editor;
}

// Of boxes we tell the middle, ARGoS3 the middle of the base.
Pose PoseOf(const swarmanoid::CSwarmanoidSpaceEntity& entity, const CVector3& position, const CQuaternion& orientation)
{
  Pose pose{TheRunning().translation.OurPosition(position), OurOrientation(orientation)};
  if (swarmanoid::TagName(entity.GetKind()) == "block")
    pose.position += pose.orientation * swarmanoid::Vector3(0, 0, entity.GetSize().z() / 2);
  return pose;
}

const swarmanoid::CSwarmanoidSpaceEntity& Declared(const std::string& id)
{
  const auto* entity = Editor().GetSpace().FindEntity(TheRunning().translation.OurId(id));
  if (entity == nullptr)
    THROW_ARGOSEXCEPTION("the experiment file declares no entity '"
                         << id << "'; entities that loop functions add must stand in the file, from where they may be "
                         << "removed in Init");
  return *entity;
}

}  // namespace

CSimulator& CSimulator::GetInstance()
{
  static CSimulator simulator;
  return simulator;
}

CLoopFunctions& CSimulator::GetLoopFunctions()
{
  if (TheRunning().functions == nullptr)
    THROW_ARGOSEXCEPTION("no loop functions run in this process; run the experiment with --single-process");
  return *TheRunning().functions;
}

CCI_Controller& CControllableEntity::GetController()
{
  const std::string& id = GetRootEntity().GetId();
  const auto found = TheRunning().controllers.find(id);
  if (found == TheRunning().controllers.end())
    THROW_ARGOSEXCEPTION("the controller of '" << id << "' is not in this process: loop functions reach controllers in "
                                               << "a run with --single-process");
  return *found->second;
}

CColor CFloorEntity::GetColorAtPoint(Real x, Real y)
{
  return CSimulator::GetInstance().GetLoopFunctions().GetFloorColor(CVector2(x, y));
}

void CLightEntity::SetIntensity(Real intensity)
{
  Editor().SetAttribute(Declared(GetId()).GetId(), "intensity", intensity);
  intensity_ = intensity;
}

CEntity& CSpace::GetEntity(const std::string& id)
{
  const auto found = by_id_.find(id);
  if (found == by_id_.end()) THROW_ARGOSEXCEPTION("there is no entity '" << id << "' in the arena");
  return *found->second;
}

CSpace::TMapPerType& CSpace::GetEntitiesByType(const std::string& type)
{
  const auto found = by_type_.find(type);
  if (found == by_type_.end()) THROW_ARGOSEXCEPTION("there is no entity of type '" << type << "' in the arena");
  return found->second;
}

CFloorEntity& CSpace::GetFloorEntity()
{
  if (floor_ == nullptr) THROW_ARGOSEXCEPTION("the arena has no floor; add <floor> to <arena>");
  return *floor_;
}

void CSpace::GetEntitiesMatching(CEntity::TVector& found, const std::string& pattern)
{
  for (CEntity* entity : entities_)
    if (MatchPattern(entity->GetId(), pattern)) found.push_back(entity);
}

void CSpace::Clear()
{
  entities_.clear();
  by_id_.clear();
  // The types stay: a map that was asked for once stays where it is.
  for (auto& [type, entities] : by_type_) entities.clear();
}

bool CLoopFunctions::MoveEntity(CEmbodiedEntity& entity, const CVector3& position, const CQuaternion& orientation,
                                bool check_only, bool ignore_collisions)
{
  const auto& ours = Declared(entity.GetRootEntity().GetId());
  const Pose pose = PoseOf(ours, position, orientation);
  if (!ignore_collisions && swarmanoid::FindInTheWay(Editor().GetSpace(), ours, pose) != nullptr) return false;
  if (check_only) return true;
  try
  {
    Editor().MoveEntity(ours.GetId(), pose);
  }
  catch (const std::invalid_argument& refused)
  {
    throw CARGoSException(refused.what());
  }
  entity.GetOriginAnchor().Position = position;
  entity.GetOriginAnchor().Orientation = orientation;
  return true;
}

void CLoopFunctions::MoveEntity(CPositionalEntity& entity, const CVector3& position, const CQuaternion& orientation)
{
  const auto& ours = Declared(entity.GetRootEntity().GetId());
  try
  {
    Editor().MoveEntity(ours.GetId(), PoseOf(ours, position, orientation));
  }
  catch (const std::invalid_argument& refused)
  {
    throw CARGoSException(refused.what());
  }
  entity.SetPosition(position);
  entity.SetOrientation(orientation);
}

void CLoopFunctions::AddEntity(CEntity& entity)
{
  // Whoever made it may go on to hold it.
  static std::vector<std::unique_ptr<CEntity>> given;
  given.emplace_back(&entity);
  const auto& ours = Declared(entity.GetId());
  auto* body = dynamic_cast<CBodyEntity*>(&entity);
  if (body == nullptr) THROW_ARGOSEXCEPTION("'" << entity.GetId() << "' has no body");
  const SAnchor& at = body->GetEmbodiedEntity().GetOriginAnchor();
  try
  {
    Editor().AddEntity(ours.GetId(), PoseOf(ours, at.Position, at.Orientation));
  }
  catch (const std::invalid_argument& refused)
  {
    throw CARGoSException(refused.what());
  }
}

void CLoopFunctions::RemoveEntity(const std::string& id)
{
  try
  {
    Editor().RemoveEntity(Declared(id).GetId());
  }
  catch (const std::invalid_argument& refused)
  {
    throw CARGoSException(refused.what());
  }
}

void CLoopFunctions::RemoveEntity(CEntity& entity) { RemoveEntity(entity.GetRootEntity().GetId()); }

}  // namespace argos
