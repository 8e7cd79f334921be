// A light, as loop functions see it.
#pragma once

#include <argos3/core/simulator/entity/positional_entity.h>
#include <argos3/core/utility/datatypes/color.h>
#include <argos3/plugins/simulator/media/led_medium.h>

namespace argos
{

class CLightEntity : public CPositionalEntity
{
public:
  // The constructor is defined in the library, since `swarmanoid` finds by its name which libraries make lights.
  CLightEntity(const std::string& id, const CVector3& position, const CColor& colour, Real intensity);
  // Makes a light without a position, for controllers that keep their own light.
  CLightEntity() : CPositionalEntity(nullptr, "", CVector3(), CQuaternion()), intensity_(0) {}
  // Restores the position and colour with which it was added to the arena.
  void Reset() override;
  const CColor& GetColor() const { return colour_; }
  void SetColor(const CColor& colour);
  void SetMedium(CLEDMedium&) {}
  void AddToMedium(CLEDMedium&) {}
  void RemoveFromMedium() {}
  Real GetIntensity() const { return intensity_; }
  // Throws CARGoSException for a number that is negative or not finite.
  void SetIntensity(Real intensity);
  std::string GetTypeDescription() const override { return "light"; }

private:
  CColor colour_;
  Real intensity_;
};

}  // namespace argos
