// The floor, whose colours loop functions give.
#pragma once

#include <argos3/core/simulator/entity/entity.h>
#include <argos3/core/utility/datatypes/color.h>

namespace argos
{

class CFloorEntity : public CEntity
{
public:
  using CEntity::CEntity;
  // Returns the result of GetFloorColor of the loop functions.
  CColor GetColorAtPoint(Real x, Real y);
  // Does nothing, since sensors read the colours in each step.
  void SetChanged() {}
  void ClearChanged() {}
  bool HasChanged() const { return false; }
  std::string GetTypeDescription() const override { return "floor"; }
};

}  // namespace argos
