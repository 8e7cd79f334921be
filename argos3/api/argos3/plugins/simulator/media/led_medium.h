// CLEDMedium, which loop functions pass to entities that they make. Cameras see all LEDs and lights, whatever their
// medium.
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
