// The floor, coloured by loop functions.
#pragma once

#include <argos3/core/simulator/entity/entity.h>
#include <argos3/core/utility/datatypes/color.h>

namespace argos
{

class CFloorEntity : public CEntity
{
public:
  using CEntity::CEntity;
  // What GetFloorColor of the loop functions says.
  CColor GetColorAtPoint(Real x, Real y);
  // Sensors ask for the colours of this step anyway.
  void SetChanged() {}
  void ClearChanged() {}
  bool HasChanged() const { return false; }
  std::string GetTypeDescription() const override { return "floor"; }
};

}  // namespace argos
