// The parameters of radios that share a channel (controller_host/devices/radio/shared_channel.h).
#pragma once

#include <string>
#include <vector>

#include "common/configuration/parameter.h"

namespace swarmanoid
{

// `range_m` is the default of the range.
inline std::vector<ParameterSpec> SharedChannelParameters(const std::string& range_m)
{
  using enum ParameterType;
  return {
      {"range", kNumber, "m", range_m, "Distance at which a packet is just strong enough, if there is no shadowing.",
       0.001, 1e6},
      {"path_loss", kNumber, "", "2",
       "Exponent with which the power falls with the distance; 2: free field, 2.7 to 5: buildings and towns.", 1, 10},
      {"shadowing", kNumber, "dB", "0",
       "Deviation of the normal number by which each link is stronger or weaker, the same in both directions and "
       "all ticks.",
       0, 30},
      {"capture", kNumber, "dB", "10",
       "Ratio of a packet to the sum of all others in its slot from which it is received nevertheless; 1000: never.", 0,
       1000},
      {"slots", kInteger, "", "1",
       "Slots of a tick. Each packet takes one at random, and only packets in one slot collide.", 1, 1e6},
      {"loss_probability", kNumber, "", "0", "Share of the packets that get lost besides.", 0, 1}};
}

}  // namespace swarmanoid
