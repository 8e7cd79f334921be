// A key frame has all positions, orientations and colours. A change has one step of six bytes for each entity, relative
// to the key, and full poses and colours only of entities for which a step is not enough. All changes refer to the key
// and not to each other, so that a page may miss any of them.
#include "visualiser/web/state_frame.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>

#include "common/space/attributes.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

static_assert(std::endian::native == std::endian::little, "frames are little-endian");

constexpr double kLongestBeam = 30;
constexpr double kWorthwhile = 0.7;  // relative to a key frame: a longer change is not sent

std::uint32_t ColourOf(double value) { return static_cast<std::uint32_t>(value) & 0xffffffU; }

std::int16_t Quantised(double value)
{
  return static_cast<std::int16_t>(std::lround(std::clamp(value, -1.0, 1.0) * 32767));
}

template <class Value>
std::size_t SizeOf(const std::vector<Value>& values)
{
  return values.size() * sizeof(Value);
}

template <class Value>
char* Append(char* place, const std::vector<Value>& values)
{
  const std::size_t size = SizeOf(values);
  if (size > 0) std::memcpy(place, values.data(), size);
  return place + size;
}

}  // namespace

FrameWriter::FrameWriter(const CSwarmanoidSpace& space) : space_(space)
{
  for (const std::uint32_t e : space.Movable())
  {
    const CSwarmanoidSpaceEntity& entity = space.GetEntity(e);
    const auto slot = [&](std::string_view name)
    {
      const int offset = AttributeOffset(entity.GetKind(), name);
      return offset < 0 ? kNone : entity.FirstSlot() + static_cast<std::uint32_t>(offset);
    };
    Bearer bearer;
    bearer.entity = e;
    bearer.colour = slot("colour");
    bearer.led = slot("led");
    bearer.beacon = slot("beacon");
    bearer.gripped = slot("gripped");
    bearer.laser = slot("laser");
    bearer.attached = slot("rope_attached");
    if (bearer.attached == kNone) bearer.attached = slot("attached");
    for (const AttributeSpec& spec : AttributesOf(entity.GetKind()))
    {
      if (spec.name == "led") bearer.leds = static_cast<std::uint32_t>(spec.count);
      if (spec.name == "gripped") bearer.hands = static_cast<std::uint32_t>(spec.count);
    }
    bearers_.push_back(bearer);
  }
  positions_.resize(bearers_.size() * 3);
  quaternions_.resize(bearers_.size() * 4);
  colours_.resize(bearers_.size() * 4);
  for (std::uint32_t e = 0; e < space.Size(); ++e)
  {
    const Shape shape = ShapeOf(space.GetEntity(e).GetConfiguration());
    if (shape.kind != Shape::Kind::kNone) bodies_.push_back({e, shape, shape.centre.norm() + BoundingRadius(shape)});
  }
}

void FrameWriter::Read()
{
  if (attribute_revision_ != space_.AttributeRevision())
  {
    ReadAttributes();
    attribute_revision_ = space_.AttributeRevision();
  }
  FindBeams();
  const PoseArrays& poses = space_.Poses();
  float* position = positions_.data();
  std::int16_t* quaternion = quaternions_.data();
  for (const Bearer& bearer : bearers_)
  {
    const std::uint32_t e = bearer.entity;
    for (const double value : {poses.x[e], poses.y[e], poses.z[e]}) *position++ = static_cast<float>(value);
    for (const double value : {poses.qx[e], poses.qy[e], poses.qz[e], poses.qw[e]}) *quaternion++ = Quantised(value);
  }
}

FrameHeader FrameWriter::Header(std::uint32_t magic) const
{
  FrameHeader header;
  header.magic = magic;
  header.entities = static_cast<std::uint32_t>(bearers_.size());
  header.tick = space_.GetTick();
  header.time_s = space_.GetTime();
  header.beams = static_cast<std::uint32_t>(beams_.size());
  header.grips = static_cast<std::uint32_t>(grips_.size());
  header.rings = static_cast<std::uint32_t>(rings_.size());
  header.key = key_;
  return header;
}

// Returns a text with reserved memory for so many bytes and the lists that end every frame.
std::string FrameWriter::Bytes(std::size_t fixed) const
{
  return std::string(fixed + SizeOf(beams_) + SizeOf(grips_) + SizeOf(rings_), '\0');
}

