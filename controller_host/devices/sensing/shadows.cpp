// Problem: for each source of light, find the robots that see it among many bodies, with the answers of an exact test
// of every body.
//
// Method: bodies around the source are sorted into sectors of direction, and into rings of distance in each sector. A
// body that touches several sectors is listed in all. A robot looks only at the cells of its own sector between the
// distances at which its line is as high as any body. A test in single precision, widened by MarginAt, leaves few
// candidates, which get the exact test. If all bodies are equal upright cylinders, a narrowed test already decides most
// hits. A few bodies are not sorted: each robot looks at all of them. Bodies that never move have one list for each
// sector, sorted by their nearest point, with the distances of the part of the body that is in the sector.
//
// Invariant: every rounding widens the set of candidates, so no body that hides the source is missed.
#include "controller_host/devices/sensing/shadows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

// The margin (m) is more than the rounding of single precision at this distance.
float MarginAt(float distance) { return 2e-5F + 2e-6F * distance; }
FloatLanes MarginAt(FloatLanes distance) { return 2e-5F + 2e-6F * distance; }

constexpr float kThin = 1e-5F;  // m, far beyond the rounding of heights

// The parts 0..1 of the way from a source to a point `rise` m above it that lie between two heights above the source.
struct Part
{
  float first, last;
};
Part PartBetween(float low, float high, float rise)
{
  constexpr float kTiny = 1e-20F;  // a level way: the quotients become huge, not NaN
  if (rise == 0) rise = kTiny;
  const float a = low / rise;
  const float b = high / rise;
  return {std::max(std::min(a, b), 0.0F), std::min(std::max(a, b), 1.0F)};
}

// How far a place lies to the left of a vector, times the length of that.
double LeftOf(const Vector2& border, const Vector2& at) { return border.x() * at.y() - border.y() * at.x(); }

// Cuts off what lies to the right of a vector, from a convex polygon around which the corners stand in order.
void CutOffRight(const Vector2& border, std::vector<Vector2>& corners)
{
  std::vector<Vector2> kept;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const Vector2& from = corners[i];
    const Vector2& to = corners[(i + 1) % corners.size()];
    const double a = LeftOf(border, from);
    const double b = LeftOf(border, to);
    if (a >= 0) kept.push_back(from);
    if ((a < 0) != (b < 0)) kept.push_back(from + (to - from) * (a / (a - b)));
  }
  corners = std::move(kept);
}

double DistanceToSide(const Vector2& from, const Vector2& to)
{
  const Vector2 side = to - from;
  const double length = side.squaredNorm();
  const double part = length > 0 ? std::clamp(-from.dot(side) / length, 0.0, 1.0) : 0;
  return (from + part * side).norm();
}

// Returns the distances from the origin to the nearest and to the farthest point of a polygon.
std::array<double, 2> Distances(const std::vector<Vector2>& corners)
{
  double near = 1e300;
  double far = 0;
  double winding_left = 0, winding_right = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const Vector2& from = corners[i];
    const Vector2& to = corners[(i + 1) % corners.size()];
    near = std::min(near, DistanceToSide(from, to));
    far = std::max(far, from.norm());
    const double turn = from.x() * to.y() - from.y() * to.x();
    (turn < 0 ? winding_right : winding_left) += 1;
  }
  if (winding_right == 0 || winding_left == 0) near = 0;  // the origin is inside
  return {near, far};
}

// The extent of a body from its origin, along the xy plane and in height, at any tilt.
struct Reach
{
  double radius, low, high;
};
Reach ReachOfBody(const SensorWorld& world, std::uint32_t entity)
{
  const BodyShape& body = world.Body(entity);
  if (IsUpright(world.Space().Poses(), entity) && !world.IsArticulated(entity))
    return {body.radius, body.low, body.high};
  const double all = world.IsArticulated(entity) ? body.radius : BoundingRadius(body) + body.centre.norm();
  return {all, -all, all};
}

}  // namespace

IntLanes Sectors::Of(FloatLanes turn) const
{
  const auto count = static_cast<float>(count_);
  return Truncated(turn * (count / 4) + count) - count_;  // rounded down
}

