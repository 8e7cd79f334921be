// The binary message that carries the state of all movable entities to the pages: little-endian, structure of arrays,
// so that a browser reads it in place. docs/web_render.md is its specification. Used by web_render alone.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/space/shape.h"
#include "common/space/space.h"

namespace swarmanoid
{

inline constexpr std::uint32_t kFrameMagic = 0x314d5753;  // "SWM1"

struct FrameHeader
{
  std::uint32_t magic = kFrameMagic;
  std::uint32_t entities = 0;  // movable ones, in the order of the world message
  std::uint64_t tick = 0;
  double time_s = 0;
  std::uint32_t beams = 0;
  std::uint32_t grips = 0;
  std::uint32_t rings = 0;
  std::uint32_t reserved = 0;
};
static_assert(sizeof(FrameHeader) == 40);

// The fourth byte of an entity's colour.
enum FrameFlag : std::uint8_t
{
  kLit = 1,         // the colour is that of LEDs; otherwise of the surface, or nothing shines
  kUnevenRing = 2,  // LEDs of several colours: their mean is given
  kGripping = 4,
  kLaserOn = 8,
  kBeaconLit = 16,
  kAttached = 32,  // to the ceiling or by the rope
  kAbsent = 64,    // it is not in the arena
};

// A laser beam from the entity's position to where it ends.
struct FrameBeam
{
  std::uint32_t entity = 0;  // index in the space
  float x = 0, y = 0, z = 0;
  std::uint32_t colour = 0;  // 0xRRGGBB
};
static_assert(sizeof(FrameBeam) == 20);

struct FrameGrip
{
  std::uint32_t robot = 0;  // indices in the space
  std::uint32_t held = 0;
};

// The LEDs of a robot that shows several colours; the lowest-numbered 512 of them.
struct FrameRing
{
  static constexpr std::size_t kLeds = 16;
  std::uint32_t entity = 0;
  std::uint8_t colours[kLeds][3] = {};
};
static_assert(sizeof(FrameRing) == 52);

class FrameWriter
{
public:
  // The space outlives the writer.
  explicit FrameWriter(const CSwarmanoidSpace& space);
  // The bytes of the state at the space's tick.
  std::string Write();

private:
  // Where the attributes of a movable entity stand that a frame shows; kNone if it has none.
  struct Bearer
  {
    std::uint32_t entity = 0;
    std::uint32_t colour = kNone;
    std::uint32_t led = kNone, leds = 0;
    std::uint32_t beacon = kNone;
    std::uint32_t gripped = kNone, hands = 0;
    std::uint32_t laser = kNone;
    std::uint32_t attached = kNone;
  };
  // What a beam can meet.
  struct Body
  {
    std::uint32_t entity;
    Shape shape;
    double reach;  // m, of all of it from the entity's position
  };
  static constexpr std::uint32_t kNone = ~0U;
  static constexpr std::size_t kRings = 512;

  void ReadAttributes();
  std::uint32_t ReadLeds(const Bearer& bearer, std::uint8_t& flags);
  void FindBeams();
  Vector3 EndOfBeam(std::uint32_t entity, const Vector3& from, const Vector3& direction) const;

  const CSwarmanoidSpace& space_;
  std::vector<Bearer> bearers_;
  std::vector<Body> bodies_;
  std::uint64_t attribute_revision_ = 0;
  std::vector<std::uint8_t> colours_;  // four bytes an entity
  std::vector<FrameBeam> beams_;
  std::vector<FrameGrip> grips_;
  std::vector<FrameRing> rings_;
};

}  // namespace swarmanoid