std::string FrameWriter::WriteKey()
{
  Read();
  ++key_;
  key_positions_ = positions_;
  key_quaternions_ = quaternions_;
  key_colours_ = colours_;
  const FrameHeader header = Header(kKeyMagic);
  std::string bytes = Bytes(sizeof header + SizeOf(positions_) + SizeOf(quaternions_) + SizeOf(colours_));
  std::memcpy(bytes.data(), &header, sizeof header);
  char* place = Append(bytes.data() + sizeof header, positions_);
  place = Append(place, quaternions_);
  place = Append(place, colours_);
  place = Append(place, beams_);
  place = Append(place, grips_);
  Append(place, rings_);
  return bytes;
}

std::string FrameWriter::WriteChange()
{
  if (key_ == 0) return {};
  Read();
  steps_.clear();
  changed_poses_.clear();
  changed_colours_.clear();
  for (std::size_t slot = 0; slot < bearers_.size(); ++slot)
  {
    const auto number = static_cast<std::uint32_t>(slot);
    const std::optional<FrameStep> step = StepOf(slot);
    steps_.push_back(step.value_or(FrameStep{}));
    if (!step)
    {
      FramePose pose{number, positions_[3 * slot], positions_[3 * slot + 1], positions_[3 * slot + 2], {}};
      std::memcpy(pose.quaternion, &quaternions_[4 * slot], sizeof pose.quaternion);
      changed_poses_.push_back(pose);
    }
    if (std::memcmp(&colours_[4 * slot], &key_colours_[4 * slot], 4) == 0) continue;
    FrameColour colour{number, {}};
    std::memcpy(colour.colour, &colours_[4 * slot], 4);
    changed_colours_.push_back(colour);
  }
  const ChangeCounts counts{static_cast<std::uint32_t>(changed_poses_.size()),
                            static_cast<std::uint32_t>(changed_colours_.size())};
  const std::size_t changes = SizeOf(steps_) + SizeOf(changed_poses_) + SizeOf(changed_colours_);
  if (static_cast<double>(changes) > kWorthwhile * 24 * static_cast<double>(bearers_.size())) return {};
  const FrameHeader header = Header(kChangeMagic);
  std::string bytes = Bytes(sizeof header + sizeof counts + changes);
  std::memcpy(bytes.data(), &header, sizeof header);
  std::memcpy(bytes.data() + sizeof header, &counts, sizeof counts);
  char* place = Append(bytes.data() + sizeof header + sizeof counts, changed_poses_);
  place = Append(place, changed_colours_);
  place = Append(place, beams_);
  place = Append(place, grips_);
  place = Append(place, rings_);
  Append(place, steps_);  // last: their size is not a multiple of four
  return bytes;
}

std::optional<FrameStep> FrameWriter::StepOf(std::size_t slot) const
{
  const float* now = &positions_[3 * slot];
  const float* key = &key_positions_[3 * slot];
  const std::int16_t* turn = &quaternions_[4 * slot];
  const std::int16_t* key_turn = &key_quaternions_[4 * slot];
  if (now[2] != key[2] || turn[0] != 0 || turn[1] != 0 || key_turn[0] != 0 || key_turn[1] != 0) return std::nullopt;
  const double x = (static_cast<double>(now[0]) - key[0]) / FrameStep::kUnit;
  const double y = (static_cast<double>(now[1]) - key[1]) / FrameStep::kUnit;
  if (!(std::abs(x) <= 32767 && std::abs(y) <= 32767)) return std::nullopt;
  const double yaw = 2 * std::atan2(turn[2], turn[3]);
  const double half_turns = std::remainder(yaw, 2 * std::numbers::pi) / std::numbers::pi;
  return FrameStep{static_cast<std::int16_t>(std::lround(x)), static_cast<std::int16_t>(std::lround(y)),
                   static_cast<std::int16_t>(std::lround(half_turns * 32767))};
}

void FrameWriter::ReadAttributes()
{
  const SparseVector<double>& attributes = space_.Attributes();
  grips_.clear();
  rings_.clear();
  std::uint8_t* bytes = colours_.data();
  for (const Bearer& bearer : bearers_)
  {
    std::uint8_t flags = 0;
    std::uint32_t colour = bearer.colour == kNone ? 0 : ColourOf(attributes[bearer.colour]);
    if (bearer.leds > 0) colour = ReadLeds(bearer, flags);
    for (std::uint32_t hand = 0; hand < bearer.hands; ++hand)
    {
      const double held = attributes[bearer.gripped + hand];
      if (held <= 0 || !space_.IsPresent(bearer.entity)) continue;
      flags |= kGripping;
      grips_.push_back({bearer.entity, static_cast<std::uint32_t>(held) - 1});
    }
    if (bearer.laser != kNone && attributes[bearer.laser] != 0) flags |= kLaserOn;
    if (bearer.beacon != kNone && ColourOf(attributes[bearer.beacon]) != 0) flags |= kBeaconLit;
    if (bearer.attached != kNone && attributes[bearer.attached] != 0) flags |= kAttached;
    if (!space_.IsPresent(bearer.entity)) flags |= kAbsent;
    *bytes++ = static_cast<std::uint8_t>(colour >> 16U);
    *bytes++ = static_cast<std::uint8_t>(colour >> 8U);
    *bytes++ = static_cast<std::uint8_t>(colour);
    *bytes++ = flags;
  }
}

