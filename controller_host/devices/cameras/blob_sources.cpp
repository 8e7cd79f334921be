// Problem: state what cameras can see: LEDs, beacons, lights, coloured bodies and patches, laser spots.
//
// Method: once a tick, the sources of all movable bodies are made in the order of the grid, then the free ones. LEDs of
// one ring that have the same colour are one source in their middle, as a camera would merge them; a ring of one colour
// is one source in the robot's axis. Directional LEDs are single sources with a cone.
//
// Invariant: sources of one body are consecutive, so that a place in the grid names all of them.
#include "controller_host/devices/cameras/blob_sources.h"

#include <algorithm>
#include <limits>
#include <map>
#include <mutex>

#include "common/control_interface/ci_colour.h"
#include "common/math/elementary.h"
#include "common/math/random.h"
#include "common/space/attributes.h"
#include "common/space/space.h"
#include "controller_host/devices/sensing/sight_lines.h"

namespace swarmanoid
{
namespace
{

constexpr std::uint32_t kNoSlot = 0xffffffff;
// A beam that meets nothing ends here, m.
constexpr double kLongestBeam = 30;
// These are masks of the bits of a source's fields.
constexpr std::uint32_t kRgb = 0xffffff;
constexpr std::uint32_t kParts = 0xff;

std::uint32_t ColourIn(const SparseVector<double>& attributes, std::uint32_t slot)
{
  return static_cast<std::uint32_t>(attributes[slot]);
}

}  // namespace

BlobSources::BlobSources(SensorWorld& world) : world_(world)
{
  const CSwarmanoidSpace& space = world.Space();
  for (std::uint32_t e = 0; e < space.Size(); ++e) AddEntity(e);
  bearer_of_.assign(space.Size(), -1);
  for (std::size_t b = 0; b < bearers_.size(); ++b) bearer_of_[bearers_[b].entity] = static_cast<std::int32_t>(b);
}

void BlobSources::AddEntity(std::uint32_t index)
{
  const CSwarmanoidSpaceEntity& entity = world_.Space().GetEntity(index);
  const EntityKindDescription& kind = DescriptionOf(entity.GetKind());
  const auto slot = [&](std::string_view name)
  { return AttributeOffset(entity.GetKind(), name) < 0 ? kNoSlot : entity.SlotOf(name); };
  if (kind.leds)
    bearers_.push_back({index, &kind, slot("led"), slot("beacon"), slot("turret_angle"), kNoSlot, 0,
                        LedConesOf(world_.Space().GetExperiment(), entity.GetConfiguration())});
  else if (kind.seen_by_cameras && kind.form == BodyForm::kNone)
  {
    // A picture is no blob of one colour.
    if (kind.role != EntityRole::kPatch || entity.GetConfiguration().tree.GetText("picture", "").empty())
      still_.push_back(index);
  }
  else if (kind.seen_by_cameras)
    bearers_.push_back({index, nullptr, kNoSlot, kNoSlot, kNoSlot, slot("colour"),
                        kind.origin == BodyOrigin::kBase ? entity.GetSize().z() / 2 : 0, std::nullopt});
  if (kind.mechanism == Mechanism::kPropellers) lasers_.push_back({index, slot("laser")});
}

std::shared_ptr<BlobSources> BlobSources::Of(const std::shared_ptr<SensorWorld>& world)
{
  static std::mutex mutex;
  static std::map<const SensorWorld*, std::weak_ptr<BlobSources>> all;
  const std::lock_guard lock(mutex);
  std::erase_if(all, [](const auto& entry) { return entry.second.expired(); });
  std::shared_ptr<BlobSources> sources = all[world.get()].lock();
  if (sources == nullptr)
  {
    sources = std::make_shared<BlobSources>(*world);
    sources->keeper_ = world;
    all[world.get()] = sources;
  }
  return sources;
}

void BlobSources::Refresh()
{
  const CSwarmanoidSpace& space = world_.Space();
  if (revision_ == space.Revision() && attribute_revision_ == space.AttributeRevision()) return;
  revision_ = space.Revision();
  attribute_revision_ = space.AttributeRevision();

  const SparseVector<double>& attributes = space.Attributes();
  sources_.clear();
  cones_.clear();
  lit_by_.clear();
  start_.clear();
  for (const std::uint32_t entity : world_.Grid().Sorted())
  {
    start_.push_back(static_cast<std::uint32_t>(sources_.size()));
    const std::int32_t bearer = bearer_of_[entity];
    if (bearer >= 0) AddBearer(bearers_[static_cast<std::size_t>(bearer)]);
  }
  start_.push_back(static_cast<std::uint32_t>(sources_.size()));
  for (const Bearer& bearer : bearers_)
    if (!space.GetEntity(bearer.entity).IsMovable()) AddBearer(bearer);

  for (const std::uint32_t e : still_)
  {
    const std::uint32_t colour = ColourIn(attributes, space.GetEntity(e).SlotOf("colour"));
    if (colour != 0) sources_.push_back({space.GetPose(e).position, colour & kRgb, BlobSource::kBody, e});
  }
  for (const Laser& laser : lasers_)
    if (attributes[laser.slot] != 0) AddLaserSpot(laser);

  if (!cones_.empty()) cones_.resize(sources_.size());
  hue_.resize(sources_.size());
  lowest_ = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sources_.size(); ++i)
  {
    // Neighbours mostly have one colour, such as the LEDs of a ring.
    if (i > 0 && sources_[i].colour == sources_[i - 1].colour)
      hue_[i] = hue_[i - 1];
    else
    {
      const std::uint32_t nearest = CCI_Colour::Nearest(sources_[i].colour);
      hue_[i] = static_cast<std::uint8_t>((nearest >> 14 & 4U) | (nearest >> 7 & 2U) | (nearest & 1U));
    }
    lowest_ = std::min(lowest_, sources_[i].position.z());
  }
}

