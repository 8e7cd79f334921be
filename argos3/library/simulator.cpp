// The space and the changes that loop functions make to it.
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/plugins/robots/e-puck/simulator/epuck_entity.h>
#include <argos3/plugins/robots/eye-bot/simulator/eyebot_entity.h>
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>
#include <argos3/plugins/simulator/entities/box_entity.h>
#include <argos3/plugins/simulator/entities/cylinder_entity.h>
#include <argos3/plugins/simulator/entities/light_entity.h>

#include "argos3/library/running.h"
#include "common/space/space.h"
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
  if (swarmanoid::argos3::IsBox(entity))
    pose.position += pose.orientation * swarmanoid::Vector3(0, 0, entity.GetSize().z() / 2);
  return pose;
}

const swarmanoid::CSwarmanoidSpaceEntity& Declared(const std::string& id)
{
  const auto* entity = Editor().GetSpace().FindEntity(TheRunning().OurId(id));
  if (entity == nullptr)
    THROW_ARGOSEXCEPTION("there is no entity '" << id << "': the experiment file declares none, and none was added");
  return *entity;
}

// The id of the reserve of lights in converted files.
constexpr const char* kMadeLight = "made_light";

std::uint32_t Rgb(const CColor& colour)
{
  return static_cast<std::uint32_t>(colour.GetRed()) << 16U | static_cast<std::uint32_t>(colour.GetGreen()) << 8U |
         colour.GetBlue();
}

bool HasReserve(const swarmanoid::CSwarmanoidSpace& space, const std::string& reserve)
{
  for (std::size_t i = 0; i < space.Size(); ++i)
    if (space.GetEntity(i).GetConfiguration().reserve == reserve) return true;
  return false;
}

const swarmanoid::CSwarmanoidSpaceEntity& NextSpare(const swarmanoid::CSwarmanoidSpace& space,
                                                    const std::string& reserve)
{
  try
  {
    return swarmanoid::FindToAdd(space, reserve);
  }
  catch (const std::invalid_argument& refused)
  {
    THROW_ARGOSEXCEPTION(refused.what() << " in the file that `swarmanoid convert` writes");
  }
}

// Of ours, the one to add for an entity that loop functions made: the one that the file declares, or a spare robot.
const swarmanoid::CSwarmanoidSpaceEntity& OursFor(const CEntity& made)
{
  const std::string& id = made.GetId();
  const swarmanoid::CSwarmanoidSpace& space = Editor().GetSpace();
  if (const auto* entity = space.FindEntity(TheRunning().OurId(id))) return *entity;
  if (dynamic_cast<const CLightEntity*>(&made) != nullptr && HasReserve(space, kMadeLight))
    return NextSpare(space, kMadeLight);
  if (const auto shape = swarmanoid::argos3::ShapeOf(made))
  {
    if (const auto* waiting = swarmanoid::argos3::WaitingBody(space, *shape)) return *waiting;
    THROW_ARGOSEXCEPTION("no " << made.GetTypeDescription() << " is left for '" << id << "', which the experiment file "
                               << "does not declare: as many of a size and mass as Init makes are kept twice; make one "
                               << "like it in Init, or write more of them into the file that `swarmanoid convert` "
                               << "writes");
  }
  const auto* robot = dynamic_cast<const CRobotWithController*>(&made);
  if (robot == nullptr) THROW_ARGOSEXCEPTION("the experiment file declares no light '" << id << "'");
  const std::string reserve = "added_" + robot->ControllerOfMade();
  if (!HasReserve(space, reserve))
    THROW_ARGOSEXCEPTION("no " << made.GetTypeDescription() << " with the controller '" << robot->ControllerOfMade()
                               << "' can be added as '" << id
                               << "': the controller is not in <controllers>, is of another "
                               << "kind of robot, or the experiment has no <reserve> '" << reserve << "' (`swarmanoid "
                               << "convert` writes it for loop functions that make robots in their own library)");
  const swarmanoid::CSwarmanoidSpaceEntity& ours = NextSpare(space, reserve);
  if (TheRunning().spares.count(ours.GetId()) == 0)
    THROW_ARGOSEXCEPTION("the controller of '" << id << "' is not in this process: loop functions add robots in a run "
                                               << "with --single-process");
  return ours;
}

