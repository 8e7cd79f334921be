// The space, and the changes of loop functions to it.
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/plugins/robots/e-puck/simulator/epuck_entity.h>
#include <argos3/plugins/robots/eye-bot/simulator/eyebot_entity.h>
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>
#include <argos3/plugins/robots/kheperaiv/simulator/kheperaiv_entity.h>
#include <argos3/plugins/robots/kilobot/simulator/kilobot_entity.h>
#include <argos3/plugins/robots/pi-puck/simulator/pipuck_entity.h>
#include <argos3/plugins/robots/spiri/simulator/spiri_entity.h>
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

CRandom::CRNG* CSimulator::GetRNG()
{
  if (generator_ == nullptr) generator_ = CRandom::CreateRNG("argos");
  return generator_;
}

TConfigurationNode& CSimulator::GetConfigForController(const std::string& id)
{
  TConfigurationNodeIterator controller;
  for (controller = controller.begin(&GetNode(GetConfigurationRoot(), "controllers")); controller != controller.end();
       ++controller)
    if (controller->GetAttribute("id") == id) return *controller;
  THROW_ARGOSEXCEPTION("<controllers> has no controller '" << id << "'");
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
      InsertIfRobot<CEPuckEntity>(*this, entity) || InsertIfRobot<CKheperaIVEntity>(*this, entity) ||
      InsertIfRobot<CKilobotEntity>(*this, entity) || InsertIfRobot<CPiPuckEntity>(*this, entity) ||
      InsertIfRobot<CSpiriEntity>(*this, entity) || InsertIfBody<CBoxEntity>(*this, entity) ||
      InsertIfBody<CCylinderEntity>(*this, entity))
    return;
  if (auto* light = dynamic_cast<CLightEntity*>(&entity)) Insert(*light);
}

void CSpace::Clear()
{
  entities_.clear();
  by_id_.clear();
  // The types are kept, so that references to maps stay valid.
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
    Editor().MoveEntity(ours.GetId(), pose, swarmanoid::EOccupied::kOverlap);
  }
  catch (const std::invalid_argument& refused)
  {
    throw CARGoSException(refused.what());
  }
  m_sOriginAnchor.Position = position;
  m_sOriginAnchor.Orientation = orientation;
  UpdateAnchors();
  return true;
}

SAnchor& CEmbodiedEntity::AddAnchor(const std::string& id, const CVector3& position, const CQuaternion& orientation)
{
  if (id == m_sOriginAnchor.Id || anchors_.count(id) != 0)
    THROW_ARGOSEXCEPTION("the body of '" << GetRootEntity().GetId() << "' has an anchor '" << id << "' already");
  SAnchor& anchor = anchors_[id];
  anchor.Id = id;
  anchor.Index = static_cast<UInt32>(anchors_.size());
  anchor.OffsetPosition = position;
  anchor.OffsetOrientation = orientation;
  UpdateAnchors();
  return anchor;
}

SAnchor& CEmbodiedEntity::GetAnchor(const std::string& id)
{
  if (id == m_sOriginAnchor.Id) return m_sOriginAnchor;
  const auto found = anchors_.find(id);
  if (found != anchors_.end()) return found->second;
  std::string known = m_sOriginAnchor.Id;
  for (const auto& anchor : anchors_) known += ", " + anchor.first;
  THROW_ARGOSEXCEPTION("the body of '" << GetRootEntity().GetId() << "' has no anchor '" << id << "'; it has: " << known
                                       << ". AddAnchor makes others");
}

const SBoundingBox& CPhysicsModel::GetBoundingBox() const { return body_->GetBoundingBox(); }

bool CPhysicsModel::IsCollidingWithSomething() const { return body_->IsCollidingWithSomething(); }

CPhysicsModel& CEmbodiedEntity::GetPhysicsModel(size_t number)
{
  const auto& engines = CSimulator::GetInstance().GetPhysicsEngines();
  if (number >= GetPhysicsModelsNum())
    THROW_ARGOSEXCEPTION("the body of '" << GetRootEntity().GetId() << "' has no physics model " << number
                                         << "; it has one, 0");
  if (models_.empty()) models_.emplace_back(*engines.front(), *this);
  return models_.front();
}

CPhysicsModel& CEmbodiedEntity::GetPhysicsModel(const std::string& engine)
{
  CSimulator::GetInstance().GetPhysicsEngine(engine);
  return GetPhysicsModel(0);
}

void CEmbodiedEntity::UpdateAnchors()
{
  const SAnchor& origin = m_sOriginAnchor;
  for (auto& named : anchors_)
  {
    SAnchor& anchor = named.second;
    anchor.Position = origin.Position + CVector3(anchor.OffsetPosition).Rotate(origin.Orientation);
    anchor.Orientation = origin.Orientation * anchor.OffsetOrientation;
  }
}

const SBoundingBox& CEmbodiedEntity::GetBoundingBox() const
{
  const auto& ours = Declared(GetRootEntity().GetId());
  const auto& row = swarmanoid::DescriptionOf(ours.GetKind());
  const swarmanoid::Vector3& size = ours.GetSize();
  const bool is_cylinder = row.form == swarmanoid::BodyForm::kCylinder;
  const double half_height = size.z() / 2;
  const swarmanoid::Pose pose = ours.GetPose();
  swarmanoid::Vector3 middle = pose.position;
  if (row.origin == swarmanoid::BodyOrigin::kBase) middle = pose.Apply({0, 0, half_height});
  const Eigen::Matrix3d axes = pose.orientation.toRotationMatrix();
  swarmanoid::Vector3 half;
  for (int i = 0; i < 3; ++i)
    half[i] = std::abs(axes(i, 2)) * half_height +
              (is_cylinder ? size.x() * std::sqrt(std::max(0.0, 1 - axes(i, 2) * axes(i, 2)))
                           : std::abs(axes(i, 0)) * size.x() / 2 + std::abs(axes(i, 1)) * size.y() / 2);
  box_.MinCorner = TheRunning().translation.Argos3Position(middle - half);
  box_.MaxCorner = TheRunning().translation.Argos3Position(middle + half);
  return box_;
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
    Editor().MoveEntity(ours.GetId(), PoseOf(ours, position, orientation), swarmanoid::EOccupied::kOverlap);
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
