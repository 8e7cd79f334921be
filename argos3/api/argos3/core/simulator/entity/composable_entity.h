// Entities that have parts: bodies and robots.
#pragma once

#include <memory>

#include <argos3/core/simulator/entity/controllable_entity.h>
#include <argos3/core/simulator/entity/embodied_entity.h>
#include <argos3/core/utility/datatypes/color.h>
#include <argos3/plugins/simulator/entities/rab_equipped_entity.h>
#include <argos3/plugins/simulator/media/led_medium.h>

namespace argos
{

class CComposableEntity : public CEntity
{
public:
  explicit CComposableEntity(const std::string& id) : CEntity(nullptr, id) {}
  CComposableEntity(CEntity* parent, const std::string& id) : CEntity(parent, id) {}

  // Returns whether the entity has a component. `name` is a type ("body"), one of several by its id ("led[led_3]"), or
  // a part of a part ("leds.led[led_3]").
  bool HasComponent(const std::string& name) { return Find(name) != nullptr; }
  // Throw CARGoSException for a part that does not exist.
  CEntity& GetComponent(const std::string& name);
  template <class Entity>
  Entity& GetComponent(const std::string& name)
  {
    auto* typed = dynamic_cast<Entity*>(&GetComponent(name));
    if (typed == nullptr)
      THROW_ARGOSEXCEPTION("the component '" << name << "' of '" << GetId() << "' is of another type");
    return *typed;
  }
  CEntity::TMultiMap& GetComponentMap() { return components_; }
  CEntity::TVector& GetComponentVector() { return in_order_; }
  void AddComponent(CEntity& component)
  {
    components_.emplace(component.GetTypeDescription(), &component);
    in_order_.push_back(&component);
  }
  void UpdateComponents() {}
  // Enables or disables the entity with all its components.
  void SetEnabled(bool enabled) override
  {
    CEntity::SetEnabled(enabled);
    for (CEntity* component : in_order_) component->SetEnabled(enabled);
  }
  void Reset() override
  {
    for (const auto& component : components_) component.second->Reset();
  }
  std::string GetTypeDescription() const override { return "composite"; }

private:
  CEntity* Find(const std::string& name);

