// Problem: 24 rays for each of many robots against all bodies near it. It is the most frequent sensor, so that its cost
// decides the speed of large swarms.
//
// Method: robots are taken in the order of the grid's cells, and bodies near several robots are searched for at once.
// In a swarm of upright bodies without moving parts, neighbours are remembered while MovedSince holds. Without noise,
// readings are stored only for robots whose rays met something; all others share one array of zeros.
//
// Invariants: readings follow from the poses of the tick, and noise from streams named by robot and tick. So neither
// the order of robots nor the set of robots that are due changes a bit. Prefetches are hints only.
#include "controller_host/devices/footbot/footbot_proximity.h"

#include <algorithm>
#include <array>
#include <optional>

#include "common/plugin_descriptions/device_tables.h"
#include "common/space/space.h"
#include "controller_host/devices/device_plugins.h"

namespace swarmanoid
{
namespace
{

constexpr unsigned kRays = FootbotProximityRays::kRays;

// The response of ARGoS3's foot-bot proximity sensor: the distance of full response, and the hyperbola beyond it.
constexpr double kContactDistance = 0.009889556;
constexpr double kHyperbolaScale = 0.0100527;
constexpr double kHyperbolaOffset = 0.000163144;

constexpr std::size_t kAhead = 8;      // robots, whose memory is fetched early
constexpr std::size_t kDisturbed = 8;  // at once

}  // namespace

void FootbotProximity::Init(const DeviceSetup& setup)
{
  world_ = SensorWorld::Of(setup.space);
  robots_ = setup.robots;
  streams_ = DeviceStreams(setup);
  noise_ = NoiseFrom(setup.parameters);
  rays_.Configure(robots_.empty() ? 0 : world_->Body(robots_.front()).radius, setup.parameters.Number("range"));
  // A tilted robot's rays start up to kHeight beside its base.
  fixed_ = std::make_unique<FixedBodies>(setup.space, world_->Bodies(), rays_.Reach() + kHeight);

  remembers_ = !world_->HasArticulated();
  if (remembers_)
    fixed_for_long_ = std::make_unique<FixedBodies>(setup.space, world_->Bodies(),
                                                    rays_.Reach() + kHeight + MovedSince::kMostMargin / 2);

  sensors_.reserve(robots_.size());
  in_one_run_ = !robots_.empty() && robots_.back() - robots_.front() + 1 == robots_.size();
  if (!in_one_run_) place_of_entity_.assign(setup.space.Size(), -1);
  number_.resize(robots_.size() + kLanes);
  place_.resize(robots_.size() + kLanes);
  blocks_.reserve(robots_.size() / kBlock + 1);
  saw_.assign(robots_.size(), 0);
  for (std::size_t k = 0; k < robots_.size(); ++k)
  {
    if (!in_one_run_) place_of_entity_[robots_[k]] = static_cast<std::int32_t>(k);
    sensors_.emplace_back(*this, k);
  }
  InitDemand(robots_.size());
}

void FootbotProximity::RefreshShared(WorkerPool* pool)
{
  if (remembers_) world_->Moved().Follow(pool);
  if (!KnowsNear()) world_->Refresh(pool);
}

bool FootbotProximity::KnowsNear() const
{
  return remembers_ && world_->Moved().Holds() && near_since_ == world_->Moved().Number();
}

void FootbotProximity::MakeDue()
{
  if (remembers_ && !KnowsNear() && world_->Moved().IsNow()) FindNear();
  if (KnowsNear())
    SenseNear();
  else
    SenseAll();
  if (noise_.IsActive()) Disturb();
}

void FootbotProximity::SenseAll()
{
  // Robots are listed in the order of the grid's cells, so that their neighbours stay in the cache. The sensor's own
  // data has no such order.
  ListOwn(AllAreDue());
  if (world_->Grid().AllUpright())
    for (std::size_t first = 0; first < listed_; first += kLanes)
      SenseUpright(first, std::min<std::size_t>(first + kLanes, listed_));
  else
    for (std::size_t listed = 0; listed < listed_; ++listed) Sense(listed);
}

void FootbotProximity::Forget()
{
  if (seeing_.empty()) return;
  std::fill(saw_.begin(), saw_.end(), 0);
  for (const std::uint32_t k : seeing_)
  {
    sensors_[k].Show(kNoReadings.values);
    saw_[k] = 1;
  }
  seeing_.clear();
  disturbed_ = 0;
}

double* FootbotProximity::NewReadings(std::size_t k)
{
  const std::size_t place = seeing_.size();
  if (place == blocks_.size() * kBlock) blocks_.push_back(std::make_unique<FootbotProximityRays::Values[]>(kBlock));
  seeing_.push_back(static_cast<std::uint32_t>(k));
  double* const readings = ReadingsAt(place);
  sensors_[k].Show(readings);
  return readings;
}

void FootbotProximity::Expose(std::size_t k, ExposedValues& values)
{
  if (sensors_[k].Shown() == kNoReadings.values)
  {
    std::fill_n(NewReadings(k), kRays, 0.0);
    disturbed_ = seeing_.size();  // the others have their noise, since Update ends with it
  }
  // All other readings are in blocks_, which may be changed.
  values.Add({const_cast<double*>(sensors_[k].Shown()), kRays});
}

void FootbotProximity::FindNear()
{
  const NeighbourGrid& grid = world_->Grid();
  near_since_ = world_->Moved().Number();
  ListOwn(true);
  surroundings_.clear();
  near_.clear();
  const double reach = rays_.Reach() + world_->Moved().Margin();
  const bool sees_more = noise_.IsActive() || !world_->Terrain().IsEmpty();
  CellWindows windows;
  std::array<std::int32_t, kLanes> fixed_cells;
  for (std::size_t first = 0; first < listed_; first += kLanes)
  {
    grid.FindWindows(&place_[first], reach, windows);
    fixed_for_long_->FindCells(grid, &place_[first], fixed_cells.data());
    for (std::size_t lane = 0; lane < std::min<std::size_t>(kLanes, listed_ - first); ++lane)
    {
      const auto begin = static_cast<std::uint32_t>(near_.size());
      grid.ForEachOtherNear(static_cast<std::size_t>(place_[first + lane]), reach, windows, lane,
                            [&](std::size_t other) { near_.push_back(grid.Sorted()[other]); });
      const auto fixed_begin = static_cast<std::uint32_t>(near_.size());
      for (const std::uint32_t body : fixed_for_long_->InCell(fixed_cells[lane]))
        if (!StaysBeyond(robots_[number_[first + lane]], body)) near_.push_back(body);
      const std::uint32_t count = static_cast<std::uint32_t>(near_.size()) - begin;
      if (count > 0 || sees_more) surroundings_.push_back({number_[first + lane], begin, count, fixed_begin});
    }
  }
  std::ranges::sort(surroundings_, {}, &Surroundings::k);
}

bool FootbotProximity::StaysBeyond(std::uint32_t robot, std::uint32_t body) const
{
  const PoseArrays& poses = world_->Space().Poses();
  const BodyShape& shape = world_->Body(body);
  if (shape.kind != Shape::Kind::kBox || !IsUpright(poses, body)) return false;
  constexpr double kRounding = 1e-9;  // m
  return PlaceBesideBox(poses, body, shape.half_size, poses.x[robot], poses.y[robot])
      .IsBeyond(rays_.Reach() + world_->Moved().Margin() / 2 + kRounding);
}

void FootbotProximity::SenseNear()
{
  const PoseArrays& poses = world_->Space().Poses();
  const std::uint32_t first = robots_.empty() ? 0 : robots_.front();
  const bool all = AllAreDue();
  for (std::size_t n = 0; n < surroundings_.size(); ++n)
  {
    const Surroundings& later = surroundings_[std::min(n + kAhead, surroundings_.size() - 1)];
    if (later.count > 0)
    {
      const std::uint32_t body = near_[later.first];
      __builtin_prefetch(&poses.x[body]);
      __builtin_prefetch(&poses.y[body]);
      __builtin_prefetch(&poses.z[body]);
    }
    const Surroundings& own = surroundings_[n];
    if (!all && !IsDue(own.k)) continue;
    const std::uint32_t robot = in_one_run_ ? first + own.k : robots_[own.k];
    const Vector3 sensors(poses.x[robot], poses.y[robot], poses.z[robot] + kHeight);
    rays_.Reset();
    for (std::uint32_t i = own.first; i < own.first + own.count; ++i)
    {
      const std::uint32_t body = near_[i];
      const BodyShape& shape = world_->Body(body);
      const double dx = poses.x[body] - sensors.x();
      const double dy = poses.y[body] - sensors.y();
      const double reach = rays_.Reach() + shape.radius;
      if (i < own.fixed && dx * dx + dy * dy > reach * reach) continue;
      LookAt(robot, sensors, true, body, shape, {poses.x[body], poses.y[body], poses.z[body]}, IsUpright(poses, body));
    }
    if (!world_->Terrain().IsEmpty()) AddTerrain(robot);
    FinishReadings(own.k);
  }
}

void FootbotProximity::ListOwn(bool all)
{
  const std::span<const std::uint32_t> sorted = world_->Grid().Sorted();
  listed_ = 0;
  const auto list_those = [&](const auto& number_of, const auto& is_due)
  {
    // The loop has no branch, since robots of another batch come in an unpredictable order.
    for (std::size_t place = 0; place < sorted.size(); ++place)
    {
      const std::uint32_t k = number_of(sorted[place]);
      number_[listed_] = k;
      place_[listed_] = static_cast<std::int32_t>(place);
      listed_ += k < robots_.size() && is_due(k) ? 1 : 0;
    }
  };
  const auto list = [&](const auto& number_of)
  {
    if (all)
      list_those(number_of, [](std::uint32_t) { return true; });
    else
      list_those(number_of, [this](std::uint32_t k) { return IsDue(k); });
  };
  if (in_one_run_)
    list([first = robots_.front()](std::uint32_t entity) { return entity - first; });
  else
    list([this](std::uint32_t entity) { return static_cast<std::uint32_t>(place_of_entity_[entity]); });
}

void FootbotProximity::Prefetch(std::size_t later) const
{
  if (later + kAhead >= listed_) return;
  __builtin_prefetch(&saw_[number_[later + kAhead]]);
  const std::uint32_t k = number_[later];
  if (!saw_[k]) return;
  // Neighbours rarely change between ticks, so the last tick's neighbours are prefetched.
  __builtin_prefetch(&sensors_[k], 1);
  const PoseArrays& poses = world_->Space().Poses();
  __builtin_prefetch(&poses.qz[robots_[k]]);
  __builtin_prefetch(&poses.qw[robots_[k]]);
}

void FootbotProximity::SenseUpright(std::size_t first, std::size_t last)
{
  const NeighbourGrid& grid = world_->Grid();
  const PoseArrays& poses = world_->Space().Poses();
  const BodyShape* const shape_of_all = grid.ShapeOfAll();
  const double* const origin_x = grid.OriginX();
  const double* const origin_y = grid.OriginY();
  const double* const origin_z = grid.OriginZ();
  const double reach = rays_.Reach();
  CellWindows windows;
  std::array<std::int32_t, kLanes> fixed_cells;
  grid.FindWindows(&place_[first], reach, windows);
  fixed_->FindCells(grid, &place_[first], fixed_cells.data());
  for (std::size_t listed = first; listed < last; ++listed)
  {
    Prefetch(listed + kAhead);
    const auto place = static_cast<std::size_t>(place_[listed]);
    const std::uint32_t k = number_[listed];
    rays_.Reset();
    grid.ForEachOtherNear(place, reach, windows, listed - first,
                          [&](std::size_t other)
                          {
                            const std::uint32_t body = grid.Sorted()[other];
                            LookAt(robots_[k], {origin_x[place], origin_y[place], origin_z[place] + kHeight}, true,
                                   body, shape_of_all != nullptr ? *shape_of_all : world_->Body(body),
                                   {origin_x[other], origin_y[other], origin_z[other]}, true);
                          });
    for (const std::uint32_t body : fixed_->InCell(fixed_cells[listed - first]))
      LookAt(robots_[k], {origin_x[place], origin_y[place], origin_z[place] + kHeight}, true, body, world_->Body(body),
             {poses.x[body], poses.y[body], poses.z[body]}, IsUpright(poses, body));
    if (!world_->Terrain().IsEmpty()) AddTerrain(robots_[k]);
    if (rays_.Touched() || noise_.IsActive()) FinishReadings(k);
  }
}

void FootbotProximity::Sense(std::size_t listed)
{
  const NeighbourGrid& grid = world_->Grid();
  const PoseArrays& poses = world_->Space().Poses();
  const std::uint32_t k = number_[listed];
  const std::uint32_t robot = robots_[k];
  const auto place = static_cast<std::size_t>(place_[listed]);
  const bool upright = IsUpright(poses, robot);
  const Vector3 sensors(grid.OriginX()[place], grid.OriginY()[place], grid.OriginZ()[place] + kHeight);
  rays_.Reset();
  grid.ForEachNear(sensors.x(), sensors.y(), rays_.Reach() + (upright ? 0 : kHeight),
                   [&](std::uint32_t body)
                   {
                     if (body != robot)
                       LookAt(robot, sensors, upright, body, world_->Body(body),
                              {poses.x[body], poses.y[body], poses.z[body]}, IsUpright(poses, body));
                   });
  for (const std::uint32_t body : fixed_->Near(sensors.x(), sensors.y()))
    LookAt(robot, sensors, upright, body, world_->Body(body), {poses.x[body], poses.y[body], poses.z[body]},
           IsUpright(poses, body));
  if (!world_->Terrain().IsEmpty()) AddTerrain(robot);
  FinishReadings(k);
}

void FootbotProximity::LookAt(std::uint32_t robot, const Vector3& sensors, bool upright, std::uint32_t body,
                              const BodyShape& shape, const Vector3& at, bool body_upright)
{
  const EngineMembership& membership = world_->Membership();
  if (!membership.IsOneWorld() && !membership.ShareEngine(robot, body)) return;
  if (world_->IsArticulated(body)) return AddParts(robot, body);
  if (!upright || !body_upright) return AddAny(robot, shape, world_->Space().GetPose(body));
  if (sensors.z() < at.z() + shape.low || sensors.z() > at.z() + shape.high) return;
  if (shape.kind == Shape::Kind::kCylinder)
    return rays_.AddDisc(world_->Space().Poses(), robot, at.x() - sensors.x(), at.y() - sensors.y(), shape.radius);
  rays_.AddUprightBox(world_->Space().Poses(), robot, body, shape.half_size);
}

// Computes the readings of a robot from its distances, if its rays met a body.
void FootbotProximity::FinishReadings(std::size_t k)
{
  if (!rays_.Touched() && !noise_.IsActive()) return;
  double* const readings = NewReadings(k);
  if (rays_.Touched())
  {
    Respond(rays_.Distances(), readings);
    for (unsigned i = 0; i < kRays; ++i) readings[i] = std::clamp(readings[i], 0.0, 1.0);
  }
  else
    std::fill_n(readings, kRays, 0.0);

  if (noise_.IsActive() && seeing_.size() - disturbed_ == kDisturbed) Disturb();
}

void FootbotProximity::Disturb()
{
  const std::span<const std::uint32_t> robots = std::span(seeing_).subspan(disturbed_);
  std::array<double, kDisturbed * kRays> noise;
  streams_.Sample(noise_, robots, std::span(noise).first(robots.size() * kRays));
  for (std::size_t n = 0; n < robots.size(); ++n)
  {
    double* const readings = ReadingsAt(disturbed_ + n);
    for (unsigned i = 0; i < kRays; ++i) readings[i] = std::clamp(readings[i] + noise[n * kRays + i], 0.0, 1.0);
  }
  disturbed_ = seeing_.size();
}

// The parts are the engine's collision bodies: a handbot's arms, a hull.
void FootbotProximity::AddParts(std::uint32_t robot, std::uint32_t body)
{
  const Pose pose = world_->Space().GetPose(body);
  for (const CollisionBody& part : world_->PartsOf(body))
    if (part.hull != nullptr)
      AddRays(robot, pose.position, ReachOf(part),
              [&](const Vector3& from, const Vector3& to) {
                return SegmentHit({&part, 1}, pose, from, to);
              });
    else
      AddAny(robot, {part.is_cylinder ? Shape::Kind::kCylinder : Shape::Kind::kBox, Vector3::Zero(), part.half_size},
             pose.Compose(part.pose));
}

// Adds any body in any orientation: each ray is a segment in the space.
void FootbotProximity::AddAny(std::uint32_t robot, const Shape& shape, const Pose& other)
{
  AddRays(robot, other.Apply(shape.centre), BoundingRadius(shape),
          [&](const Vector3& from, const Vector3& to) { return SegmentHit(shape, other, from, to); });
}

// hit_of(from, to) returns the part of the way between two points at which a body within `radius` of `centre` is met.
template <class HitOf>
void FootbotProximity::AddRays(std::uint32_t robot, const Vector3& centre, double radius, const HitOf& hit_of)
{
  const Pose own = world_->Space().GetPose(robot);
  const double reach = rays_.Reach() + radius;
  if ((own.Apply({0, 0, kHeight}) - centre).squaredNorm() > reach * reach) return;
  rays_.AddInSpace(own, hit_of);
}

void FootbotProximity::AddTerrain(std::uint32_t robot)
{
  const auto is_there = [&](std::uint32_t terrain) { return world_->Membership().ShareEngine(robot, terrain); };
  rays_.AddInSpace(world_->Space().GetPose(robot),
                   [&](const Vector3& from, const Vector3& to)
                   {
                     const double hit = world_->Terrain().FirstHit(from, to, is_there);
                     return hit > 1 ? std::nullopt : std::optional(hit);
                   });
}

void RayCastProximity::Respond(const double* distances, double* readings) const
{
  for (unsigned i = 0; i < kRays; ++i)
  {
    // The quotient is 0 if nothing was hit.
    const double reading = kHyperbolaScale / (distances[i] + kHyperbolaOffset);
    readings[i] = distances[i] < kContactDistance ? 1 : reading;
  }
}

void PolynomialProximity::Init(const DeviceSetup& setup)
{
  FootbotProximity::Init(setup);
  for (const ConfigurationError& mistake : MistakesInPolynomial(setup.parameters)) throw mistake;
  coefficients_ = *ParseNumbers(setup.parameters.Text("coefficients"));
}

void PolynomialProximity::Respond(const double* distances, double* readings) const
{
  for (unsigned i = 0; i < kRays; ++i) readings[i] = coefficients_.back();
  for (std::size_t c = coefficients_.size() - 1; c-- > 0;)
    for (unsigned i = 0; i < kRays; ++i)
      readings[i] = readings[i] * (distances[i] <= Range() ? distances[i] : 0) + coefficients_[c];
  for (unsigned i = 0; i < kRays; ++i) readings[i] = distances[i] <= Range() ? readings[i] : 0;
}

const DeviceCode kFootbotProximityCode(
    []
    {
      BindSensor<RayCastProximity>("footbot_proximity", "generic_footbot_proximity");
      BindSensor<PolynomialProximity>("footbot_proximity", "generic_footbot_polynomial_proximity");
    });

}  // namespace swarmanoid