FloatLanes Sectors::TurnOf(FloatLanes x, FloatLanes y)
{
  const FloatLanes sum = Magnitude(x) + Magnitude(y);
  FloatLanes turn = y / Maximum(sum, Everywhere(1e-30F));
  turn = x < 0 ? 2 - turn : turn;
  return turn < 0 ? turn + 4 : turn;
}

Vector2 Sectors::Border(std::size_t sector) const
{
  const double turn = 4.0 * static_cast<double>(sector) / count_;
  const double part = turn - std::floor(turn);
  switch (static_cast<int>(turn) % 4)
  {
    case 0:
      return {1 - part, part};
    case 1:
      return {-part, 1 - part};
    case 2:
      return {part - 1, -part};
    default:
      return {part, part - 1};
  }
}

void SightedPoints::Reserve(std::size_t points)
{
  for (std::vector<double>* values : {&x, &y, &z}) values->resize(points + kLanes);
  robot.resize(points + kLanes);
}

void FixedShadows::Place(const SensorWorld& world, const Vector3& source)
{
  if (source == source_) return;
  source_ = source;
  bodies_.assign(sectors_.Count(), {});
  const CSwarmanoidSpace& space = world.Space();
  for (std::uint32_t entity = 0; entity < space.Size(); ++entity)
    if (!space.GetEntity(entity).IsMovable() && world.Body(entity).kind != Shape::Kind::kNone) Add(world, entity);
  for (std::vector<Body>& bodies : bodies_) std::ranges::stable_sort(bodies, {}, &Body::near);
  nearest_.clear();
  for (const std::vector<Body>& bodies : bodies_)
    nearest_.push_back(bodies.empty() ? std::numeric_limits<float>::infinity() : bodies.front().near);
}

IntLanes FixedShadows::MayHide(IntLanes sector, FloatLanes length) const
{
  return Gathered(nearest_.data(), sector) <= length + MarginAt(length);
}

void FixedShadows::Add(const SensorWorld& world, std::uint32_t entity)
{
  const Pose pose = world.Space().GetPose(entity);
  const BodyShape& shape = world.Body(entity);
  const Reach reach = ReachOfBody(world, entity);
  const bool is_box = shape.kind == Shape::Kind::kBox && IsUpright(world.Space().Poses(), entity);
  const Vector2 centre = (pose.position - source_).head<2>();
  std::vector<Vector2> outline;
  for (int corner = 0; corner < 4; ++corner)
  {
    // Bodies other than upright boxes get the square around them, slightly wider than the rounding of directions.
    const double wider = 1e-4 + 2e-6 * centre.norm();
    const double x = (is_box ? shape.half_size.x() : reach.radius) + wider;
    const double y = (is_box ? shape.half_size.y() : reach.radius) + wider;
    const Vector3 place(corner == 0 || corner == 3 ? x : -x, corner < 2 ? y : -y, 0);
    const Vector3 turned = is_box ? Vector3(pose.orientation * place) : place;
    outline.push_back(centre + turned.head<2>());
  }
  const auto rise = static_cast<float>(pose.position.z() - source_.z());
  double around = 0;
  for (const Vector2& corner : outline) around = std::max(around, (corner - centre).norm());
  for (std::size_t sector = 0; sector < sectors_.Count(); ++sector)
  {
    const Vector2 right = sectors_.Border(sector);
    const Vector2 left = sectors_.Border((sector + 1) % sectors_.Count());
    if (LeftOf(right, centre) < -around * right.norm() || LeftOf(left, centre) > around * left.norm()) continue;
    std::vector<Vector2> part = outline;
    CutOffRight(right, part);
    CutOffRight(-left, part);
    if (part.size() < 3) continue;
    const auto [near, far] = Distances(part);
    bodies_[sector].push_back({static_cast<float>(near), static_cast<float>(far),
                               rise + static_cast<float>(reach.low) - kThin,
                               rise + static_cast<float>(reach.high) + kThin, entity});
  }
}

bool FixedShadows::Hide(const SensorWorld& world, std::uint32_t robot, const Vector3& point, std::size_t sector,
                        float length) const
{
  const auto rise = static_cast<float>(point.z() - source_.z());
  const float margin = MarginAt(length);
  for (const Body& body : bodies_[sector])
  {
    if (body.near > length + margin) return false;
    const Part part = PartBetween(body.low, body.high, rise);
    if (part.first > part.last || body.near > part.last * length + margin || body.far < part.first * length - margin)
      continue;
    if (world.CanHideFrom(robot, body.entity) && world.HitOn(body.entity, point, source_)) return true;
  }
  return false;
}

