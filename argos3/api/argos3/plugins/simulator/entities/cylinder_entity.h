// A cylinder, as loop functions see it.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>

namespace argos
{

class CCylinderEntity : public CBodyEntity
{
public:
  CCylinderEntity(const std::string& id, const CVector3& position, const CQuaternion& orientation, bool movable,
                  Real radius, Real height, Real mass = 1.0)
      : CBodyEntity(id, movable), leds_(this, 1), radius_(radius), height_(height), mass_(mass)
  {
    GetEmbodiedEntity().GetOriginAnchor().Position = position;
    GetEmbodiedEntity().GetOriginAnchor().Orientation = orientation;
  }
  CLEDEquippedEntity& GetLEDEquippedEntity() { return leds_; }
  Real GetRadius() const { return radius_; }
  Real GetHeight() const { return height_; }
  Real GetMass() const { return mass_; }
  std::string GetTypeDescription() const override { return "cylinder"; }

private:
  CLEDEquippedEntity leds_;
  Real radius_;
  Real height_;
  Real mass_;
};

}  // namespace argos
