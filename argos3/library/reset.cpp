// Resets the space, its entities and robots within a run, for loop functions, as ARGoS3's Reset does.
#include <argos3/core/simulator/loop_functions.h>
#include <argos3/plugins/simulator/entities/light_entity.h>

#include "argos3/library/editing.h"
#include "common/space/attributes.h"

namespace swarmanoid::argos3
{

Arrival ArrivalNow(const CSwarmanoidSpaceEntity& entity)
{
  const auto value = [&](const char* name)
  { return FindAttribute(entity.GetKind(), name) == nullptr ? 0 : entity.GetAttribute(name); };
  return {entity.GetPose(), value("colour"), value("turret_angle")};
}

}  // namespace swarmanoid::argos3

namespace argos
{
namespace
{

using swarmanoid::CSwarmanoidSpaceEntity;
using swarmanoid::argos3::Arrival;
using swarmanoid::argos3::ControlledRobot;
using swarmanoid::argos3::Declared;
using swarmanoid::argos3::Editor;
using swarmanoid::argos3::Running;
using swarmanoid::argos3::TheRunning;

// Returns nullptr for an entity outside the arena.
const CSwarmanoidSpaceEntity* PresentOf(CEntity& part)
{
  const auto& space = Editor().GetSpace();
  const auto* ours = space.FindEntity(TheRunning().OurId(part.GetRootEntity().GetId()));
  return ours != nullptr && space.IsPresent(ours->GetIndex()) ? ours : nullptr;
}

// Returns the present state of an entity that was removed and came back by itself.
Arrival ArrivalOf(const CSwarmanoidSpaceEntity& ours)
{
  const auto given = TheRunning().arrivals.find(ours.GetId());
  return given != TheRunning().arrivals.end() ? given->second : swarmanoid::argos3::ArrivalNow(ours);
}

void ResetAttribute(const CSwarmanoidSpaceEntity& ours, const char* name, double value)
{
  const auto* attribute = swarmanoid::FindAttribute(ours.GetKind(), name);
  if (attribute == nullptr) return;
  for (int element = 0; element < attribute->count; ++element)
    Editor().SetAttribute(ours.GetId(), name, value, element);
}

void RequireControllersHere()
{
  const Running& running = TheRunning();
  const auto& space = Editor().GetSpace();
  for (std::size_t i = 0; i < space.Size(); ++i)
  {
    const CSwarmanoidSpaceEntity& ours = space.GetEntity(i);
    if (!space.IsPresent(i) || ours.GetConfiguration().controller.empty()) continue;
    if (running.controlled.count(ours.GetId()) != 0) continue;
    THROW_ARGOSEXCEPTION("the controller of '" << running.translation.Argos3Id(ours.GetId())
                                               << "' is not in this process: loop functions reset, enable and disable "
                                               << "robots in a run with --single-process");
  }
}

// Returns nullptr for an entity that is outside the arena or has no controller. Throws CARGoSException if the
// controller is in another process.
ControlledRobot* ControlledOf(const CSwarmanoidSpaceEntity* ours)
{
  if (ours == nullptr || ours->GetConfiguration().controller.empty()) return nullptr;
  const auto found = TheRunning().controlled.find(ours->GetId());
  if (found != TheRunning().controlled.end()) return found->second;
  RequireControllersHere();
  return nullptr;
}

}  // namespace

void CSimulator::Reset()
{
  if (resets_) return GetSpace().Reset();
  RequireControllersHere();
  // The first seed gives the numbers of the first trial.
  const UInt32 variation = seed_ ^ first_seed_;
  CRandom::GetCategory("argos").Vary(variation);
  CRandom::GetCategory("argos").ResetRNGs();
  Editor().BeginStep({seed_, swarmanoid::StreamName("loop functions"), swarmanoid::StreamName("ARGoS3 reset"), 0});
  GetSpace().Reset();
  Editor().BeginAgain(TheRunning().step, variation);
  terminated_ = false;
  struct Resetting
  {
    explicit Resetting(bool& now) : is_so(now) { is_so = true; }
    ~Resetting() { is_so = false; }
    Resetting(const Resetting&) = delete;
    Resetting& operator=(const Resetting&) = delete;
    bool& is_so;
  };
  const Resetting resetting(resets_);
  GetLoopFunctions().Reset();
}

void CSpace::Reset()
{
  Running& running = TheRunning();
  RequireControllersHere();
  SetSimulationClock(0);
  running.first_step = running.step;
  // Only the Reset of the simulator restores the earlier random numbers.
  Editor().BeginAgain(running.step, static_cast<UInt32>(swarmanoid::MixedBits(running.step)));
  for (CEntity* entity : entities_)
    if (!running.Rehearsed(entity->GetId())) entity->Reset();
}

void CEmbodiedEntity::Reset()
{
  const auto* ours = PresentOf(*this);
  if (ours == nullptr || !ours->IsMovable()) return;
  const swarmanoid::Pose pose = ArrivalOf(*ours).pose;
  Editor().MoveEntity(ours->GetId(), pose, swarmanoid::EOccupied::kOverlap);
  const SAnchor anchor = swarmanoid::argos3::AnchorOf(*ours, pose);
  m_sOriginAnchor.Position = anchor.Position;
  m_sOriginAnchor.Orientation = anchor.Orientation;
  UpdateAnchors();
}

void CControllableEntity::SetEnabled(bool enabled)
{
  if (enabled == IsEnabled()) return;
  CEntity::SetEnabled(enabled);
  if (TheRunning().rehearsal) return;
  if (auto* robot = ControlledOf(PresentOf(*this))) robot->SetEnabled(enabled);
}

void CControllableEntity::Reset()
{
  const auto* ours = PresentOf(*this);
  if (ours != nullptr) ResetAttribute(*ours, "turret_angle", ArrivalOf(*ours).turret);
  if (auto* robot = ControlledOf(ours)) robot->Reset();
}

void CLEDEntity::Reset()
{
  const auto* ours = PresentOf(*this);
  if (ours == nullptr) return;
  // The LEDs of robots are dark after a reset.
  for (const char* name : {"led", "beacon"}) ResetAttribute(*ours, name, 0);
  ResetAttribute(*ours, "colour", ArrivalOf(*ours).colour);
}

void CRABEquippedEntity::Reset()
{
  const auto* ours = PresentOf(*this);
  if (ours != nullptr && swarmanoid::argos3::SendsMessage(*ours)) ClearData();
}

void CBatteryEquippedEntity::Reset()
{
  const auto found = TheRunning().batteries.find(TheRunning().OurId(GetRootEntity().GetId()));
  if (found != TheRunning().batteries.end()) found->second->available = found->second->start;
}

void CLightEntity::Reset()
{
  const auto* ours = PresentOf(*this);
  if (ours == nullptr) return;
  const Arrival arrival = ArrivalOf(*ours);
  if (ours->IsMovable()) Editor().MoveEntity(ours->GetId(), arrival.pose, swarmanoid::EOccupied::kOverlap);
  SetPosition(TheRunning().translation.Argos3Position(arrival.pose.position));
  SetOrientation(swarmanoid::argos3::Argos3Orientation(arrival.pose.orientation));
  SetColor(CColor(0xff000000U | static_cast<std::uint32_t>(arrival.colour)));
}

}  // namespace argos
