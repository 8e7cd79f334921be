// What is made of parts: bodies, robots.
#pragma once

#include <memory>

#include <argos3/core/simulator/entity/controllable_entity.h>
#include <argos3/core/simulator/entity/embodied_entity.h>
#include <argos3/core/utility/datatypes/color.h>
#include <argos3/plugins/simulator/entities/rab_equipped_entity.h>

namespace argos
{

class CComposableEntity : public CEntity
{
public:
  explicit CComposableEntity(const std::string& id) : CEntity(nullptr, id) {}

  bool HasComponent(const std::string& name) { return components_.count(name) != 0; }
  // Throws CARGoSException for a part that it does not have.
  template <class Entity>
  Entity& GetComponent(const std::string& name)
  {
    const auto found = components_.find(name);
    auto* typed = found == components_.end() ? nullptr : dynamic_cast<Entity*>(found->second);
    if (typed == nullptr) THROW_ARGOSEXCEPTION("entity '" << GetId() << "' has no component '" << name << "'");
    return *typed;
  }
  CEntity::TMap& GetComponentMap() { return components_; }
  void AddComponent(CEntity& component) { components_[component.GetTypeDescription()] = &component; }
  std::string GetTypeDescription() const override { return "composite"; }

private:
  CEntity::TMap components_;
};

// An LED of an entity.
class CLEDEntity : public CEntity
{
public:
  CLEDEntity(CEntity* parent, unsigned number) : CEntity(parent, "led_" + std::to_string(number)), number_(number) {}
  // As it is in the arena; before AddEntity, and where no loop functions run, black.
  CColor GetColor() const;
  // Throws CARGoSException outside loop functions, and for an LED that the entity does not have.
  void SetColor(const CColor& colour);
  std::string GetTypeDescription() const override { return "led"; }

private:
  unsigned number_;
};

// The LEDs of an entity. A cylinder with LEDs has one colour: all of them are one LED here.
class CLEDEquippedEntity : public CEntity
{
public:
  CLEDEquippedEntity(CEntity* parent, unsigned leds);
  size_t GetNumLEDs() const { return leds_.size(); }
  // These throw CARGoSException for an LED beyond the last one, another number of colours, and as CLEDEntity.
  CLEDEntity& GetLED(UInt32 led);
  void SetLEDColor(UInt32 led, const CColor& colour) { GetLED(led).SetColor(colour); }
  void SetAllLEDsColors(const CColor& colour);
  void SetAllLEDsColors(const std::vector<CColor>& colours);
  void Update() {}
  std::string GetTypeDescription() const override { return "leds"; }

private:
  std::vector<std::unique_ptr<CLEDEntity>> leds_;
};

// A box, a cylinder, a robot: it has a body.
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

class CRobotWithController : public CBodyEntity
{
public:
  CRobotWithController(const std::string& id, unsigned leds);
  CControllableEntity& GetControllableEntity() { return controllable_; }
  const CControllableEntity& GetControllableEntity() const { return controllable_; }
  CLEDEquippedEntity& GetLEDEquippedEntity() { return leds_; }
  CRABEquippedEntity& GetRABEquippedEntity() { return rab_; }
  // Of a robot that loop functions made: the id of its controller in the experiment file.
  const std::string& ControllerOfMade() const { return controller_; }

protected:
  // Made by loop functions, for AddEntity.
  CRobotWithController(const std::string& id, unsigned leds, const std::string& controller, const CVector3& position,
                       const CQuaternion& orientation);

private:
  CControllableEntity controllable_;
  CLEDEquippedEntity leds_;
  CRABEquippedEntity rab_;
  std::string controller_;
};

}  // namespace argos
