// The common parameters of the engines on a plane.
#include "common/plugin_descriptions/engines.h"

namespace swarmanoid
{

std::vector<ParameterSpec> PlaneParameters()
{
  return {{.name = "perpendicular_axis",
           .type = ParameterType::kChoice,
           .default_value = "z",
           .description = "The axis of the space to which the plane of the engine is perpendicular.",
           .choices = {"x", "y", "z"}},
          {.name = "distance",
           .unit = "m",
           .default_value = "0",
           .description = "Signed distance of the plane from the origin along that axis.",
           .minimum = -1e6,
           .maximum = 1e6},
          {.name = "tilt",
           .type = ParameterType::kVector3,
           .unit = "deg",
           .default_value = "0, 0, 0",
           .description = "Turns the plane about the origin of the space: rotations about x, y and z, in this order.",
           .minimum = -1e5,
           .maximum = 1e5}};
}

ParameterSpec ThreadsParameter()
{
  return {.name = "threads",
          .type = ParameterType::kInteger,
          .default_value = "0",
          .description =
              "Threads that share the work; their number changes no bit of the results. 0: in one process "
              "as many as --threads has, while that is quicker; in a process of its own one.",
          .minimum = 0,
          .maximum = 64};
}

std::vector<std::string> WithChannelsOfPlaneRobots(std::vector<std::string> own)
{
  for (const char* channel : {"eyebot_attach", "handbot_arms", "handbot_hands", "handbot_rope", "joints"})
    own.push_back(channel);
  return own;
}

}  // namespace swarmanoid
