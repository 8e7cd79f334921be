// Where the antenna of range and bearing is, for its receivers and for renderers that show who hears whom.
#pragma once

namespace swarmanoid
{

inline constexpr double kAntennaHeight_m = 0.1;  // above the base of any robot (ARGoS3, foot-bot)

}  // namespace swarmanoid
