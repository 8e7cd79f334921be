// The position of the antenna of range and bearing, for its receivers and for renderers that show the links.
#pragma once

namespace swarmanoid
{

inline constexpr double kAntennaHeight_m = 0.1;  // height above the base of any robot (ARGoS3, foot-bot)

}  // namespace swarmanoid
