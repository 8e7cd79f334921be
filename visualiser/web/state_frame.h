// The binary message with the state of all movable entities for the pages: little-endian, structure of arrays, so that
// a browser reads it in place. docs/web_render.md specifies it. Only web_render uses it.
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

inline constexpr std::uint32_t kKeyMagic = 0x314d5753;     // "SWM1": the whole state
inline constexpr std::uint32_t kPastMagic = 0x334d5753;    // "SWM3": the whole state at a tick of the past
inline constexpr std::uint32_t kChangeMagic = 0x324d5753;  // "SWM2": the changes since a key frame

struct FrameHeader
{
  std::uint32_t magic = kKeyMagic;
  std::uint32_t entities = 0;  // number of movable ones, in the order of the world message
  std::uint64_t tick = 0;
  double time_s = 0;
  std::uint32_t beams = 0;
  std::uint32_t grips = 0;
  std::uint32_t rings = 0;
  std::uint32_t key = 0;  // number of the key frame: this one, or the one that the changes refer to
};
static_assert(sizeof(FrameHeader) == 40);

// The counts that follow the header of a change.
struct ChangeCounts
{
  std::uint32_t poses = 0;    // number of FramePose
  std::uint32_t colours = 0;  // number of FrameColour
};

// The change of each movable entity: its motion in the plane, and its heading.
struct FrameStep
{
  static constexpr double kUnit = 1e-4;  // m
  std::int16_t x = 0, y = 0;             // from its position in the key frame
  std::int16_t yaw = 0;                  // 32767: half a turn
};
static_assert(sizeof(FrameStep) == 6);

// The pose of an entity that has left the plane or moved too far for a step.
struct FramePose
{
  std::uint32_t slot = 0;  // index among the movable entities
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
  kLit = 1,         // the colour is that of LEDs; otherwise of the surface, or none
  kUnevenRing = 2,  // LEDs have several colours, whose mean is given
  kGripping = 4,
  kLaserOn = 8,
  kBeaconLit = 16,
  kAttached = 32,  // held by the ceiling or the rope
  kAbsent = 64,    // outside the arena
};

// A laser beam from the entity's position to its end.
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

// The LEDs of a robot that shows several colours. The 512 robots with the lowest numbers have one.
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
  // The space must outlive the writer.
  explicit FrameWriter(const CSwarmanoidSpace& space);
  // Returns the bytes of the whole state at the space's tick, to which later changes refer.
  std::string WriteKey();
  // Returns the changes since the last key frame. It is empty if there is no key frame, or if a key frame would be
  // hardly longer.
  std::string WriteChange();

private:
  // The indices of a movable entity's attributes that a frame shows; kNone if it has none.
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
  // A body that a beam can meet.
  struct Body
  {
    std::uint32_t entity;
    Shape shape;
    double reach;  // m: the distance of its farthest point from the entity's position
  };
  static constexpr std::uint32_t kNone = ~0U;
  static constexpr std::size_t kRings = 512;

  // Reads the state at the space's tick into positions_ to rings_.
  void Read();
  FrameHeader Header(std::uint32_t magic) const;
  std::string Bytes(std::size_t fixed) const;
  // Returns the step of a slot since the key frame; nothing if it moved too far.
  std::optional<FrameStep> StepOf(std::size_t slot) const;
  void ReadAttributes();
  std::uint32_t ReadLeds(const Bearer& bearer, std::uint8_t& flags);
  void FindBeams();
  Vector3 EndOfBeam(std::uint32_t entity, const Vector3& from, const Vector3& direction) const;

  const CSwarmanoidSpace& space_;
  std::vector<Bearer> bearers_;
  std::vector<Body> bodies_;
  std::uint64_t attribute_revision_ = 0;
  // The arrays are indexed by slot: position (3), quaternion (4), colour (4).
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
