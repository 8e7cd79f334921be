// What the converted file and the battery of the plug-in share.
#pragma once

namespace swarmanoid::argos3
{

// Our battery is as large as so many of ARGoS3's, which loop functions may fill again.
inline constexpr double kBatteries = 1000;

}  // namespace swarmanoid::argos3
