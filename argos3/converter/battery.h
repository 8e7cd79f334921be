// A constant that the converted file and the battery of the plug-in share.
#pragma once

namespace swarmanoid::argos3
{

// Our battery has the capacity of so many batteries of ARGoS3, since loop functions may recharge those.
inline constexpr double kBatteries = 1000;

}  // namespace swarmanoid::argos3