// Their engines take a body where another one is; it is for them to push the two apart.
void AddAnywhere(const std::string& id, const Pose& pose)
{
  constexpr double kStep = 1;  // m
  Pose free = pose;
  while (!Editor().IsFree(id, free)) free.position.z() += kStep;
  Editor().AddEntity(id, free);
  if (free.position.z() != pose.position.z()) Editor().MoveEntity(id, pose);
}

// Of a box or cylinder that comes: those it was given.
void ShowLeds(const std::string& ours, const CEntity& made)
{
  const auto* lit = dynamic_cast<const CObjectWithLEDs*>(&made);
  if (lit == nullptr) return;
  const bool has_leds = lit->GetLEDEquippedEntity().GetNumLEDs() > 0;
  const CColor colour =
      has_leds ? const_cast<CObjectWithLEDs*>(lit)->GetLEDEquippedEntity().GetLED(0).GetInitColor() : CColor::BLACK;
  Editor().SetAttribute(ours, "colour", Rgb(colour));
}

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

void CSpace::Reset()
{
  THROW_ARGOSEXCEPTION("loop functions cannot reset the space; `swarmanoid control reset` starts the run anew");
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

void CLoopFunctions::AddEntity(CEntity& entity)
{
  // Whoever made it may go on to hold it.
  static std::vector<std::unique_ptr<CEntity>> given;
  given.emplace_back(&entity);
  const auto* body = dynamic_cast<CBodyEntity*>(&entity);
  const auto* light = dynamic_cast<CLightEntity*>(&entity);
  if (body == nullptr && light == nullptr)
    THROW_ARGOSEXCEPTION("'" << entity.GetId() << "' is neither a body nor a light");
  Running& running = TheRunning();
  if (running.rehearsal && swarmanoid::argos3::ShapeOf(entity) &&
      Editor().GetSpace().FindEntity(running.OurId(entity.GetId())) == nullptr)
  {
    running.rehearsal->Add(entity);
    return CSimulator::GetInstance().GetSpace().InsertAny(entity);
  }
  std::string ours;
  bool was_declared = true;
  try
  {
    const auto& added = OursFor(entity);
    ours = added.GetId();
    was_declared = ours == running.OurId(entity.GetId());
    if (light != nullptr)
    {
      Editor().AddEntity(ours, PoseOf(added, light->GetPosition(), light->GetOrientation()));
      Editor().SetAttribute(ours, "intensity", light->GetIntensity());
      Editor().SetAttribute(ours, "colour", Rgb(light->GetColor()));
    }
    else
    {
      const SAnchor& at = body->GetEmbodiedEntity().GetOriginAnchor();
      AddAnywhere(ours, PoseOf(added, at.Position, at.Orientation));
      if (!was_declared) ShowLeds(ours, entity);
    }
  }
  catch (const std::invalid_argument& refused)
  {
    throw CARGoSException(refused.what());
  }
  running.given[ours] = &entity;
  running.presence_changed = true;
  CSimulator::GetInstance().GetSpace().InsertAny(entity);
  if (was_declared) return;
  running.taken[entity.GetId()] = ours;
  if (const auto spare = running.spares.find(ours); spare != running.spares.end()) spare->second->Take(entity.GetId());
}

void CLoopFunctions::RemoveEntity(const std::string& id)
{
  if (TheRunning().Rehearsed(id)) return;
  const std::string ours = Declared(id).GetId();
  try
  {
    Editor().RemoveEntity(ours);
  }
  catch (const std::invalid_argument& refused)
  {
    throw CARGoSException(refused.what());
  }
  Running& running = TheRunning();
  running.given.erase(ours);
  running.presence_changed = true;
  running.taken.erase(id);
  if (const auto spare = running.spares.find(ours); spare != running.spares.end()) spare->second->Leave();
}

void CLoopFunctions::RemoveEntity(CEntity& entity) { RemoveEntity(entity.GetRootEntity().GetId()); }

}  // namespace argos