  CEntity::TMultiMap components_;
  CEntity::TVector in_order_;
};

// An LED of an entity.
class CLEDEntity : public CEntity
{
public:
  CLEDEntity(CEntity* parent, unsigned number, const CColor& colour = CColor::BLACK)
      : CEntity(parent, "led_" + std::to_string(number)), number_(number), first_colour_(colour)
  {
  }
  // Returns the colour in the arena. Before AddEntity, and in a process without loop functions, it is the initial
  // colour.
  CColor GetColor() const;
  // Sets the colour. Before AddEntity it is the colour with which the entity is added. Throws CARGoSException outside
  // loop functions, and for an LED that the entity does not have.
  void SetColor(const CColor& colour);
  // Sets the colour with which the entity was added to the arena.
  void Reset() override;
  const CColor& GetInitColor() const { return first_colour_; }
  void SetInitColor(const CColor& colour) { first_colour_ = colour; }
  // Cameras see all LEDs, whatever their medium.
  void AddToMedium(CLEDMedium&) {}
  void RemoveFromMedium() {}
  void SetMedium(CLEDMedium&) {}
  std::string GetTypeDescription() const override { return "led"; }

private:
  unsigned number_;
  CColor first_colour_;
};

// The LEDs of an entity. The LEDs of a box or cylinder have one colour, which cameras see at its middle: the one that
// was set last, and at first that of the first LED.
class CLEDEquippedEntity : public CComposableEntity
{
public:
  CLEDEquippedEntity(CEntity* parent, unsigned leds);
  void Reset() override
  {
    for (const auto& led : leds_) led->Reset();
  }
  size_t GetNumLEDs() const { return leds_.size(); }
  // Adds an LED to a box or cylinder. The positions have no effect.
  void AddLED(const CVector3& offset, const SAnchor& anchor, const CColor& colour = CColor::BLACK);
  void AddLEDRing(const CVector3& centre, Real radius, const CRadians& first_angle, UInt32 leds, const SAnchor& anchor,
                  const CColor& colour = CColor::BLACK);
  void AddToMedium(CLEDMedium&) {}
  void RemoveFromMedium() {}
  void SetMedium(CLEDMedium&) {}
  // Throw CARGoSException for an LED beyond the last one, for a wrong number of colours, and as CLEDEntity.
  CLEDEntity& GetLED(UInt32 led);
  void SetLEDColor(UInt32 led, const CColor& colour) { GetLED(led).SetColor(colour); }
  void SetAllLEDsColors(const CColor& colour);
  void SetAllLEDsColors(const std::vector<CColor>& colours);
  std::string GetTypeDescription() const override { return "leds"; }

private:
  std::vector<std::shared_ptr<CLEDEntity>> leds_;  // shared with copies
};

// An entity with a body: a box, a cylinder or a robot.
class CBodyEntity : public CComposableEntity
{
public:
  CBodyEntity(const std::string& id, bool movable) : CComposableEntity(id), body_(this, "body_0", movable)
  {
    AddComponent(body_);
  }
  CEmbodiedEntity& GetEmbodiedEntity() { return body_; }
  const CEmbodiedEntity& GetEmbodiedEntity() const { return body_; }

private:
  CEmbodiedEntity body_;
};

// A box or a cylinder, which may have LEDs. A copy shares the state of the original.
class CObjectWithLEDs : public CBodyEntity
{
public:
  CObjectWithLEDs(const std::string& id, bool movable, unsigned leds) : CBodyEntity(id, movable), leds_(this, leds)
  {
    AddComponent(leds_);
  }
  CLEDEquippedEntity& GetLEDEquippedEntity() { return leds_; }
  const CLEDEquippedEntity& GetLEDEquippedEntity() const { return leds_; }
  void AddLED(const CVector3& offset, const CColor& colour = CColor::BLACK)
  {
    leds_.AddLED(offset, GetEmbodiedEntity().GetOriginAnchor(), colour);
  }
  void EnableLEDs(CLEDMedium&) {}
  void DisableLEDs() { leds_.SetAllLEDsColors(CColor::BLACK); }

protected:
  // Throws CARGoSException for an object in the arena. `what`: size or mass.
  void RefuseInArena(const char* what) const
  {
    if (GetIndex() >= 0)
      THROW_ARGOSEXCEPTION("the " << what << " of '" << GetId() << "' is fixed while it is in the arena; remove it and "
                                  << "add another one by AddEntity");
  }

private:
  CLEDEquippedEntity leds_;
};

// The gripper of a robot. A copy shares the state of the original.
class CGripperEquippedEntity : public CEntity
{
public:
  explicit CGripperEquippedEntity(CEntity* parent) : CEntity(parent, "gripper_0") {}
  // Returns false outside loop functions, and for a robot without a gripper.
  bool IsGripping() const;
  // Throws CARGoSException if it grips nothing.
  CEmbodiedEntity& GetGrippedEntity() const;
  std::string GetTypeDescription() const override { return "gripper"; }

private:
  CBodyEntity* Gripped() const;
};

// The battery of a robot. The functions throw CARGoSException for a robot without the sensor <battery>, and if its
// controller is not in this process.
class CBatteryEquippedEntity : public CEntity
{
public:
  explicit CBatteryEquippedEntity(CEntity* parent) : CEntity(parent, "battery_0") {}
  Real GetFullCharge() const;
  Real GetAvailableCharge() const;
  void SetAvailableCharge(Real charge);
  // Sets the charge of the experiment file. It does nothing for a robot without the sensor.
  void Reset() override;
  std::string GetTypeDescription() const override { return "battery"; }
};

// The two wheels of a robot: 0 on the left, 1 on the right.
class CWheeledEntity : public CEntity
{
public:
  CWheeledEntity(CEntity* parent, Real axle, Real radius) : CEntity(parent, "wheels_0"), radius_(radius)
  {
    positions_[0].Set(0, axle / 2, 0);
    positions_[1].Set(0, -axle / 2, 0);
  }
  size_t GetNumWheels() const { return 2; }
  // Positions are in m, in the frame of the robot. The functions throw CARGoSException for a wheel beyond the second
  // one.
  const CVector3& GetWheelPosition(size_t wheel) const { return positions_[Checked(wheel)]; }
  Real GetWheelRadius(size_t wheel) const
  {
    Checked(wheel);
    return radius_;
  }
  // Returns m/s on the ground, as the controller commanded it; 0 before the first command. Throws CARGoSException for a
  // robot without the actuator differential_steering, and if its controller is not in this process.
  Real GetWheelVelocity(size_t wheel) const;
  std::string GetTypeDescription() const override { return "wheels"; }

private:
  static size_t Checked(size_t wheel)
  {
    if (wheel > 1) THROW_ARGOSEXCEPTION("wheel " << wheel << " of 2; the first one is 0");
    return wheel;
  }

  CVector3 positions_[2];
  Real radius_;
};

class CRobotWithController : public CBodyEntity
{
public:
  CRobotWithController(const std::string& id, unsigned leds);
  CControllableEntity& GetControllableEntity() { return controllable_; }
  const CControllableEntity& GetControllableEntity() const { return controllable_; }
  CLEDEquippedEntity& GetLEDEquippedEntity() { return leds_; }
  CRABEquippedEntity& GetRABEquippedEntity() { return rab_; }
  CGripperEquippedEntity& GetGripperEquippedEntity() { return gripper_; }
  CBatteryEquippedEntity& GetBatterySensorEquippedEntity() { return battery_; }
  // Returns the id in the experiment file of the controller of a robot that loop functions made.
  const std::string& ControllerOfMade() const { return controller_; }

protected:
  // Loop functions make it for AddEntity.
  CRobotWithController(const std::string& id, unsigned leds, const std::string& controller, const CVector3& position,
                       const CQuaternion& orientation);

private:
  CControllableEntity controllable_;
  CLEDEquippedEntity leds_;
  CRABEquippedEntity rab_;
  CGripperEquippedEntity gripper_;
  CBatteryEquippedEntity battery_;
  std::string controller_;
};

}  // namespace argos
