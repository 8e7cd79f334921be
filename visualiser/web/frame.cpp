#include "visualiser/web/frame.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "common/space/attributes.h"

namespace swarmanoid
{
namespace
{

static_assert(std::endian::native == std::endian::little, "frames are little-endian");

constexpr double kLongestBeam = 30;

std::uint32_t ColourOf(double value) { return static_cast<std::uint32_t>(value) & 0xffffffU; }

std::int16_t Quantised(double value)
{
  return static_cast<std::int16_t>(std::lround(std::clamp(value, -1.0, 1.0) * 32767));
}

template <class Value>
char* Append(char* place, const std::vector<Value>& values)
{
  const std::size_t size = values.size() * sizeof(Value);
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
  colours_.resize(bearers_.size() * 4);
  for (std::uint32_t e = 0; e < space.Size(); ++e)
  {
    const Shape shape = ShapeOf(space.GetEntity(e).GetConfiguration());
    if (shape.kind != Shape::Kind::kNone) bodies_.push_back({e, shape, shape.centre.norm() + BoundingRadius(shape)});
  }
}

std::string FrameWriter::Write()
{
  if (attribute_revision_ != space_.AttributeRevision())
  {
    ReadAttributes();
    attribute_revision_ = space_.AttributeRevision();
  }
  FindBeams();

  FrameHeader header;
  header.entities = static_cast<std::uint32_t>(bearers_.size());
  header.tick = space_.GetTick();
  header.time_s = space_.GetTime();
  header.beams = static_cast<std::uint32_t>(beams_.size());
  header.grips = static_cast<std::uint32_t>(grips_.size());
  header.rings = static_cast<std::uint32_t>(rings_.size());

  const std::size_t n = bearers_.size();
  std::string bytes(sizeof header + 24 * n + beams_.size() * sizeof(FrameBeam) + grips_.size() * sizeof(FrameGrip) +
                        rings_.size() * sizeof(FrameRing),
                    '\0');
  char* place = bytes.data();
  std::memcpy(place, &header, sizeof header);
  place += sizeof header;
  char* quaternions = place + 12 * n;
  const PoseArrays& poses = space_.Poses();
  for (const Bearer& bearer : bearers_)
  {
    const std::uint32_t e = bearer.entity;
    const float position[3] = {static_cast<float>(poses.x[e]), static_cast<float>(poses.y[e]),
                               static_cast<float>(poses.z[e])};
    const std::int16_t quaternion[4] = {Quantised(poses.qx[e]), Quantised(poses.qy[e]), Quantised(poses.qz[e]),
                                        Quantised(poses.qw[e])};
    std::memcpy(place, position, sizeof position);
    std::memcpy(quaternions, quaternion, sizeof quaternion);
    place += sizeof position;
    quaternions += sizeof quaternion;
  }
  place = Append(quaternions, colours_);
  place = Append(place, beams_);
  place = Append(place, grips_);
  Append(place, rings_);
  return bytes;
}

void FrameWriter::ReadAttributes()
{
  const std::span<const double> attributes = space_.Attributes();
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

// The mean colour of the LEDs that shine, or that of the beacon if none does.
std::uint32_t FrameWriter::ReadLeds(const Bearer& bearer, std::uint8_t& flags)
{
  const double* leds = &space_.Attributes()[bearer.led];
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
  const std::span<const double> attributes = space_.Attributes();
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

// At the first body, or on the floor, as the cameras see the spot.
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
    // Bodies far from the line cost one distance each.
    const Vector3 origin(poses.x[body.entity], poses.y[body.entity], poses.z[body.entity]);
    const double along = std::clamp((origin - from).dot(direction), 0.0, length);
    if ((from + along * direction - origin).squaredNorm() > body.reach * body.reach) continue;
    const std::optional<double> hit = SegmentHit(body.shape, space_.GetPose(body.entity), from, to);
    if (hit) nearest = std::min(nearest, *hit);
  }
  return from + nearest * (to - from);
}

}  // namespace swarmanoid
