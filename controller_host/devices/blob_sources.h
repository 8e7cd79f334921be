// Everything coloured that cameras see as blobs: lit LEDs and beacons, laser spots, preys, light bulbs, ground patches.
// LEDs of one colour on one robot are one blob at their middle, as connected pixels of one colour are in an image.
// Shared by the cameras of a process; brought to the space's state when poses or attributes changed.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "controller_host/devices/sensor_world.h"

namespace swarmanoid
{

struct BlobSource
{
  Vector3 position;  // m, in the space
  std::uint32_t colour;
  std::uint32_t owner;  // entity, or SightLines::kNobody for laser spots
};

class BlobSources
{
public:
  explicit BlobSources(SensorWorld& world);
  // One for each world while somebody holds it, as SensorWorld::Of.
  static std::shared_ptr<BlobSources> Of(const std::shared_ptr<SensorWorld>& world);

  // The world must be refreshed.
  void Refresh();

  // Those on a movable body.
  std::span<const BlobSource> On(std::uint32_t entity) const
  {
    return {sources_.data() + start_[entity], start_[entity + 1] - start_[entity]};
  }
  // Those that are on none: lights, patches, laser spots.
  std::span<const BlobSource> Free() const { return free_; }

private:
  // Where the LEDs of a kind of robot stand.
  struct Ring
  {
    int leds = 0;
    std::vector<Vector2> places;  // m, about the z axis
    double height = 0;            // m
    double beacon_height = 0;     // m
    bool turns = false;           // with the turret
  };
  // A movable entity with something coloured on it.
  struct Bearer
  {
    std::uint32_t entity;
    const Ring* ring;  // nullptr: the entity has one colour of its own
    std::uint32_t led_slot, beacon_slot, turret_slot, colour_slot;
    double middle;  // m: height of the middle of the body
  };
  struct Laser
  {
    std::uint32_t entity;
    std::uint32_t slot;  // laser, laser_colour, laser_pan, laser_tilt
  };

  static Ring MakeRing(int leds, double radius, double height, double beacon_height, double first_angle, bool turns);
  void AddLeds(const Bearer& bearer);
  void AddPoint(std::uint32_t entity, const Vector3& local, std::uint32_t colour);
  void AddLaserSpot(const Laser& laser);

  SensorWorld& world_;
  std::shared_ptr<SensorWorld> keeper_;  // keeps the world alive where it is shared
  Ring footbot_, eyebot_, handbot_;
  std::vector<Bearer> bearers_;
  std::vector<Laser> lasers_;
  std::vector<std::uint32_t> still_;  // lights and patches
  std::vector<std::uint32_t> start_;  // by entity
  std::vector<BlobSource> sources_;
  std::vector<BlobSource> free_;
  std::uint64_t revision_ = 0, attribute_revision_ = 0;
};

}  // namespace swarmanoid
