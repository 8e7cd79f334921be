// Everything coloured that cameras see as blobs: lit LEDs and beacons, laser spots, preys, light bulbs, ground patches.
// LEDs of one colour on one robot are one blob at their middle, as connected pixels of one colour are in an image;
// directional LEDs are a blob each, since not all of them are seen.
// Shared by the cameras of a process; brought to the space's state when poses or attributes changed.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "common/plugin_descriptions/led_cones.h"
#include "controller_host/devices/sensing/sensor_world.h"

namespace swarmanoid
{

struct BlobSource
{
  // The coloured part of an entity. LEDs of one colour on one ring have the name of the first of them.
  enum Part : std::uint32_t
  {
    kFirstLed = 0,
    kBeacon = 64,
    kBody,
    kLaserSpot
  };

  Vector3 position;  // m, in the space
  std::uint32_t colour : 24;
  std::uint32_t part : 8;
  std::uint32_t owner;  // entity, or SightLines::kNobody for laser spots
};

class BlobSources
{
public:
  // No source stands out of its body by more than this, m.
  static constexpr double kStandOut = 0.01;

  explicit BlobSources(SensorWorld& world);
  // Returns the object of a world, shared as long as a batch holds it, as SensorWorld::Of.
  static std::shared_ptr<BlobSources> Of(const std::shared_ptr<SensorWorld>& world);

  // The world must be refreshed.
  void Refresh();

  // Returns the sources on the movable body at a place in the grid of the world.
  std::span<const BlobSource> AtForTest(std::uint32_t place) const
  {
    return {sources_.data() + start_[place], start_[place + 1] - start_[place]};
  }
  // Returns the sources on no movable body: lights, patches, laser spots, bodies that never move.
  std::span<const BlobSource> Free() const { return All().subspan(FirstFree()); }
  std::span<const BlobSource> All() const { return sources_; }
  std::size_t FirstFree() const { return start_.back(); }
  // Collects the numbers of the sources on the bodies at these places, then those of the free sources. Fills the start
  // of `numbers` and returns the count.
  std::size_t Collect(std::span<const std::int32_t> places, std::vector<std::int32_t>& numbers) const;
  const BlobSource& Source(std::size_t number) const { return sources_[number]; }
  // Returns the name of a source for random streams, by the id of its entity and its part. Laser spots have the
  // eyebot's.
  std::uint64_t NameOf(std::size_t number) const;
  // Returns for each source the nearest of the eight colours with the bits red (4), green (2) and blue (1); 0 is black.
  const std::uint8_t* Hues() const { return hue_.data(); }
  // Returns true if a source is visible only from within a cone. Otherwise IsSeenFrom need not be called.
  bool HasCones() const { return !cones_.empty(); }
  // Returns whether an eye is within the cone of a source, if it has one.
  bool IsSeenFrom(const Vector3& eye, std::size_t number) const
  {
    const Cone& cone = cones_[number];
    const Vector3 offset = eye - sources_[number].position;
    return cone.cosine < -1 || offset.dot(cone.axis) >= cone.cosine * __builtin_sqrt(offset.squaredNorm());
  }
  // Returns true if laser spots may exist. Their eyebots may be far away.
  bool HasLasers() const { return !lasers_.empty(); }
  // No source is lower than this, m in the space.
  double LowestHeight() const { return lowest_; }

private:
  // An entity with something coloured on it.
  struct Bearer
  {
    std::uint32_t entity;
    const EntityKindDescription* ring;  // the LEDs of the entity; nullptr if it has one colour
    std::uint32_t led_slot, beacon_slot, turret_slot, colour_slot;
    double middle;  // m: height of the middle of the body
    std::optional<LedCones> cones{};
  };
  struct Cone
  {
    Vector3 axis = Vector3::UnitX();  // in the space
    double cosine = -2;               // less than -1: seen from all sides
  };
  struct Laser
  {
    std::uint32_t entity;
    std::uint32_t slot;  // laser, laser_colour, laser_pan, laser_tilt
  };

  void AddEntity(std::uint32_t entity);
  void AddBearer(const Bearer& bearer);
  void AddLeds(const Bearer& bearer);
  void AddDirectionalLeds(const Bearer& bearer);
  void AddPoint(std::uint32_t entity, const Vector3& local, std::uint32_t colour, std::uint32_t part);
  void AddLaserSpot(const Laser& laser);

  SensorWorld& world_;
  std::shared_ptr<SensorWorld> keeper_;  // keeps the world alive if it is shared
  std::vector<Bearer> bearers_;
  std::vector<std::int32_t> bearer_of_;  // by entity, -1: none
  std::vector<Laser> lasers_;
  std::vector<std::uint32_t> still_;   // lights and patches
  std::vector<Cone> cones_;            // of each source; empty if all are seen from all sides
  std::vector<BlobSource> sources_;    // by place in the grid; then those on no movable body, laser spots at last
  std::vector<std::uint32_t> lit_by_;  // of each laser spot the eyebot
  std::vector<std::uint32_t> start_;   // by place in the grid, and of the others
  std::vector<std::uint8_t> hue_;      // of each source
  double lowest_ = 0;
  std::uint64_t revision_ = 0, attribute_revision_ = 0;
};

}  // namespace swarmanoid
