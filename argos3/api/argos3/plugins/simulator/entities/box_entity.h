// A box, as loop functions see it.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>

namespace argos
{

class CBoxEntity : public CObjectWithLEDs
{
public:
  // Makes a box for AddEntity; the position is the middle of its base. The constructor is defined in the library, since
  // `swarmanoid` finds by its name which libraries make boxes.
  CBoxEntity(const std::string& id, const CVector3& position, const CQuaternion& orientation, bool movable,
             const CVector3& size, Real mass = 1.0);
  // Makes a box for the bridge to the simulator.
  CBoxEntity(const std::string& id, bool movable, unsigned leds, const CVector3& size, Real mass)
      : CObjectWithLEDs(id, movable, leds), size_(size), mass_(mass)
  {
  }
  const CVector3& GetSize() const { return size_; }
  Real GetMass() const { return mass_; }
  // Change the size and the mass before AddEntity. Throw CARGoSException for a box in the arena.
  void Resize(const CVector3& size)
  {
    if (size != size_) RefuseInArena("size");
    size_ = size;
  }
  void SetMass(Real mass)
  {
    if (mass != mass_) RefuseInArena("mass");
    mass_ = mass;
  }
  std::string GetTypeDescription() const override { return "box"; }

private:
  CVector3 size_;
  Real mass_;
};

}  // namespace argos
