// The binary message that carries the state of all movable entities to the pages: little-endian, structure of arrays,
// so that a browser reads it in place. docs/web_render.md is its specification. Used by web_render alone.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/math/pose.h"
#include "common/space/shape.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

inline constexpr std::uint32_t kKeyMagic = 0x314d5753;     // "SWM1": all of the state
inline constexpr std::uint32_t kPastMagic = 0x334d5753;    // "SWM3": all of a state of the past, for who looks back
inline constexpr std::uint32_t kChangeMagic = 0x324d5753;  // "SWM2": what has changed since a key frame

struct FrameHeader
{
  std::uint32_t magic = kKeyMagic;
  std::uint32_t entities = 0;  // movable ones, in the order of the world message
  std::uint64_t tick = 0;
  double time_s = 0;
  std::uint32_t beams = 0;
  std::uint32_t grips = 0;
  std::uint32_t rings = 0;
  std::uint32_t key = 0;  // number of the key frame: this one, or the one that the changes refer to
};
static_assert(sizeof(FrameHeader) == 40);

// After the header of a change.
struct ChangeCounts
{
  std::uint32_t poses = 0;    // FramePose
  std::uint32_t colours = 0;  // FrameColour
};

// Of each movable entity in a change: how it has moved in the plane, and where it looks.
struct FrameStep
{
  static constexpr double kUnit = 1e-4;  // m
  std::int16_t x = 0, y = 0;             // from its place in the key frame
  std::int16_t yaw = 0;                  // 32767: half a turn
};
static_assert(sizeof(FrameStep) == 6);

// Of those whose pose is more than a step in the plane.
struct FramePose
{
  std::uint32_t slot = 0;  // place among the movable entities
  float x = 0, y = 0, z = 0;
  std::int16_t quaternion[4] = {};
};
static_assert(sizeof(FramePose) == 24);

struct FrameColour
{
  std::uint32_t slot = 0;
  std::uint8_t colour[4] = {};
};
static_assert(sizeof(FrameColour) == 8);

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
  // The bytes of the whole state at the space's tick, to which later changes refer.
  std::string WriteKey();
  // What has changed since the last key frame; empty if there is none, or if a key frame would be hardly longer.
  std::string WriteChange();

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

  // The state at the space's tick, in positions_ to rings_.
  void Read();
  FrameHeader Header(std::uint32_t magic) const;
  std::string Bytes(std::size_t fixed) const;
  // The step that a slot has made since the key frame; none if it is more than that.
  std::optional<FrameStep> StepOf(std::size_t slot) const;
  void ReadAttributes();
  std::uint32_t ReadLeds(const Bearer& bearer, std::uint8_t& flags);
  void FindBeams();
  Vector3 EndOfBeam(std::uint32_t entity, const Vector3& from, const Vector3& direction) const;

  const CSwarmanoidSpace& space_;
  std::vector<Bearer> bearers_;
  std::vector<Body> bodies_;
  std::uint64_t attribute_revision_ = 0;
  // By slot: position (3), quaternion (4), colour (4).
  std::vector<float> positions_, key_positions_;
  std::vector<std::int16_t> quaternions_, key_quaternions_;
  std::vector<std::uint8_t> colours_, key_colours_;
  std::uint32_t key_ = 0;
  std::vector<FrameStep> steps_;
  std::vector<FramePose> changed_poses_;
  std::vector<FrameColour> changed_colours_;
  std::vector<FrameBeam> beams_;
  std::vector<FrameGrip> grips_;
  std::vector<FrameRing> rings_;
};

}  // namespace swarmanoid
