// The rays of range scanners, for all renderers.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "common/plugin_descriptions/range_scanner_beams.h"
#include "visualiser/scene/proximity_rays.h"

namespace swarmanoid
{

// A scanner may have thousands of beams. Some of them, evenly spaced, stand for all.
class ScannerRays
{
public:
  explicit ScannerRays(const CSwarmanoidSpace& space) : space_(space) {}

  // Appends the rays of a robot; none without a scanner. `query` is of the same space.
  void Find(SpaceQuery& query, std::uint32_t robot, std::vector<ProximityRay>& rays);

private:
  static constexpr std::size_t kMostDrawn = 180;  // of one scanner

  struct Drawn
  {
    Vector3 position;
    double nearest, range;
    std::vector<Vector3> directions;  // in the frame of the robot
  };
  const std::optional<Drawn>& Of(std::uint32_t robot);

  const CSwarmanoidSpace& space_;
  std::map<std::string, std::optional<Drawn>> scanners_;  // by controller
};

}  // namespace swarmanoid