MovingShadows::MovingShadows(const SensorWorld& world) : world_(world)
{
  std::size_t bodies = 0;
  const CSwarmanoidSpace& space = world.Space();
  std::vector<std::size_t> in_engine(space.GetExperiment().engines.size());
  for (const std::uint32_t entity : space.Movable())
  {
    if (world.Body(entity).kind == Shape::Kind::kNone) continue;
    ++bodies;
    for (std::size_t e = 0; e < in_engine.size(); ++e)
      in_engine[e] += std::ranges::binary_search(space.GetExperiment().engines[e].entities, entity) ? 1 : 0;
  }
  share_engines_ = std::ranges::all_of(in_engine, [&](std::size_t count) { return count == 0 || count == bodies; }) &&
                   std::ranges::find(in_engine, bodies) != in_engine.end();
}

IntLanes MovingShadows::RingOf(FloatLanes distance) const
{
  const FloatLanes ring = distance * rings_per_m_;
  return Truncated(Minimum(Maximum(ring, FloatLanes{}), Everywhere(static_cast<float>(kRings - 1))));
}

void MovingShadows::Sort(const Vector3& source, double reach)
{
  const NeighbourGrid& grid = world_.Grid();
  const std::span<const std::uint32_t> bodies = grid.Sorted();
  const std::size_t count = bodies.size();
  source_ = source;
  are_exact_ = share_engines_ && grid.AllUpright() && grid.AllCylinders() && grid.AreAlike();
  for (std::vector<float>* values : {&body_x_, &body_y_, &body_radius_}) values->resize(count + kLanes);

  FloatLanes farthest{};
  for (std::size_t i = 0; i < count; i += kLanes)
  {
    const FloatLanes x = Differences(grid.OriginX() + i, source.x());
    const FloatLanes y = Differences(grid.OriginY() + i, source.y());
    StoreLanes(x, &body_x_[i]);
    StoreLanes(y, &body_y_[i]);
    farthest = Maximum(farthest, FirstLanes(count - i) ? x * x + y * y : FloatLanes{});
  }
  if (are_exact_ && count > 0)
  {
    const BodyShape& body = world_.Body(bodies[0]);
    const double rise = grid.OriginZ()[0] - source.z();
    low_ = static_cast<float>(rise + body.low);
    high_ = static_cast<float>(rise + body.high);
    largest_ = static_cast<float>(body.radius);
    std::ranges::fill(body_radius_, largest_);
  }
  else
  {
    low_ = 1e30F;
    high_ = -1e30F;
    largest_ = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      const Reach body = ReachOfBody(world_, bodies[i]);
      const double rise = grid.OriginZ()[i] - source.z();
      low_ = std::min(low_, static_cast<float>(rise + body.low));
      high_ = std::max(high_, static_cast<float>(rise + body.high));
      body_radius_[i] = static_cast<float>(body.radius);
      largest_ = std::max(largest_, body_radius_[i]);
    }
  }
  reach_ = static_cast<float>(reach);
  reach_ += MarginAt(reach_);
  are_few_ = count <= kFew;
  if (are_few_) return ListAll(bodies);

  // A sector holds about eight bodies.
  constexpr std::size_t kBodies = 8, kFewest = 8, kMost = 4096;
  sectors_ = Sectors(std::clamp(std::bit_ceil(count / kBodies + 1), kFewest, kMost));
  rings_per_m_ = kRings / std::max(1e-3F, std::min(__builtin_sqrtf(Highest(farthest)), reach_));
  std::size_t listed = 0;
  for (std::size_t group = 0; group < count; group += kLanes)
  {
    const std::size_t most = listed + kLanes * sectors_.Count();
    if (members_.size() < most) members_.resize(2 * most);
    std::uint32_t* const cells = sort_.Cells(members_.size()).data();
    std::uint32_t* const members = members_.data();
    const FloatLanes x = LoadLanes(&body_x_[group]);
    const FloatLanes y = LoadLanes(&body_y_[group]);
    const FloatLanes square = x * x + y * y;
    const FloatLanes distance = SquareRoot(square);
    const FloatLanes radius = LoadLanes(&body_radius_[group]) * 1.0001F + 2 * MarginAt(distance);
    // The slopes of the tangents on both sides. A body that is nearer than this covers all directions.
    const IntLanes is_around = distance <= radius * 1.01F;
    const FloatLanes slope = radius / SquareRoot(is_around ? Everywhere(1.0F) : square - radius * radius);
    constexpr float kAside = 8e-6F;
    const IntLanes first = sectors_.Of(Sectors::TurnOf(x + slope * y, y - slope * x) - kAside);
    IntLanes last = sectors_.Of(Sectors::TurnOf(x - slope * y, y + slope * x) + kAside);
    last = last < first ? last + static_cast<int>(sectors_.Count()) : last;
    last = is_around ? first + static_cast<int>(sectors_.Count() - 1) : last;
    const IntLanes ring = RingOf(distance);
    const unsigned counts = LaneMask((distance - radius <= reach_) & FirstLanes(count - group));
    ForEachBit(counts,
               [&](unsigned lane)
               {
                 for (int sector = first[lane]; sector <= last[lane]; ++sector)
                 {
                   cells[listed] = static_cast<std::uint32_t>((sector & sectors_.Last()) * kRings + ring[lane]);
                   members[listed++] = static_cast<std::uint32_t>(group + lane);
                 }
               });
  }
  sort_.SetCells(sectors_.Count() * kRings);
  sort_.Cells(listed);
  for (std::vector<float>* values : {&x_, &y_, &radius_}) values->resize(listed + kLanes);
  entity_.resize(listed + kLanes);
  sort_.Sort(
      [&](std::size_t member, std::uint32_t place)
      {
        const std::uint32_t body = members_[member];
        x_[place] = body_x_[body];
        y_[place] = body_y_[body];
        radius_[place] = body_radius_[body];
        entity_[place] = static_cast<std::int32_t>(bodies[body]);
      });
}

