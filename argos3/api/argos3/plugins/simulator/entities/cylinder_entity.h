// A cylinder, as loop functions see it.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>

namespace argos
{

class CCylinderEntity : public CObjectWithLEDs
{
public:
  // For AddEntity, as the constructor of CBoxEntity.
  CCylinderEntity(const std::string& id, const CVector3& position, const CQuaternion& orientation, bool movable,
                  Real radius, Real height, Real mass = 1.0);
  // For the bridge to the simulator.
  CCylinderEntity(const std::string& id, bool movable, unsigned leds, Real radius, Real height, Real mass)
      : CObjectWithLEDs(id, movable, leds), radius_(radius), height_(height), mass_(mass)
  {
  }
  Real GetRadius() const { return radius_; }
  Real GetHeight() const { return height_; }
  Real GetMass() const { return mass_; }
  std::string GetTypeDescription() const override { return "cylinder"; }

private:
  Real radius_;
  Real height_;
  Real mass_;
};

}  // namespace argos