std::size_t BlobSources::Collect(std::span<const std::int32_t> places, std::vector<std::int32_t>& numbers) const
{
  if (numbers.size() < sources_.size() + 1) numbers.resize(sources_.size() + 1);
  const std::uint32_t* const start = start_.data();
  std::int32_t* const to = numbers.data();
  std::size_t count = 0;
  for (const std::int32_t place : places)
  {
    // Most bodies have one source, so the first is written without a test.
    const std::uint32_t first = start[place];
    const std::uint32_t end = start[place + 1];
    to[count] = static_cast<std::int32_t>(first);
    for (std::uint32_t i = first + 1; i < end; ++i) to[count + i - first] = static_cast<std::int32_t>(i);
    count += end - first;
  }
  for (std::size_t i = start_.back(); i < sources_.size(); ++i) to[count++] = static_cast<std::int32_t>(i);
  return count;
}

std::uint64_t BlobSources::NameOf(std::size_t number) const
{
  const BlobSource& source = sources_[number];
  const bool is_spot = source.part == BlobSource::kLaserSpot;
  const std::uint32_t entity = is_spot ? lit_by_[number - (sources_.size() - lit_by_.size())] : source.owner;
  return StreamPart(world_.Names()[entity], source.part);
}

void BlobSources::AddBearer(const Bearer& bearer)
{
  if (bearer.ring != nullptr) return AddLeds(bearer);
  AddPoint(bearer.entity, {0, 0, bearer.middle}, ColourIn(world_.Space().Attributes(), bearer.colour_slot),
           BlobSource::kBody);
}

void BlobSources::AddPoint(std::uint32_t entity, const Vector3& local, std::uint32_t colour, std::uint32_t part)
{
  if (colour == 0) return;
  const PoseArrays& poses = world_.Space().Poses();
  if (!IsUpright(poses, entity))
  {
    sources_.push_back({world_.Space().GetPose(entity).Apply(local), colour & kRgb, part & kParts, entity});
    return;
  }
  const Heading heading = HeadingOf(poses, entity);
  sources_.push_back(
      {{poses.x[entity] + heading.cos * local.x() - heading.sin * local.y(),
        poses.y[entity] + heading.sin * local.x() + heading.cos * local.y(), poses.z[entity] + local.z()},
       colour & kRgb,
       part & kParts,
       entity});
}

void BlobSources::AddLeds(const Bearer& bearer)
{
  const LedLayout& ring = *bearer.ring->leds;
  const SparseVector<double>& attributes = world_.Space().Attributes();
  const double* leds = attributes.Part(bearer.led_slot, ring.places.size()).data();
  const auto count = ring.places.size();
  if (bearer.beacon_slot != kNoSlot)
    AddPoint(bearer.entity, {0, 0, *bearer.ring->beacon_height_m}, ColourIn(attributes, bearer.beacon_slot),
             BlobSource::kBeacon);

  if (bearer.cones) return AddDirectionalLeds(bearer);

  const auto differs = [&](double value) { return value != leds[0]; };
  if (std::none_of(leds + 1, leds + count, differs))
    return AddPoint(bearer.entity, {0, 0, ring.height_m}, static_cast<std::uint32_t>(leds[0]), BlobSource::kFirstLed);

  SinCos turret{0, 1};
  if (ring.on_turret) turret = SinCosOf(attributes[bearer.turret_slot]);
  for (std::size_t i = 0; i < count; ++i)
  {
    if (leds[i] == 0 || std::find(leds, leds + i, leds[i]) != leds + i) continue;
    Vector2 sum = Vector2::Zero();
    int lit = 0;
    for (std::size_t j = i; j < count; ++j)
      if (leds[j] == leds[i])
      {
        sum += ring.places[j];
        ++lit;
      }
    const Vector2 middle = sum / lit;
    AddPoint(bearer.entity,
             {turret.cos * middle.x() - turret.sin * middle.y(), turret.sin * middle.x() + turret.cos * middle.y(),
              ring.height_m},
             static_cast<std::uint32_t>(leds[i]), static_cast<std::uint32_t>(BlobSource::kFirstLed + i));
  }
}

