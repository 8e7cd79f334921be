// Marks that pages show beside bodies on request: rays of proximity sensors and range scanners, the bodies that engines
// collide, and the links of range and bearing. web_render uses it in the thread of Draw and Idle.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/plugin_descriptions/antenna.h"
#include "common/space/collision_models.h"
#include "common/space/space_query.h"
#include "visualiser/scene/proximity_rays.h"
#include "visualiser/scene/scanner_rays.h"
#include "visualiser/web/page_messages.h"

namespace swarmanoid
{

class MarksWriter
{
public:
  // The space must outlive the writer.
  explicit MarksWriter(const CSwarmanoidSpace& space);
  // Returns the message "marks" for the requested entities. Entities outside the arena have none.
  std::string Text(const MarksRequest& wanted);

private:
  // A robot with an antenna.
  struct Antenna
  {
    std::uint32_t message = 0;  // index of the attribute
    // Parameters of its receiver:
    double range = 0;                  // m; 0: it does not receive
    double height = kAntennaHeight_m;  // of the antennas above the bases of robots
    bool needs_sight = true;

    bool SeesAs(const Antenna& other) const { return height == other.height && needs_sight == other.needs_sight; }
  };

  bool IsPresent(std::uint32_t entity) const;
  // Reads the parameters of the robot's sensor of range and bearing, if it has one with a range.
  void SetReceiver(const EntityConfiguration& robot, Antenna& antenna) const;
  Vector3 PlaceOf(std::uint32_t robot, double height) const;
  bool IsInRange(std::uint32_t receiver, std::uint32_t sender) const;
  bool IsInSight(std::uint32_t receiver, std::uint32_t sender);

  const CSwarmanoidSpace& space_;
  SpaceQuery query_;
  CollisionModels models_;
  std::vector<std::optional<Antenna>> antennas_;  // by entity
  double longest_reach_ = 0;                      // m, between the bases of robots
  std::vector<ProximityRay> rays_;
  ScannerRays scanner_rays_;
  std::vector<CollisionBody> bodies_;
};

}  // namespace swarmanoid
