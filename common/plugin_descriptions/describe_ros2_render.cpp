#include "common/plugin_descriptions/renderers.h"

namespace swarmanoid
{

PluginDescription Ros2RenderDescription()
{
  PluginDescription description;
  description.label = "ros2_render";
  description.brief = "shows the simulation to ROS 2: /clock, /tf, odometry of the robots, markers of all bodies";
  description.parameters = {
      {.name = "every",
       .type = ParameterType::kInteger,
       .unit = "ticks",
       .default_value = "1",
       .description = "Poses and odometry are published every so many ticks, the clock at each.",
       .minimum = 1,
       .maximum = 1e6},
      {.name = "namespace",
       .type = ParameterType::kText,
       .default_value = "",
       .description = "In front of the topics of robots and markers; /clock and /tf have none."},
      {.name = "frame",
       .type = ParameterType::kText,
       .default_value = "world",
       .description = "The frame of the arena, its origin in the corner with the least x and y."},
      {.name = "odometry",
       .type = ParameterType::kBoolean,
       .default_value = "true",
       .description = "Whether each robot has a topic <id>/odom with its pose and velocity, without error."},
      {.name = "markers",
       .type = ParameterType::kBoolean,
       .default_value = "true",
       .description = "Whether the topic `arena` has a marker for the floor and each body."}};
  return description;
}

}  // namespace swarmanoid