void BlobSources::AddDirectionalLeds(const Bearer& bearer)
{
  const LedLayout& ring = *bearer.ring->leds;
  const SparseVector<double>& attributes = world_.Space().Attributes();
  const double* leds = attributes.Part(bearer.led_slot, ring.places.size()).data();
  SinCos turret{0, 1};
  if (ring.on_turret) turret = SinCosOf(attributes[bearer.turret_slot]);
  const auto turned = [&](double x, double y, double z)
  { return Vector3(turret.cos * x - turret.sin * y, turret.sin * x + turret.cos * y, z); };
  const PoseArrays& poses = world_.Space().Poses();
  const std::uint32_t entity = bearer.entity;
  const bool is_upright = IsUpright(poses, entity);
  const Heading heading = HeadingOf(poses, entity);
  const Pose pose = world_.Space().GetPose(entity);
  // The quaternion of an upright robot has x = y = 0, which shortens the product.
  const auto in_space = [&](const Vector3& way) -> Vector3
  {
    if (!is_upright) return pose.orientation * way;
    const double z = pose.orientation.z(), w = pose.orientation.w();
    const double x2 = -z * way.y() + -z * way.y();
    const double y2 = z * way.x() + z * way.x();
    return {way.x() + w * x2 - z * y2, way.y() + w * y2 + z * x2, way.z()};
  };
  const auto place_of = [&](const Vector3& local) -> Vector3
  {
    if (!is_upright) return pose.Apply(local);
    return {pose.position.x() + heading.cos * local.x() - heading.sin * local.y(),
            pose.position.y() + heading.sin * local.x() + heading.cos * local.y(), pose.position.z() + local.z()};
  };
  for (std::size_t i = 0; i < ring.places.size(); ++i)
  {
    const auto colour = static_cast<std::uint32_t>(leds[i]);
    if (colour == 0) continue;
    const Vector3& axis = bearer.cones->axes[i];
    cones_.resize(sources_.size());
    sources_.push_back({place_of(turned(ring.places[i].x(), ring.places[i].y(), ring.height_m)), colour & kRgb,
                        static_cast<std::uint32_t>(BlobSource::kFirstLed + i) & kParts, entity});
    cones_.push_back({in_space(turned(axis.x(), axis.y(), axis.z())), bearer.cones->cosine});
  }
}

// The beam leaves the middle of the eyebot's base; tilt 0 is straight down. It ends at the first body, whatever its
// engine, or on the floor.
void BlobSources::AddLaserSpot(const Laser& laser)
{
  const SparseVector<double>& attributes = world_.Space().Attributes();
  const std::uint32_t colour = ColourIn(attributes, laser.slot + 1);
  if (colour == 0) return;
  const SinCos pan = SinCosOf(attributes[laser.slot + 2]);
  const SinCos tilt = SinCosOf(attributes[laser.slot + 3]);
  const Pose pose = world_.Space().GetPose(laser.entity);
  const Vector3 from = pose.position;
  const Vector3 beam = pose.orientation * Vector3(tilt.sin * pan.cos, tilt.sin * pan.sin, -tilt.cos);
  const bool reaches_floor = beam.z() < 0 && from.z() + kLongestBeam * beam.z() <= 0;
  const double length = reaches_floor ? std::max(from.z() / -beam.z(), 0.0) : kLongestBeam;
  const Vector3 to = from + length * beam;
  const double hit = world_.FirstHit(from, to, [&](std::uint32_t body) { return body != laser.entity; });
  if (hit > 1 && !reaches_floor) return;
  sources_.push_back(
      {from + std::min(hit, 1.0) * (to - from), colour & kRgb, BlobSource::kLaserSpot, SightLines::kNobody});
  lit_by_.push_back(laser.entity);
}

}  // namespace swarmanoid
