// Robots that loop functions make, and the LEDs of entities.
#include <argos3/core/simulator/entity/composable_entity.h>
#include <argos3/core/simulator/physics_engine/physics_engine.h>
#include <argos3/core/simulator/simulator.h>
#include <argos3/plugins/robots/e-puck/control_interface/ci_epuck_wheels_actuator.h>
#include <argos3/plugins/robots/e-puck/simulator/epuck_entity.h>
#include <argos3/plugins/robots/eye-bot/simulator/eyebot_entity.h>
#include <argos3/plugins/robots/foot-bot/simulator/footbot_entity.h>
#include <argos3/plugins/robots/kheperaiv/simulator/kheperaiv_entity.h>
#include <argos3/plugins/simulator/entities/box_entity.h>
#include <argos3/plugins/simulator/entities/cylinder_entity.h>
#include <argos3/plugins/simulator/entities/light_entity.h>

#include "argos3/converter/robot_rows.h"
#include "argos3/kinds/epuck_ground.h"
#include "argos3/library/editing.h"
#include "argos3/library/running.h"
#include "common/control_interface/eyebot/ci_eyebot_light_sensor.h"
#include "common/control_interface/footbot/ci_footbot_base_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_light_sensor.h"
#include "common/control_interface/footbot/ci_footbot_motor_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_proximity_sensor.h"
#include "common/space/space.h"

namespace swarmanoid::argos3
{

argos::CBodyEntity* TheirBodyOf(const std::string& our_id)
{
  for (argos::CEntity* entity : argos::CSimulator::GetInstance().GetSpace().GetEntityVector())
    if (TheRunning().OurId(entity->GetId()) == our_id) return dynamic_cast<argos::CBodyEntity*>(entity);
  return nullptr;
}

}  // namespace swarmanoid::argos3

