// The body of an entity.
#pragma once

#include <argos3/core/simulator/entity/positional_entity.h>
#include <argos3/core/simulator/physics_engine/physics_engine.h>
#include <argos3/core/utility/datatypes/set.h>

namespace argos
{

class CEmbodiedEntity;

// A point of a body, which moves with it.
struct SAnchor
{
  std::string Id = "origin";
  UInt32 Index = 0;
  // The position in the frame of the body.
  CVector3 OffsetPosition;
  CQuaternion OffsetOrientation;
  // The position in the arena.
  CVector3 Position;
  CQuaternion Orientation;
  UInt32 InUseCount = 0;

  void Enable() { ++InUseCount; }
  void Disable()
  {
    if (InUseCount > 0) --InUseCount;
  }
};

// The box around a body, along the axes of the arena.
struct SBoundingBox
{
  CVector3 MinCorner;
  CVector3 MaxCorner;
  bool Intersects(const SBoundingBox& other) const
  {
    return MinCorner < other.MaxCorner && other.MinCorner < MaxCorner;
  }
};

// A body in its engine, for reading.
class CPhysicsModel
{
public:
  CPhysicsModel(CPhysicsEngine& engine, CEmbodiedEntity& body) : engine_(&engine), body_(&body) {}
  CPhysicsEngine& GetEngine() { return *engine_; }
  const CPhysicsEngine& GetEngine() const { return *engine_; }
  CEmbodiedEntity& GetEmbodiedEntity() { return *body_; }
  const CEmbodiedEntity& GetEmbodiedEntity() const { return *body_; }
  // Return the values of the body.
  const SBoundingBox& GetBoundingBox() const;
  bool IsCollidingWithSomething() const;
  // Does nothing, since the body is updated after each step.
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
  // Handle anchors that are added here; robots have only their origin. Throw CARGoSException for an id that exists
  // already, and for one that does not exist.
  SAnchor& AddAnchor(const std::string& id, const CVector3& position = CVector3(),
                     const CQuaternion& orientation = CQuaternion());
  SAnchor& GetAnchor(const std::string& id);
  const SAnchor& GetAnchor(const std::string& id) const { return const_cast<CEmbodiedEntity*>(this)->GetAnchor(id); }
  void EnableAnchor(const std::string& id) { GetAnchor(id).Enable(); }
  void DisableAnchor(const std::string& id) { GetAnchor(id).Disable(); }
  bool IsAnchorEnabled(const std::string& id) { return GetAnchor(id).InUseCount > 0; }
  // Updates the anchors; called when the body moves.
  void UpdateAnchors();
  // Returns the box in the latest step. Throws CARGoSException outside loop functions.
  const SBoundingBox& GetBoundingBox() const;
  // Returns 1, since one engine has all bodies and accepts any name. GetPhysicsModel throws CARGoSException for another
  // number than 0.
  UInt32 GetPhysicsModelsNum() const { return 1; }
  CPhysicsModel& GetPhysicsModel(size_t number);
  CPhysicsModel& GetPhysicsModel(const std::string& engine);
  const CPhysicsModel& GetPhysicsModel(size_t number) const
  {
    return const_cast<CEmbodiedEntity*>(this)->GetPhysicsModel(number);
  }
  // Moves the entity, if it is movable, to where it was added to the arena.
  void Reset() override;
  // These are names of versions before 2014.
  const CVector3& GetPosition() const { return m_sOriginAnchor.Position; }
  const CQuaternion& GetOrientation() const { return m_sOriginAnchor.Orientation; }
  // Moves the entity, as MoveEntity of the loop functions.
  bool MoveTo(const CVector3& position, const CQuaternion& orientation, bool check_only = false,
              bool ignore_collisions = false);
  // Returns whether another body overlaps it at its place.
  bool IsCollidingWithSomething() const;
  std::string GetTypeDescription() const override { return "body"; }

protected:
  SAnchor m_sOriginAnchor;
  bool movable_;
  std::map<std::string, SAnchor> anchors_;  // except the origin
  mutable SBoundingBox box_;
  std::vector<CPhysicsModel> models_;  // one, after the first request
};

using TEmbodiedEntityVector = std::vector<CEmbodiedEntity*>;
using TEmbodiedEntityMap = std::map<std::string, CEmbodiedEntity*>;
using TEmbodiedEntitySet = CSet<CEmbodiedEntity*, SEntityComparator>;

}  // namespace argos
