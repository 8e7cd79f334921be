// The body of an entity.
#pragma once

#include <argos3/core/simulator/entity/positional_entity.h>
#include <argos3/core/simulator/physics_engine/physics_engine.h>
#include <argos3/core/utility/datatypes/set.h>

namespace argos
{

class CEmbodiedEntity;

// A place on a body, which goes with it.
struct SAnchor
{
  std::string Id = "origin";
  UInt32 Index = 0;
  // In the frame of the body.
  CVector3 OffsetPosition;
  CQuaternion OffsetOrientation;
  // In the arena.
  CVector3 Position;
  CQuaternion Orientation;
  UInt32 InUseCount = 0;

  void Enable() { ++InUseCount; }
  void Disable()
  {
    if (InUseCount > 0) --InUseCount;
  }
};

// Around a body, along the axes of the arena.
struct SBoundingBox
{
  CVector3 MinCorner;
  CVector3 MaxCorner;
  bool Intersects(const SBoundingBox& other) const
  {
    return MinCorner < other.MaxCorner && other.MinCorner < MaxCorner;
  }
};

// A body in its engine, to look at.
class CPhysicsModel
{
public:
  CPhysicsModel(CPhysicsEngine& engine, CEmbodiedEntity& body) : engine_(&engine), body_(&body) {}
  CPhysicsEngine& GetEngine() { return *engine_; }
  const CPhysicsEngine& GetEngine() const { return *engine_; }
  CEmbodiedEntity& GetEmbodiedEntity() { return *body_; }
  const CEmbodiedEntity& GetEmbodiedEntity() const { return *body_; }
  // As those of the body.
  const SBoundingBox& GetBoundingBox() const;
  bool IsCollidingWithSomething() const;
  // The body tells of itself after each step.
  void UpdateEntityStatus() {}

private:
  CPhysicsEngine* engine_;
  CEmbodiedEntity* body_;
};

class CEmbodiedEntity : public CEntity
{
public:
  CEmbodiedEntity(CEntity* parent, const std::string& id, bool movable) : CEntity(parent, id), movable_(movable) {}

  bool IsMovable() const { return movable_; }
  const SAnchor& GetOriginAnchor() const { return m_sOriginAnchor; }
  SAnchor& GetOriginAnchor() { return m_sOriginAnchor; }
  // Of anchors that are added here: robots bring only their origin. Throw CARGoSException for an id that there is
  // already, and for one that there is not.
  SAnchor& AddAnchor(const std::string& id, const CVector3& position = CVector3(),
                     const CQuaternion& orientation = CQuaternion());
  SAnchor& GetAnchor(const std::string& id);
  const SAnchor& GetAnchor(const std::string& id) const { return const_cast<CEmbodiedEntity*>(this)->GetAnchor(id); }
  void EnableAnchor(const std::string& id) { GetAnchor(id).Enable(); }
  void DisableAnchor(const std::string& id) { GetAnchor(id).Disable(); }
  bool IsAnchorEnabled(const std::string& id) { return GetAnchor(id).InUseCount > 0; }
  // Puts them where the body is; called when it moves.
  void UpdateAnchors();
  // In the latest step. Throws CARGoSException outside loop functions.
  const SBoundingBox& GetBoundingBox() const;
  // One engine has all bodies; it goes by each name. Throws CARGoSException for another number.
  UInt32 GetPhysicsModelsNum() const { return 1; }
  CPhysicsModel& GetPhysicsModel(size_t number);
  CPhysicsModel& GetPhysicsModel(const std::string& engine);
  const CPhysicsModel& GetPhysicsModel(size_t number) const
  {
    return const_cast<CEmbodiedEntity*>(this)->GetPhysicsModel(number);
  }
  // To where it came into the arena, if it can move.
  void Reset() override;
  // The names of versions before 2014.
  const CVector3& GetPosition() const { return m_sOriginAnchor.Position; }
  const CQuaternion& GetOrientation() const { return m_sOriginAnchor.Orientation; }
  // As MoveEntity of the loop functions.
  bool MoveTo(const CVector3& position, const CQuaternion& orientation, bool check_only = false,
              bool ignore_collisions = false);
  // Whether another body overlaps it where it stands.
  bool IsCollidingWithSomething() const;
  std::string GetTypeDescription() const override { return "body"; }

protected:
  SAnchor m_sOriginAnchor;
  bool movable_;
  std::map<std::string, SAnchor> anchors_;  // but the origin
  mutable SBoundingBox box_;
  std::vector<CPhysicsModel> models_;  // one, once it was asked for
};

using TEmbodiedEntityVector = std::vector<CEmbodiedEntity*>;
using TEmbodiedEntityMap = std::map<std::string, CEmbodiedEntity*>;
using TEmbodiedEntitySet = CSet<CEmbodiedEntity*, SEntityComparator>;

}  // namespace argos
