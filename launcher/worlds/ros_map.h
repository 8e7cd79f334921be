// Reads the maps of ROS (map_server, nav2_map_server): a YAML file that names a picture with its resolution, origin and
// thresholds (http://wiki.ros.org/map_server#YAML_format), for `swarmanoid convert`.
#pragma once

#include <string>
#include <string_view>

#include "common/math/pose.h"

namespace swarmanoid
{

struct RosMap
{
  std::string image;  // as the file names it, relative to its folder
  double resolution_m = 0;
  Vector3 origin = Vector3::Zero();  // x and y (m) of the lower left pixel in the frame of the map, and its yaw (rad)
  double occupied_threshold = 0.65;  // pixels with a larger share of the other colour than that of free space are walls
  bool is_negated = false;           // white pixels are walls instead of black ones
};

// Returns whether a file is such a map, by the ending of its name.
bool IsRosMapFile(const std::string& path);

// Reads the text of a map. `file`: its name, for messages. Throws ConfigurationError with file:line:col if it is not
// flat YAML, if a value is missing or wrong, and for a mode other than trinary and scale.
RosMap ReadRosMap(std::string_view text, const std::string& file);

}  // namespace swarmanoid
