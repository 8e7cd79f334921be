// CPositionalEntity: an entity with a position.
#pragma once

#include <argos3/core/simulator/entity/entity.h>

namespace argos
{

class CPositionalEntity : public CEntity
{
public:
  using CEntity::CEntity;
  CPositionalEntity(CEntity* parent, const std::string& id, const CVector3& position, const CQuaternion& orientation)
      : CEntity(parent, id), m_cPosition(position), m_cOrientation(orientation)
  {
  }
  // Returns the position in the arena, m.
  virtual const CVector3& GetPosition() const { return m_cPosition; }
  // Returns the orientation in the arena.
  virtual const CQuaternion& GetOrientation() const { return m_cOrientation; }
  // Changes only this view; CLoopFunctions::MoveEntity moves an entity.
  void SetPosition(const CVector3& position) { m_cPosition = position; }
  void SetOrientation(const CQuaternion& orientation) { m_cOrientation = orientation; }
  // Moves the entity, as MoveEntity of the loop functions.
  void MoveTo(const CVector3& position, const CQuaternion& orientation);
  std::string GetTypeDescription() const override { return "position"; }

protected:
  mutable CVector3 m_cPosition;
  CQuaternion m_cOrientation;
};

}  // namespace argos
