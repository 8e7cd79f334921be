// A box, as loop functions see it.
#pragma once

#include <argos3/core/simulator/entity/composable_entity.h>

namespace argos
{

class CBoxEntity : public CObjectWithLEDs
{
public:
  // For AddEntity; the position is the middle of its base. The constructor is defined in the library, since
  // `swarmanoid` finds by its name which libraries make boxes.
  CBoxEntity(const std::string& id, const CVector3& position, const CQuaternion& orientation, bool movable,
             const CVector3& size, Real mass = 1.0);
  // For the bridge to the simulator.
  CBoxEntity(const std::string& id, bool movable, unsigned leds, const CVector3& size, Real mass)
      : CObjectWithLEDs(id, movable, leds), size_(size), mass_(mass)
  {
  }
  const CVector3& GetSize() const { return size_; }
  Real GetMass() const { return mass_; }
  std::string GetTypeDescription() const override { return "box"; }

private:
  CVector3 size_;
  Real mass_;
};

}  // namespace argos
