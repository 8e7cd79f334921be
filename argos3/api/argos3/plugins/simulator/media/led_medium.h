// CLEDMedium, which loop functions hand to what they make. Cameras see all LEDs and lights here, whatever their medium.
#pragma once

#include <argos3/core/simulator/medium/medium.h>

namespace argos
{

class CLEDMedium : public CMedium
{
public:
  template <class Led>
  void AddEntity(Led&)
  {
  }
  template <class Led>
  void RemoveEntity(Led&)
  {
  }
};

}  // namespace argos
