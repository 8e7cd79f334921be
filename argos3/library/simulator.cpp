// The space and the changes that loop functions make to it.
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/plugins/robots/e-puck/simulator/epuck_entity.h>
#include <argos3/plugins/robots/eye-bot/simulator/eyebot_entity.h>
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>
#include <argos3/plugins/simulator/entities/box_entity.h>
#include <argos3/plugins/simulator/entities/cylinder_entity.h>
#include <argos3/plugins/simulator/entities/light_entity.h>

#include "argos3/library/editing.h"
#include "space_server/space_changes.h"

namespace argos
{
namespace
{

using swarmanoid::Pose;
using swarmanoid::argos3::Declared;
using swarmanoid::argos3::Editor;
using swarmanoid::argos3::PoseOf;
using swarmanoid::argos3::Rgb;
using swarmanoid::argos3::TheRunning;

template <class Body>
void InsertBody(CSpace& space, Body& body)
{
  space.Insert(body);
  space.InsertComponent(body.GetId(), body.GetEmbodiedEntity());
}
template <class Robot>
bool InsertIfRobot(CSpace& space, CEntity& entity)
{
  auto* robot = dynamic_cast<Robot*>(&entity);
  if (robot == nullptr) return false;
  InsertBody(space, *robot);
  space.InsertComponent(robot->GetId(), robot->GetControllableEntity());
  space.InsertComponent(robot->GetId(), robot->GetRABEquippedEntity());
  space.InsertComponent(robot->GetId(), robot->GetBatterySensorEquippedEntity());
  if (robot->HasComponent("wheels"))
    space.InsertComponent(robot->GetId(), robot->template GetComponent<CWheeledEntity>("wheels"));
  return true;
}
template <class Body>
bool InsertIfBody(CSpace& space, CEntity& entity)
{
  auto* body = dynamic_cast<Body*>(&entity);
  if (body != nullptr) InsertBody(space, *body);
  return body != nullptr;
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

TConfigurationNode& CSimulator::GetConfigurationRoot()
{
  if (configuration_.Value().empty())
    THROW_ARGOSEXCEPTION(
        "the experiment file is not at hand: it is if the library of the loop functions asks for it, "
        "in a run of the file of ARGoS3 or of what `swarmanoid convert` writes");
  return configuration_;
}

CColor CFloorEntity::GetColorAtPoint(Real x, Real y)
{
  return CSimulator::GetInstance().GetLoopFunctions().GetFloorColor(CVector2(x, y));
}

void CLightEntity::SetColor(const CColor& colour)
{
  Editor().SetAttribute(Declared(GetId()).GetId(), "colour", Rgb(colour));
  colour_ = colour;
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

void CSpace::InsertAny(CEntity& entity)
{
  if (InsertIfRobot<CFootBotEntity>(*this, entity) || InsertIfRobot<CEyeBotEntity>(*this, entity) ||
      InsertIfRobot<CEPuckEntity>(*this, entity) || InsertIfBody<CBoxEntity>(*this, entity) ||
      InsertIfBody<CCylinderEntity>(*this, entity))
    return;
  if (auto* light = dynamic_cast<CLightEntity*>(&entity)) Insert(*light);
}

void CSpace::Clear()
{
  entities_.clear();
  by_id_.clear();
  // The types stay: a map that was asked for once stays where it is.
  for (auto& [type, entities] : by_type_) entities.clear();
}

bool CEmbodiedEntity::MoveTo(const CVector3& position, const CQuaternion& orientation, bool check_only,
                             bool ignore_collisions)
{
  if (TheRunning().Rehearsed(GetRootEntity().GetId())) return true;
  const auto& ours = Declared(GetRootEntity().GetId());
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
  m_sOriginAnchor.Position = position;
  m_sOriginAnchor.Orientation = orientation;
  return true;
}

bool CEmbodiedEntity::IsCollidingWithSomething() const
{
  if (TheRunning().Rehearsed(const_cast<CEmbodiedEntity*>(this)->GetRootEntity().GetId())) return false;
  const auto& ours = Declared(const_cast<CEmbodiedEntity*>(this)->GetRootEntity().GetId());
  const Pose pose{ours.GetPosition(), ours.GetOrientation()};
  return swarmanoid::FindInTheWay(Editor().GetSpace(), ours, pose) != nullptr;
}

bool CLoopFunctions::MoveEntity(CEmbodiedEntity& entity, const CVector3& position, const CQuaternion& orientation,
                                bool check_only, bool ignore_collisions)
{
  return entity.MoveTo(position, orientation, check_only, ignore_collisions);
}

void CPositionalEntity::MoveTo(const CVector3& position, const CQuaternion& orientation)
{
  const auto& ours = Declared(GetRootEntity().GetId());
  try
  {
    Editor().MoveEntity(ours.GetId(), PoseOf(ours, position, orientation));
  }
  catch (const std::invalid_argument& refused)
  {
    throw CARGoSException(refused.what());
  }
  SetPosition(position);
  SetOrientation(orientation);
}

void CLoopFunctions::MoveEntity(CPositionalEntity& entity, const CVector3& position, const CQuaternion& orientation)
{
  entity.MoveTo(position, orientation);
}

}  // namespace argos
