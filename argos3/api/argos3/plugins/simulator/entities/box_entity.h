// A box, as loop functions see it.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>

namespace argos
{

class CBoxEntity : public CBodyEntity
{
public:
  CBoxEntity(const std::string& id, const CVector3& position, const CQuaternion& orientation, bool movable,
             const CVector3& size, Real mass = 1.0)
      : CBodyEntity(id, movable), size_(size), mass_(mass)
  {
    GetEmbodiedEntity().GetOriginAnchor().Position = position;
    GetEmbodiedEntity().GetOriginAnchor().Orientation = orientation;
  }
  const CVector3& GetSize() const { return size_; }
  Real GetMass() const { return mass_; }
  std::string GetTypeDescription() const override { return "box"; }

private:
  CVector3 size_;
  Real mass_;
};

}  // namespace argos
