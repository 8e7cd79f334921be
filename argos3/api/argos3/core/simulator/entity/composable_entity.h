// What is made of parts: bodies, robots.
#pragma once

#include <argos3/core/simulator/entity/controllable_entity.h>
#include <argos3/core/simulator/entity/embodied_entity.h>

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
  explicit CRobotWithController(const std::string& id) : CBodyEntity(id, true), controllable_(this, "controller_0")
  {
    AddComponent(controllable_);
  }
  CControllableEntity& GetControllableEntity() { return controllable_; }

private:
  CControllableEntity controllable_;
};

}  // namespace argos