namespace argos
{
namespace
{

using swarmanoid::argos3::Running;
using swarmanoid::argos3::TheRunning;

// The index of an LED's colour in our space.
struct Slot
{
  const char* attribute;
  int element;
};

Slot SlotOf(const swarmanoid::CSwarmanoidSpaceEntity& entity, unsigned led)
{
  const swarmanoid::EntityKindDescription& row = swarmanoid::DescriptionOf(entity.GetKind());
  if (!row.leds) return {"colour", 0};
  return led < row.leds->places.size() ? Slot{"led", static_cast<int>(led)} : Slot{"beacon", 0};
}

// Returns nullptr while no loop functions run, and for an entity that was not added yet.
const swarmanoid::CSwarmanoidSpaceEntity* OursOf(CEntity& part)
{
  const Running& running = TheRunning();
  if (running.editor == nullptr) return nullptr;
  return running.editor->GetSpace().FindEntity(running.OurId(part.GetRootEntity().GetId()));
}

swarmanoid::argos3::BatteryCharge& ChargeOf(const CBatteryEquippedEntity& part)
{
  const std::string& id = const_cast<CBatteryEquippedEntity&>(part).GetRootEntity().GetId();
  const auto found = TheRunning().batteries.find(TheRunning().OurId(id));
  if (found == TheRunning().batteries.end())
    THROW_ARGOSEXCEPTION("the battery of '" << id << "' is that of its sensor <battery>, which its controller does not "
                                            << "have in this process; add it, and run with --single-process");
  return *found->second;
}

}  // namespace

CComposableEntity& CEntity::GetParent() const
{
  if (parent_ == nullptr) THROW_ARGOSEXCEPTION("entity '" << id_ << "' is no part of another one");
  return dynamic_cast<CComposableEntity&>(*parent_);
}

CEntity* CComposableEntity::Find(const std::string& name)
{
  const std::size_t dot = name.find('.');
  const std::string first = name.substr(0, dot);
  const std::size_t bracket = first.find('[');
  const std::string type = first.substr(0, bracket);
  const std::string id = bracket == std::string::npos ? "" : first.substr(bracket + 1, first.size() - bracket - 2);
  for (CEntity* component : in_order_)
  {
    if (component->GetTypeDescription() != type || (!id.empty() && component->GetId() != id)) continue;
    if (dot == std::string::npos) return component;
    auto* composed = dynamic_cast<CComposableEntity*>(component);
    return composed == nullptr ? nullptr : composed->Find(name.substr(dot + 1));
  }
  return nullptr;
}

CEntity& CComposableEntity::GetComponent(const std::string& name)
{
  if (CEntity* found = Find(name)) return *found;
  std::string types;
  for (const CEntity* component : in_order_) types += (types.empty() ? "" : ", ") + component->GetTypeDescription();
  THROW_ARGOSEXCEPTION("entity '" << GetId() << "' has no component '" << name << "'; it has: " << types);
}

CColor CLEDEntity::GetColor() const
{
  const auto* ours = OursOf(const_cast<CLEDEntity&>(*this));
  if (ours == nullptr) return first_colour_;
  const Slot slot = SlotOf(*ours, number_);
  return CColor(0xff000000U | static_cast<std::uint32_t>(ours->GetAttribute(slot.attribute, slot.element)));
}

void CLEDEntity::SetColor(const CColor& colour)
{
  const auto* ours = OursOf(*this);
  if (ours == nullptr && TheRunning().editor == nullptr)
    THROW_ARGOSEXCEPTION("LEDs of '" << GetRootEntity().GetId() << "' are changed by loop functions alone");
  first_colour_ = colour;
  if (ours == nullptr) return;
  const Slot slot = SlotOf(*ours, number_);
  const std::uint32_t value = colour.GetRed() << 16U | colour.GetGreen() << 8U | colour.GetBlue();
  TheRunning().editor->SetAttribute(ours->GetId(), slot.attribute, value, slot.element);
}

CLEDEquippedEntity::CLEDEquippedEntity(CEntity* parent, unsigned leds) : CComposableEntity(parent, "leds_0")
{
  for (unsigned led = 0; led < leds; ++led)
  {
    leds_.push_back(std::make_shared<CLEDEntity>(this, led));
    AddComponent(*leds_.back());
  }
}

void CLEDEquippedEntity::AddLED(const CVector3&, const SAnchor&, const CColor& colour)
{
  if (dynamic_cast<CObjectWithLEDs*>(&GetRootEntity()) == nullptr)
    THROW_ARGOSEXCEPTION("'" << GetRootEntity().GetId() << "' has the LEDs of its kind; boxes and cylinders get more");
  leds_.push_back(std::make_shared<CLEDEntity>(this, static_cast<unsigned>(leds_.size()), colour));
  AddComponent(*leds_.back());
  if (leds_.size() == 1 && OursOf(*this) != nullptr) leds_.front()->SetColor(colour);
}

void CLEDEquippedEntity::AddLEDRing(const CVector3& centre, Real, const CRadians&, UInt32 leds, const SAnchor& anchor,
                                    const CColor& colour)
{
  for (UInt32 led = 0; led < leds; ++led) AddLED(centre, anchor, colour);
}

CLEDEntity& CLEDEquippedEntity::GetLED(UInt32 led)
{
  if (led >= leds_.size()) THROW_ARGOSEXCEPTION("LED " << led << " of " << leds_.size() << "; the first one is 0");
  return *leds_[led];
}

void CLEDEquippedEntity::SetAllLEDsColors(const CColor& colour)
{
  for (const auto& led : leds_) led->SetColor(colour);
}

void CLEDEquippedEntity::SetAllLEDsColors(const std::vector<CColor>& colours)
{
  if (colours.size() != leds_.size())
    THROW_ARGOSEXCEPTION(colours.size() << " colours for " << leds_.size() << " LEDs");
  for (std::size_t led = 0; led < leds_.size(); ++led) leds_[led]->SetColor(colours[led]);
}

CRobotWithController::CRobotWithController(const std::string& id, unsigned leds)
    : CBodyEntity(id, true),
      controllable_(this, "controller_0"),
      leds_(this, leds),
      rab_(this),
      gripper_(this),
      battery_(this)
{
  AddComponent(battery_);
  AddComponent(gripper_);
  AddComponent(controllable_);
  AddComponent(leds_);
  AddComponent(rab_);
}

CRobotWithController::CRobotWithController(const std::string& id, unsigned leds, const std::string& controller,
                                           const CVector3& position, const CQuaternion& orientation)
    : CRobotWithController(id, leds)
{
  controller_ = controller;
  GetEmbodiedEntity().GetOriginAnchor().Position = position;
  GetEmbodiedEntity().GetOriginAnchor().Orientation = orientation;
}

CFootBotEntity::CFootBotEntity(const std::string& id, const std::string& controller, const CVector3& position,
                               const CQuaternion& orientation, Real, size_t, const CRadians&, bool, const CRadians&,
                               Real, Real, const std::string&)
    : CRobotWithController(id, kLeds, controller, position, orientation)
{
  AddParts();
}

CEyeBotEntity::CEyeBotEntity(const std::string& id, const std::string& controller, const CVector3& position,
                             const CQuaternion& orientation, Real, size_t, const std::string&)
    : CRobotWithController(id, kLeds, controller, position, orientation)
{
  AddParts();
}

CEPuckEntity::CEPuckEntity(const std::string& id, const std::string& controller, const CVector3& position,
                           const CQuaternion& orientation, Real, size_t, const std::string&)
    : CRobotWithController(id, kLeds, controller, position, orientation)
{
  AddParts();
}

const Real CCI_EPuckWheelsActuator::MAX_VELOCITY_CM_SEC = 30;
const Real CCI_EPuckWheelsActuator::MIN_VELOCITY_CM_SEC = -30;

CKheperaIVEntity::CKheperaIVEntity(const std::string& id, const std::string& controller, const CVector3& position,
                                   const CQuaternion& orientation, Real, size_t, const std::string&)
    : CRobotWithController(id, kLeds, controller, position, orientation)
{
  AddParts();
}

CBoxEntity::CBoxEntity(const std::string& id, const CVector3& position, const CQuaternion& orientation, bool movable,
                       const CVector3& size, Real mass)
    : CBoxEntity(id, movable, 0, size, mass)
{
  GetEmbodiedEntity().GetOriginAnchor().Position = position;
  GetEmbodiedEntity().GetOriginAnchor().Orientation = orientation;
}

CCylinderEntity::CCylinderEntity(const std::string& id, const CVector3& position, const CQuaternion& orientation,
                                 bool movable, Real radius, Real height, Real mass)
    : CCylinderEntity(id, movable, 0, radius, height, mass)
{
  GetEmbodiedEntity().GetOriginAnchor().Position = position;
  GetEmbodiedEntity().GetOriginAnchor().Orientation = orientation;
}

CLightEntity::CLightEntity(const std::string& id, const CVector3& position, const CColor& colour, Real intensity)
    : CPositionalEntity(nullptr, id, position, CQuaternion()), colour_(colour), intensity_(intensity)
{
}

// The positions are those of the simulated sensors.

namespace
{

void PlaceProximity(const swarmanoid::EntityKindDescription& row, CProximitySensorEquippedEntity& sensors,
                    SAnchor& origin)
{
  for (const auto& sensor : row.proximity->sensors)
    sensors.Place(CVector3(sensor.place.x(), sensor.place.y(), row.proximity->height_m), CRadians(sensor.direction),
                  row.proximity->range_m, origin);
}

}  // namespace

void CFootBotEntity::AddParts()
{
  using Proximity = swarmanoid::CCI_FootBotProximitySensor;
  using Light = swarmanoid::CCI_FootBotLightSensor;
  SAnchor& origin = GetEmbodiedEntity().GetOriginAnchor();
  proximity_.PlaceRing(Light::RING_HEIGHT_M, 0.085, CRadians(Proximity::FIRST_ANGLE), Proximity::RANGE_M,
                       Proximity::NUM_SENSORS, origin);
  light_.PlaceRing(Light::RING_HEIGHT_M, 0.085, CRadians(Light::FIRST_ANGLE), 0.1, Light::NUM_SENSORS, origin);
  for (const auto& place : swarmanoid::CCI_FootBotMotorGroundSensor::PLACES_M)
    ground_.Place(place.x, place.y, CGroundSensorEquippedEntity::TYPE_GRAYSCALE, origin);
  for (const auto& place : swarmanoid::CCI_FootBotBaseGroundSensor::PLACES_M)
    ground_.Place(place.x, place.y, CGroundSensorEquippedEntity::TYPE_BLACK_WHITE, origin);
  AddComponent(wheels_);
  AddComponent(proximity_);
  AddComponent(light_);
  AddComponent(ground_);
}

void CEyeBotEntity::AddParts()
{
  using Light = swarmanoid::CCI_EyeBotLightSensor;
  SAnchor& origin = GetEmbodiedEntity().GetOriginAnchor();
  PlaceProximity(swarmanoid::DescriptionOf(*swarmanoid::KindOfTag("eyebot")), proximity_, origin);
  light_.PlaceRing(Light::RING_HEIGHT_M, 0.255, CRadians(Light::FIRST_ANGLE), 0.1, Light::NUM_SENSORS, origin);
  AddComponent(proximity_);
  AddComponent(light_);
}

void CKheperaIVEntity::AddParts()
{
  SAnchor& origin = GetEmbodiedEntity().GetOriginAnchor();
  const auto& row = swarmanoid::DescriptionOf(*swarmanoid::KindOfTag("argos3_kheperaiv"));
  PlaceProximity(row, proximity_, origin);
  for (const int degrees : {0, 45, 90, -90, -45})
  {
    const CRadians heading = ToRadians(CDegrees(degrees));
    const Real from_axis = row.size.x() + swarmanoid::argos3::kUltrasoundGap;
    ultrasound_.Place(CVector3(from_axis * Cos(heading), from_axis * Sin(heading), 0), heading,
                      swarmanoid::argos3::kUltrasoundReach - swarmanoid::argos3::kUltrasoundGap, origin);
  }
  light_.PlaceRing(row.proximity->height_m, row.size.x(), CRadians(0), row.proximity->range_m, 8, origin);
  for (const auto& place : row.ground_points)
    ground_.Place(place.x(), place.y(), CGroundSensorEquippedEntity::TYPE_GRAYSCALE, origin);
  AddComponent(wheels_);
  AddComponent(proximity_);
  AddComponent(ultrasound_);
  AddComponent(light_);
  AddComponent(ground_);
}

void CEPuckEntity::AddParts()
{
  SAnchor& origin = GetEmbodiedEntity().GetOriginAnchor();
  for (const int degrees : {17, 50, 90, 150, -150, -90, -50, -17})
  {
    const CRadians heading = ToRadians(CDegrees(degrees));
    proximity_.Place(CVector3(0.035 * Cos(heading), 0.035 * Sin(heading), 0.06), heading, 0.1, origin);
  }
  light_.PlaceRing(0.06, 0.035, ToRadians(CDegrees(22.5)), 0.1, 8, origin);
  for (const auto& place : swarmanoid::argos3::kEPuckGround)
    ground_.Place(place.x, place.y, CGroundSensorEquippedEntity::TYPE_GRAYSCALE, origin);
  AddComponent(wheels_);
  AddComponent(proximity_);
  AddComponent(light_);
  AddComponent(ground_);
}

namespace
{

template <class Sensors>
auto& OneOf(const CEntity& entity, const Sensors& sensors, size_t sensor)
{
  if (sensor >= sensors.size())
    THROW_ARGOSEXCEPTION("sensor " << sensor << " of the " << sensors.size() << " of '"
                                   << entity.GetContext() + entity.GetId() << "'; the first one is 0");
  return *sensors[sensor];
}

template <class Place>
void ForRing(Real height, Real radius, const CRadians& first_angle, unsigned sensors, const Place& place)
{
  for (unsigned sensor = 0; sensor < sensors; ++sensor)
  {
    const CRadians heading = first_angle + CRadians(2 * ARGOS_PI * sensor / sensors);
    place(CVector3(radius * Cos(heading), radius * Sin(heading), height), heading);
  }
}

CVector3 Ahead(const CRadians& heading) { return CVector3(Cos(heading), Sin(heading), 0); }

}  // namespace

CProximitySensorEquippedEntity::SSensor& CProximitySensorEquippedEntity::GetSensor(size_t sensor)
{
  return OneOf(*this, sensors_, sensor);
}

void CProximitySensorEquippedEntity::Place(const CVector3& offset, const CRadians& heading, Real range, SAnchor& anchor)
{
  owned_.push_back(std::make_shared<SSensor>(offset, Ahead(heading), range, anchor));
  sensors_.push_back(owned_.back().get());
}

void CProximitySensorEquippedEntity::PlaceRing(Real height, Real radius, const CRadians& first_angle, Real range,
                                               unsigned sensors, SAnchor& anchor)
{
  ForRing(height, radius, first_angle, sensors,
          [&](const CVector3& place, const CRadians& heading) { Place(place, heading, range, anchor); });
}

CLightSensorEquippedEntity::SSensor& CLightSensorEquippedEntity::GetSensor(size_t sensor)
{
  return OneOf(*this, sensors_, sensor);
}

void CLightSensorEquippedEntity::PlaceRing(Real height, Real radius, const CRadians& first_angle, Real range,
                                           unsigned sensors, SAnchor& anchor)
{
  ForRing(height, radius, first_angle, sensors,
          [&](const CVector3& place, const CRadians& heading)
          {
            owned_.push_back(std::make_shared<SSensor>(place, Ahead(heading), range, anchor));
            sensors_.push_back(owned_.back().get());
          });
}

CGroundSensorEquippedEntity::SSensor& CGroundSensorEquippedEntity::GetSensor(size_t sensor)
{
  return OneOf(*this, sensors_, sensor);
}

void CGroundSensorEquippedEntity::Place(Real x, Real y, ESensorType type, SAnchor& anchor)
{
  owned_.push_back(std::make_shared<SSensor>(CVector2(x, y), type, anchor));
  sensors_.push_back(owned_.back().get());
}

Real CPhysicsEngine::tick_s_ = 0.1;

bool CGripperEquippedEntity::IsGripping() const { return Gripped() != nullptr; }

CEmbodiedEntity& CGripperEquippedEntity::GetGrippedEntity() const
{
  if (auto* gripped = Gripped()) return gripped->GetEmbodiedEntity();
  THROW_ARGOSEXCEPTION("'" << const_cast<CGripperEquippedEntity*>(this)->GetRootEntity().GetId() << "' grips nothing");
}

Real CWheeledEntity::GetWheelVelocity(size_t wheel) const
{
  Checked(wheel);
  const std::string& id = const_cast<CWheeledEntity*>(this)->GetRootEntity().GetId();
  const auto found = TheRunning().wheels.find(TheRunning().OurId(id));
  if (found == TheRunning().wheels.end())
    THROW_ARGOSEXCEPTION("the wheels of '" << id << "' are those of its actuator <differential_steering>, which its "
                                           << "controller does not have in this process; add it, and run with "
                                           << "--single-process");
  return (wheel == 0 ? found->second->left : found->second->right) / 100;
}

Real CBatteryEquippedEntity::GetFullCharge() const { return ChargeOf(*this).full; }
Real CBatteryEquippedEntity::GetAvailableCharge() const { return ChargeOf(*this).available; }
void CBatteryEquippedEntity::SetAvailableCharge(Real charge) { ChargeOf(*this).available = charge; }

CBodyEntity* CGripperEquippedEntity::Gripped() const
{
  const auto* ours = OursOf(const_cast<CGripperEquippedEntity&>(*this));
  if (ours == nullptr || swarmanoid::AttributeOffset(ours->GetKind(), "gripped") < 0) return nullptr;
  const double gripped = ours->GetAttribute("gripped");
  if (gripped == 0) return nullptr;
  const auto& held = TheRunning().editor->GetSpace().GetEntity(static_cast<std::size_t>(gripped) - 1);
  return swarmanoid::argos3::TheirBodyOf(held.GetId());
}

}  // namespace argos
