#include <fmt/format.h>

#include "common/plugin_descriptions/antenna.h"
#include "common/plugin_descriptions/device_tables.h"
#include "common/plugin_descriptions/shared_channel_parameters.h"
#include "common/plugins/noise_parameters.h"

namespace swarmanoid
{

using enum ParameterType;

void DescribeRangeAndBearing()
{
  DescribeActuator({.label = "range_and_bearing",
                    .implementation = "generic_range_and_bearing",
                    .brief = "broadcasts 10 bytes to all in sight, or more",
                    .parameters = Joined({{"bytes", kInteger, "", "10", "Bytes of a message.", 10, 10'000},
                                          {"range", kNumber, "m", "1e6",
                                           "Distance to which packets are received at most; the receivers have a "
                                           "range, too.",
                                           0.001, 1e6}},
                                         NoiseParameters("each byte of the message", "1/255")),
                    .robots = {"footbot", "eyebot", "handbot"}});
  const std::vector<ParameterSpec> noise =
      Joined(Joined(NoiseParameters("each range", "m", "range_"), NoiseParameters("each bearing", "rad", "bearing_")),
             NoiseParameters("each vertical bearing", "rad", "vertical_bearing_"));
  const ParameterSpec line_of_sight{"line_of_sight", kBoolean, "", "true",
                                    "Whether bodies between two robots keep packets off."};
  const ParameterSpec antenna{"antenna",
                              kNumber,
                              "m",
                              fmt::format("{}", kAntennaHeight_m),
                              "Height of the antennas above the bases of robots, for the receivers and what they hear.",
                              0,
                              1e6};
  DescribeSensor(
      {.label = "range_and_bearing",
       .implementation = "generic_range_and_bearing",
       .brief = "receives the bytes of all in sight within 3 m, with distance and direction",
       .parameters = Joined({{"range", kNumber, "m", "3", "Distance from which packets are received.", 0.001, 1e6},
                             {"loss_probability", kNumber, "", "0", "Share of the packets that get lost.", 0, 1},
                             line_of_sight,
                             antenna},
                            noise),
       .robots = {"footbot", "eyebot", "handbot"}});
  DescribeSensor({.label = "range_and_bearing",
                  .implementation = "shared_range_and_bearing",
                  .brief = "the same through a channel that all senders share: packets collide and links are shadowed",
                  .parameters = Joined(Joined(SharedChannelParameters("3"), {line_of_sight, antenna}), noise),
                  .robots = {"footbot", "eyebot", "handbot"}});
}

}  // namespace swarmanoid
