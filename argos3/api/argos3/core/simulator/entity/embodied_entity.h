// The body of an entity.
#pragma once

#include <argos3/core/simulator/entity/positional_entity.h>

namespace argos
{

class CEmbodiedEntity;

struct SAnchor
{
  std::string Id = "origin";
  CVector3 Position;
  CQuaternion Orientation;
};

class CEmbodiedEntity : public CEntity
{
public:
  CEmbodiedEntity(CEntity* parent, const std::string& id, bool movable) : CEntity(parent, id), movable_(movable) {}

  bool IsMovable() const { return movable_; }
  const SAnchor& GetOriginAnchor() const { return m_sOriginAnchor; }
  SAnchor& GetOriginAnchor() { return m_sOriginAnchor; }
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
};

}  // namespace argos