void MovingShadows::ListAll(std::span<const std::uint32_t> bodies)
{
  x_.assign(body_x_.begin(), body_x_.end());
  y_.assign(body_y_.begin(), body_y_.end());
  radius_.assign(body_radius_.begin(), body_radius_.end());
  entity_.assign(bodies.begin(), bodies.end());
  entity_.resize(bodies.size() + kLanes);
}

inline MovingShadows::Lines MovingShadows::LinesTo(const SightedPoints& points, std::size_t group, FloatLanes x,
                                                   FloatLanes y, FloatLanes length, IntLanes sector) const
{
  constexpr float kTiny = 1e-20F;  // a level line: the quotients become huge, not NaN
  Lines lines;
  const FloatLanes inverse = 1 / Maximum(length, Everywhere(kTiny));
  lines.way_x = x * inverse;
  lines.way_y = y * inverse;
  const FloatLanes rise = Differences(&points.z[group], source_.z());
  const FloatLanes slope = length / (rise == 0 ? Everywhere(kTiny) : rise);
  // A little more than the part of the way at the heights of the bodies, and a little less.
  const auto part = [&](float low, float high, FloatLanes& first, FloatLanes& last)
  {
    const FloatLanes a = low * slope;
    const FloatLanes b = high * slope;
    first = Maximum(Minimum(a, b), FloatLanes{});
    last = Minimum(Maximum(a, b), length);
  };
  part(low_ - kThin, high_ + kThin, lines.first, lines.last);
  part(low_ + kThin, high_ - kThin, lines.surely_first, lines.surely_last);
  lines.margin = MarginAt(length);
  const IntLanes start = sector * kRings;
  const FloatLanes wide = largest_ + lines.margin;
  lines.first_cell = start + RingOf(lines.first - wide);
  lines.last_cell = lines.first <= lines.last ? start + RingOf(lines.last + wide) : lines.first_cell - 1;
  return lines;
}

