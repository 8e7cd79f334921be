#include "common/plugin_descriptions/renderers.h"

namespace swarmanoid
{

using enum ParameterType;

PluginDescription Ros2RenderDescription()
{
  PluginDescription description;
  description.label = "ros2_render";
  description.brief = "shows the simulation to ROS 2: /clock, /tf, odometry of the robots, markers of all bodies";
  description.parameters = {
      {"every", kInteger, "ticks", "1", "Poses and odometry are published every so many ticks, the clock at each.", 1,
       1e6},
      {"namespace", kText, "", "", "In front of the topics of robots and markers; /clock and /tf have none."},
      {"frame", kText, "", "world", "The frame of the arena, its origin in the corner with the least x and y."},
      {"odometry", kBoolean, "", "true",
       "Whether each robot has a topic <id>/odom with its pose and velocity, without error."},
      {"markers", kBoolean, "", "true", "Whether the topic `arena` has a marker for the floor and each body."}};
  return description;
}

}  // namespace swarmanoid
