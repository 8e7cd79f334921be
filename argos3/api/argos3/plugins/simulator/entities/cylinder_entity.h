// A cylinder, as loop functions see it.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>

namespace argos
{

class CCylinderEntity : public CObjectWithLEDs
{
public:
  // Makes a cylinder for AddEntity, as the constructor of CBoxEntity.
  CCylinderEntity(const std::string& id, const CVector3& position, const CQuaternion& orientation, bool movable,
                  Real radius, Real height, Real mass = 1.0);
  // Makes a cylinder for the bridge to the simulator.
  CCylinderEntity(const std::string& id, bool movable, unsigned leds, Real radius, Real height, Real mass)
      : CObjectWithLEDs(id, movable, leds), radius_(radius), height_(height), mass_(mass)
  {
  }
  Real GetRadius() const { return radius_; }
  Real GetHeight() const { return height_; }
  Real GetMass() const { return mass_; }
  // Change the size and the mass, as those of CBoxEntity.
  void Resize(Real radius, Real height)
  {
    if (radius != radius_ || height != height_) RefuseInArena("size");
    radius_ = radius;
    height_ = height;
  }
  void SetMass(Real mass)
  {
    if (mass != mass_) RefuseInArena("mass");
    mass_ = mass;
  }
  std::string GetTypeDescription() const override { return "cylinder"; }

private:
  Real radius_;
  Real height_;
  Real mass_;
};

}  // namespace argos
