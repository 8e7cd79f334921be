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
  // Defined in the library: `swarmanoid` tells by its name among those that a library asks for that it makes lights.
  CLightEntity(const std::string& id, const CVector3& position, const CColor& colour, Real intensity);
  // One that is nowhere: for controllers that keep a light of their own.
  CLightEntity() : CPositionalEntity(nullptr, "", CVector3(), CQuaternion()), intensity_(0) {}
  // To the place and colour with which it came into the arena.
  void Reset() override;
  const CColor& GetColor() const { return colour_; }
  void SetColor(const CColor& colour);
  void SetMedium(CLEDMedium&) {}
  void AddToMedium(CLEDMedium&) {}
  void RemoveFromMedium() {}
  Real GetIntensity() const { return intensity_; }
  // Throws CARGoSException for a number that is not finite or below 0.
  void SetIntensity(Real intensity);
  std::string GetTypeDescription() const override { return "light"; }

private:
  CColor colour_;
  Real intensity_;
};

}  // namespace argos