// Returns the mean colour of the LEDs that shine, or that of the beacon if all are off.
std::uint32_t FrameWriter::ReadLeds(const Bearer& bearer, std::uint8_t& flags)
{
  const std::span<const double> leds = space_.Attributes().Part(bearer.led, bearer.leds);
  std::uint32_t sum[3] = {};
  std::uint32_t lit = 0;
  bool even = true;
  for (std::uint32_t i = 0; i < bearer.leds; ++i)
  {
    even &= leds[i] == leds[0];
    const std::uint32_t colour = ColourOf(leds[i]);
    if (colour == 0) continue;
    ++lit;
    sum[0] += colour >> 16U;
    sum[1] += (colour >> 8U) & 0xffU;
    sum[2] += colour & 0xffU;
  }
  if (!even)
  {
    flags |= kUnevenRing;
    if (rings_.size() < kRings)
    {
      FrameRing ring{bearer.entity, {}};
      for (std::size_t i = 0; i < std::min<std::size_t>(bearer.leds, FrameRing::kLeds); ++i)
      {
        const std::uint32_t colour = ColourOf(leds[i]);
        ring.colours[i][0] = static_cast<std::uint8_t>(colour >> 16U);
        ring.colours[i][1] = static_cast<std::uint8_t>(colour >> 8U);
        ring.colours[i][2] = static_cast<std::uint8_t>(colour);
      }
      rings_.push_back(ring);
    }
  }
  if (lit > 0)
  {
    flags |= kLit;
    return (sum[0] / lit) << 16U | (sum[1] / lit) << 8U | sum[2] / lit;
  }
  const std::uint32_t beacon = bearer.beacon == kNone ? 0 : ColourOf(space_.Attributes()[bearer.beacon]);
  if (beacon != 0) flags |= kLit;
  return beacon;
}

void FrameWriter::FindBeams()
{
  beams_.clear();
  const SparseVector<double>& attributes = space_.Attributes();
  for (const Bearer& bearer : bearers_)
  {
    if (bearer.laser == kNone || attributes[bearer.laser] == 0 || !space_.IsPresent(bearer.entity)) continue;
    const CSwarmanoidSpaceEntity& entity = space_.GetEntity(bearer.entity);
    const double pan = entity.GetAttribute("laser_pan");
    const double tilt = entity.GetAttribute("laser_tilt");
    const Pose pose = entity.GetPose();
    const Vector3 direction =
        pose.orientation * Vector3(std::sin(tilt) * std::cos(pan), std::sin(tilt) * std::sin(pan), -std::cos(tilt));
    const Vector3 end = EndOfBeam(bearer.entity, pose.position, direction);
    beams_.push_back({bearer.entity, static_cast<float>(end.x()), static_cast<float>(end.y()),
                      static_cast<float>(end.z()), ColourOf(entity.GetAttribute("laser_colour"))});
  }
}

// Returns the first body on the beam, or the floor, as cameras see the spot.
Vector3 FrameWriter::EndOfBeam(std::uint32_t entity, const Vector3& from, const Vector3& direction) const
{
  double length = kLongestBeam;
  if (direction.z() < 0) length = std::min(length, std::max(from.z() / -direction.z(), 0.0));
  const Vector3 to = from + length * direction;
  double nearest = 1;
  const PoseArrays& poses = space_.Poses();
  for (const Body& body : bodies_)
  {
    if (body.entity == entity) continue;
    // Bodies far from the line cost only one distance.
    const Vector3 origin(poses.x[body.entity], poses.y[body.entity], poses.z[body.entity]);
    const double along = std::clamp((origin - from).dot(direction), 0.0, length);
    if ((from + along * direction - origin).squaredNorm() > body.reach * body.reach) continue;
    const std::optional<double> hit = SegmentHit(body.shape, space_.GetPose(body.entity), from, to);
    if (hit) nearest = std::min(nearest, *hit);
  }
  return from + nearest * (to - from);
}

}  // namespace swarmanoid
