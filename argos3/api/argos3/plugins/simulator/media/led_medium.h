// CLEDMedium, which loop functions hand to what they make. Cameras see all LEDs and lights here, whatever their medium.
#pragma once

namespace argos
{

class CLEDMedium
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
