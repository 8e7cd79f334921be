// Adds and removes entities for loop functions. Our space has all entities from the start, so adding one uses a waiting
// entity.
#include <argos3/core/simulator/entity/composable_entity.h>
#include <argos3/plugins/simulator/entities/light_entity.h>

#include <algorithm>

#include "argos3/converter/our_ids.h"
#include "argos3/library/editing.h"
#include "common/space/attributes.h"
#include "space_server/space_changes.h"

namespace argos
{
namespace
{

using swarmanoid::Pose;
using swarmanoid::argos3::Editor;
using swarmanoid::argos3::PoseOf;
using swarmanoid::argos3::Rgb;
using swarmanoid::argos3::Running;
using swarmanoid::argos3::TheRunning;

// The id of the reserve of lights in converted files.
constexpr const char* kMadeLight = "made_light";

bool HasReserve(const swarmanoid::CSwarmanoidSpace& space, const std::string& reserve)
{
  for (std::size_t i = 0; i < space.Size(); ++i)
    if (space.GetEntity(i).GetConfiguration().reserve == reserve) return true;
  return false;
}

const swarmanoid::CSwarmanoidSpaceEntity& NextSpare(const swarmanoid::CSwarmanoidSpace& space,
                                                    const std::string& reserve)
{
  const auto is_taken = [&](const swarmanoid::CSwarmanoidSpaceEntity& spare)
  {
    const auto& taken = TheRunning().taken;
    return std::any_of(taken.begin(), taken.end(), [&](const auto& pair) { return pair.second == spare.GetId(); });
  };
  try
  {
    const auto& first = swarmanoid::FindToAdd(space, reserve);
    for (std::size_t i = first.GetIndex(); i < space.Size(); ++i)
    {
      const auto& spare = space.GetEntity(i);
      if (spare.GetConfiguration().reserve == reserve && !space.IsPresent(i) && !is_taken(spare)) return spare;
    }
    throw std::invalid_argument("all of the reserve '" + reserve + "' are taken; raise its quantity");
  }
  catch (const std::invalid_argument& refused)
  {
    THROW_ARGOSEXCEPTION(refused.what() << " in the file that `swarmanoid convert` writes");
  }
}

// Returns our entity for one that loop functions made: the one that the file declares, or a spare robot.
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
  const std::string reserve = "added_" + swarmanoid::argos3::OurCharacters(robot->ControllerOfMade());
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

// Gives a robot that loop functions made its controller before AddEntity, if they ask for it.
void GiveController(const CEntity& made)
{
  Running& running = TheRunning();
  const auto* robot = dynamic_cast<const CRobotWithController*>(&made);
  if (running.editor == nullptr || robot == nullptr || robot->ControllerOfMade().empty()) return;
  const std::string ours = OursFor(made).GetId();
  const auto spare = running.spares.find(ours);
  if (spare == running.spares.end()) return;
  running.taken[made.GetId()] = ours;
  running.given[ours] = const_cast<CEntity*>(&made);
  spare->second->Take(made.GetId());
}

// Engines of ARGoS3 accept a body that overlaps another one, and push the two apart.
void AddAnywhere(const std::string& id, const Pose& pose)
{
  constexpr double kStep = 1;  // m
  Pose free = pose;
  while (!Editor().IsFree(id, free)) free.position.z() += kStep;
  Editor().AddEntity(id, free);
  if (free.position.z() != pose.position.z()) Editor().MoveEntity(id, pose, swarmanoid::EOccupied::kOverlap);
}

// Sets the LEDs of an added box or cylinder to its initial colours.
void ShowLeds(const std::string& ours, const CEntity& made)
{
  const auto* lit = dynamic_cast<const CObjectWithLEDs*>(&made);
  if (lit == nullptr) return;
  const bool has_leds = lit->GetLEDEquippedEntity().GetNumLEDs() > 0;
  const CColor colour =
      has_leds ? const_cast<CObjectWithLEDs*>(lit)->GetLEDEquippedEntity().GetLED(0).GetInitColor() : CColor::BLACK;
  Editor().SetAttribute(ours, "colour", Rgb(colour));
}

}  // namespace

CCI_Controller& CControllableEntity::GetController()
{
  if (controller_ == nullptr || found_at_ != TheRunning().controller_changes)
  {
    controller_ = &FindController();
    found_at_ = TheRunning().controller_changes;
  }
  return *controller_;
}

CCI_Controller& CControllableEntity::FindController()
{
  const std::string& id = GetRootEntity().GetId();
  const auto& controllers = TheRunning().controllers;
  if (controllers.count(id) == 0) GiveController(GetRootEntity());
  const auto found = controllers.find(id);
  if (found == controllers.end())
    THROW_ARGOSEXCEPTION("the controller of '" << id << "' is not in this process: loop functions reach controllers in "
                                               << "a run with --single-process");
  return *found->second;
}

void CLoopFunctions::AddEntity(CEntity& entity)
{
  // The loop functions may keep a pointer to the entity, so it is not destroyed.
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
  running.arrivals[ours] = swarmanoid::argos3::ArrivalNow(*Editor().GetSpace().FindEntity(ours));
  running.presence_changed = true;
  CSimulator::GetInstance().GetSpace().InsertAny(entity);
  if (was_declared) return;
  running.taken[entity.GetId()] = ours;
  if (const auto spare = running.spares.find(ours); spare != running.spares.end()) spare->second->Take(entity.GetId());
}

void CLoopFunctions::RemoveEntity(const std::string& id)
{
  if (TheRunning().Rehearsed(id)) return;
  const std::string ours = swarmanoid::argos3::Declared(id).GetId();
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
  running.arrivals.erase(ours);
  running.presence_changed = true;
  running.taken.erase(id);
  if (const auto spare = running.spares.find(ours); spare != running.spares.end()) spare->second->Leave();
}

void CLoopFunctions::RemoveEntity(CEntity& entity) { RemoveEntity(entity.GetRootEntity().GetId()); }

}  // namespace argos
