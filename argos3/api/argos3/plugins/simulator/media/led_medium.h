// CLEDMedium, which loop functions hand to what they make. Cameras see all LEDs and lights here, whatever their medium.
#pragma once

namespace argos
{

class CLEDMedium
{
};

}  // namespace argos
