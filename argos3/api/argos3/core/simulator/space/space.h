// CSpace: the entities, as loop functions see them.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>
#include <argos3/core/simulator/entity/floor_entity.h>
#include <argos3/core/utility/datatypes/any.h>
#include <argos3/core/utility/math/range.h>

#include <functional>

namespace argos
{

class CSpace
{
public:
  using TMapPerType = std::map<std::string, CAny, std::less<std::string>>;
  using TControllableEntityIterCBType = std::function<void(CControllableEntity*)>;
  using TMapPerTypePerId = std::map<std::string, TMapPerType, std::less<std::string>>;

  UInt32 GetNumberEntities() const { return static_cast<UInt32>(entities_.size()); }
  CEntity::TVector& GetEntityVector() { return entities_; }
  CEntity::TVector& GetRootEntityVector() { return entities_; }
  CEntity::TMap& GetEntityMapPerId() { return by_id_; }
  TMapPerTypePerId& GetEntityMapPerTypePerId() { return by_type_; }
  // Throw CARGoSException for an unknown id, a type without entities, and an arena without a floor.
  CEntity& GetEntity(const std::string& id);
  TMapPerType& GetEntitiesByType(const std::string& type);
  CFloorEntity& GetFloorEntity();
  // Finds the entities whose ids match `pattern`, a regular expression.
  void GetEntitiesMatching(CEntity::TVector& found, const std::string& pattern);
  // Calls a function for each robot in the arena, one after the other.
  void IterateOverControllableEntities(const TControllableEntityIterCBType& call)
  {
    for (CEntity* entity : entities_)
      if (auto* robot = dynamic_cast<CRobotWithController*>(entity)) call(&robot->GetControllableEntity());
  }

  // Returns the ticks: 1 in the first step.
  UInt32 GetSimulationClock() const { return clock_; }
  const CVector3& GetArenaSize() const { return size_; }
  const CVector3& GetArenaCenter() const { return center_; }
  CRange<CVector3> GetArenaLimits() const { return {center_ - size_ / 2, center_ + size_ / 2}; }
  // Resets the entities of the arena to their state when they were added, with their parts, devices and controllers,
  // and the clock to 0. Added entities stay, and removed ones stay away. For loop functions in a run of one process.
  // Throws CARGoSException, and resets nothing, if one of their controllers is in another process.
  void Reset();

  // These functions are for the bridge that fills the space.
  void SetSimulationClock(UInt32 clock) { clock_ = clock; }
  void SetArena(const CVector3& size, const CVector3& center)
  {
    size_ = size;
    center_ = center;
  }
  void SetFloor(CFloorEntity* floor) { floor_ = floor; }
  void Clear();
  // Adds an entity by its type, with its parts; other types are left out.
  void InsertAny(CEntity& entity);
  template <class Entity>
  void Insert(Entity& entity)
  {
    entity.SetIndex(static_cast<ssize_t>(entities_.size()));
    entities_.push_back(&entity);
    by_id_[entity.GetId()] = &entity;
    by_type_[entity.GetTypeDescription()][entity.GetId()] = CAny(&entity);
  }
  // Adds a component, which is listed only by its type.
  template <class Component>
  void InsertComponent(const std::string& owner, Component& component)
  {
    by_type_[component.GetTypeDescription()][owner + "." + component.GetId()] = CAny(&component);
  }

private:
  UInt32 clock_ = 0;
  CVector3 size_;
  CVector3 center_;
  CEntity::TVector entities_;
  CEntity::TMap by_id_;
  TMapPerTypePerId by_type_;
  CFloorEntity* floor_ = nullptr;
};

}  // namespace argos
