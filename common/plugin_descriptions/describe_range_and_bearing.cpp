#include "common/plugin_descriptions/device_tables.h"
#include "common/plugins/noise_parameters.h"

namespace swarmanoid
{

void DescribeRangeAndBearing()
{
  DescribeActuator({.label = "range_and_bearing",
                    .implementation = "generic_range_and_bearing",
                    .brief = "broadcasts 10 bytes to all in sight, or more",
                    .parameters = Joined({{.name = "bytes",
                                           .type = ParameterType::kInteger,
                                           .default_value = "10",
                                           .description = "Bytes of a message.",
                                           .minimum = 10,
                                           .maximum = 10'000}},
                                         NoiseParameters("each byte of the message", "1/255")),
                    .robots = {"footbot", "eyebot", "handbot"}});
  const std::vector<ParameterSpec> noise =
      Joined(Joined(NoiseParameters("each range", "m", "range_"), NoiseParameters("each bearing", "rad", "bearing_")),
             NoiseParameters("each vertical bearing", "rad", "vertical_bearing_"));
  DescribeSensor({.label = "range_and_bearing",
                  .implementation = "generic_range_and_bearing",
                  .brief = "receives the bytes of all in sight within 3 m, with distance and direction",
                  .parameters = Joined({{.name = "range",
                                         .unit = "m",
                                         .default_value = "3",
                                         .description = "Distance from which packets are received.",
                                         .minimum = 0.001,
                                         .maximum = 1e6},
                                        {.name = "loss_probability",
                                         .default_value = "0",
                                         .description = "Share of the packets that get lost.",
                                         .minimum = 0,
                                         .maximum = 1}},
                                       noise),
                  .robots = {"footbot", "eyebot", "handbot"}});
}

}  // namespace swarmanoid