void MovingShadows::Look(const SightedPoints& points, const FixedShadows& fixed, std::vector<std::uint32_t>& seen) const
{
  const bool is_flat = world_.Terrain().IsEmpty();
  const auto is_behind_terrain = [&](std::size_t i)
  {
    const auto hides = [&](std::uint32_t terrain) { return world_.CanHideFrom(points.robot[i], terrain); };
    return world_.Terrain().FirstHit(points.At(i), source_, hides) <= 1;
  };
  for (std::size_t group = 0; group < points.count; group += kLanes)
  {
    const FloatLanes x = Differences(&points.x[group], source_.x());
    const FloatLanes y = Differences(&points.y[group], source_.y());
    const FloatLanes length = SquareRoot(x * x + y * y);
    const FloatLanes turn = Sectors::TurnOf(x, y);
    const IntLanes fixed_sector = fixed.Directions().Of(turn) & fixed.Directions().Last();
    const unsigned near_fixed = LaneMask(fixed.MayHide(fixed_sector, length));
    const Lines lines = LinesTo(points, group, x, y, length, sectors_.Of(turn) & sectors_.Last());
    ForEachBit(
        LaneMask((length <= reach_) & FirstLanes(points.count - group)),
        [&](unsigned lane)
        {
          const std::size_t i = group + lane;
          if (IsHidden(points, i, lines, lane)) return;
          if ((near_fixed >> lane & 1U) != 0 && fixed.Hide(world_, points.robot[i], points.At(i),
                                                           static_cast<std::size_t>(fixed_sector[lane]), length[lane]))
            return;
          if (!is_flat && is_behind_terrain(i)) return;
          seen.push_back(static_cast<std::uint32_t>(i));
        });
  }
}

inline bool MovingShadows::IsHidden(const SightedPoints& points, std::size_t point, const Lines& lines,
                                    unsigned lane) const
{
  std::size_t begin = 0, end = 0;
  if (!are_few_)
  {
    const std::uint32_t* const start = sort_.Starts();
    begin = start[lines.first_cell[lane]];
    end = start[lines.last_cell[lane] + 1];
  }
  else if (lines.first[lane] <= lines.last[lane])
    end = entity_.size() - kLanes;
  const std::uint32_t robot = points.robot[point];
  const FloatLanes way_x = Everywhere(lines.way_x[lane]);
  const FloatLanes way_y = Everywhere(lines.way_y[lane]);
  const FloatLanes margin = Everywhere(lines.margin[lane]);
  for (std::size_t i = begin; i < end; i += kLanes)
  {
    const FloatLanes x = LoadLanes(&x_[i]);
    const FloatLanes y = LoadLanes(&y_[i]);
    const FloatLanes radius = LoadLanes(&radius_[i]);
    const FloatLanes along = x * way_x + y * way_y;
    const auto square_beside = [&](float from, float to)
    {
      const FloatLanes nearest = Minimum(Maximum(along, Everywhere(from)), Everywhere(to));
      const FloatLanes beside_x = nearest * way_x - x;
      const FloatLanes beside_y = nearest * way_y - y;
      return beside_x * beside_x + beside_y * beside_y;
    };
    const FloatLanes outer = radius + margin;
    const unsigned others = LaneMask((LoadLanes(&entity_[i]) != static_cast<int>(robot)) & FirstLanes(end - i) &
                                     (square_beside(lines.first[lane], lines.last[lane]) <= outer * outer));
    if (others == 0) continue;
    const float surely_first = lines.surely_first[lane];
    const float surely_last = lines.surely_last[lane];
    if (are_exact_ && surely_first < surely_last)
    {
      const FloatLanes inner = radius - margin;
      const FloatLanes square = square_beside(surely_first, surely_last);
      if ((LaneMask((square < inner * inner) & (inner > 0)) & others) != 0) return true;
    }
    if (HidesExactly(others, i, robot, points.At(point))) return true;
  }
  return false;
}

bool MovingShadows::HidesExactly(unsigned bodies, std::size_t first, std::uint32_t robot, const Vector3& point) const
{
  bool hides = false;
  ForEachBit(bodies,
             [&](unsigned bit)
             {
               const auto body = static_cast<std::uint32_t>(entity_[first + bit]);
               hides |= world_.CanHideFrom(robot, body) && world_.HitOn(body, point, source_).has_value();
             });
  return hides;
}

}  // namespace swarmanoid
