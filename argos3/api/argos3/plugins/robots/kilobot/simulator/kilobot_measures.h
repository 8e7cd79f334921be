// The measures of a Kilobot, m.
#pragma once

#include <argos3/core/utility/datatypes/datatypes.h>

namespace argos
{

constexpr Real KILOBOT_BODY_HEIGHT = 0.0127;
constexpr Real KILOBOT_PIN_HEIGHT = 0.0217;
constexpr Real KILOBOT_PIN_RADIUS = 0.0007;
constexpr Real KILOBOT_INTERPIN_DISTANCE = 0.025;
constexpr Real KILOBOT_HALF_INTERPIN_DISTANCE = KILOBOT_INTERPIN_DISTANCE / 2;
constexpr Real KILOBOT_FRONT_PIN_DISTANCE = 0.025;
constexpr Real KILOBOT_RADIUS = 0.0165;
constexpr Real KILOBOT_ECCENTRICITY = 0.0092;
constexpr Real KILOBOT_HEIGHT = KILOBOT_PIN_HEIGHT + KILOBOT_BODY_HEIGHT;
constexpr Real KILOBOT_MASS = 0.01;

}  // namespace argos
