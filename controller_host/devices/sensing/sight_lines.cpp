// Problem: find which of many points an observer sees past all bodies, exactly, several at a time.
//
// Method: bodies are split by form. Upright cylinders go to the DiscField. Upright boxes hide the points behind them: a
// point is a candidate if it is beyond the face that is nearest to the eye, and slabs along the axes of the box then
// decide. Tilted or articulated bodies, and bodies that hide only from the owners of points, are tested point by point.
// Terrain comes last, since it costs most.
//
// Invariant: a body that lies to one side of the eye and all points is left out, by bounds that are wider than the
// rounding.
#include "controller_host/devices/sensing/sight_lines.h"

#include <algorithm>
#include <limits>
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

// Narrows the part [enter, leave] of the way to where start + t * step lies between low and high.
void ClipSlab(float start, float step, float low, float high, float& enter, float& leave)
{
  constexpr float kTiny = 1e-20F;  // parallel ones: the quotients become huge, not NaN
  if (step == 0) step = kTiny;
  const float a = (low - start) / step;
  const float b = (high - start) / step;
  enter = std::max(enter, std::min(a, b));
  leave = std::min(leave, std::max(a, b));
}

}  // namespace

SightLines::SightLines(const SensorWorld& world, double reach)
    : world_(world), fixed_(world.Space(), world.Bodies(), reach), usual_reach_(reach), stamps_(world.Space().Size(), 0)
{
  near_.Reserve(world.Grid().Bodies().size());
  discs_.Reserve(world.Space().Size());
}

void SightLines::LookFrom(std::uint32_t observer, const Vector3& eye, double reach)
{
  observer_ = observer;
  eye_ = eye;
  reach_ = reach;
  points_.count = 0;
  are_origins_ = false;
  world_.Grid().CollectNear(eye.x(), eye.y(), reach, observer, near_);
}

Vector3 SightLines::InFrontOf(const Vector3& spot)
{
  constexpr double kBeforeSurface = 1e-3;  // m
  const double length = spot.norm();
  return length > kBeforeSurface ? Vector3(spot * (1 - kBeforeSurface / length)) : spot;
}

void SightLines::LookAtBodiesAround()
{
  are_origins_ = true;
  shown_ = {near_.count, near_.x.data(), near_.y.data(), nullptr, near_.entity.data()};
  if (world_.Grid().AllLevel())
  {
    if (near_.count + kLanes > same_level_.size()) same_level_.resize(2 * near_.count + kLanes, 0);
    shown_.z = same_level_.data();
    return;
  }
  if (near_.count + kLanes > points_.z.size()) points_.Reserve(2 * near_.count);
  const double* const z = world_.Grid().OriginZ();
  const double own = world_.Space().Poses().z[observer_];
  for (std::size_t i = 0; i < near_.count; ++i)
    points_.z[i] = static_cast<float>(z[static_cast<std::size_t>(near_.place[i])] - own);
  shown_.z = points_.z.data();
}

const SeenPoints& SightLines::Solve()
{
  if (!are_origins_) shown_ = points_;
  seen_.Resize(shown_.count);
  if (shown_.count == 0) return seen_;
  CollectBodies();
  field_.Look(shown_, seen_);
  for (const Box& box : boxes_) HideBehindBox(box);
  if (!tilted_.empty() || !foreign_.empty())
    for (std::size_t i = 0; i < shown_.count; ++i)
      if (seen_[i] && HiddenByOthers(i)) seen_.Hide(i);
  if (!world_.Terrain().IsEmpty())
    for (std::size_t i = 0; i < shown_.count; ++i)
      if (seen_[i] && HiddenByTerrain(i)) seen_.Hide(i);
  return seen_;
}

void SightLines::FindHeights()
{
  lowest_ = highest_ = 0;
  if (are_origins_ && world_.Grid().AllLevel()) return;
  FloatLanes lowest{}, highest{};
  for (std::size_t i = 0; i < shown_.count; i += kLanes)
  {
    const FloatLanes z = FirstLanes(shown_.count - i) ? LoadLanes(&shown_.z[i]) : FloatLanes{};
    lowest = Minimum(lowest, z);
    highest = Maximum(highest, z);
  }
  lowest_ = Lowest(lowest);
  highest_ = Highest(highest);
}

// Takes the bounds of all bodies in the grid, which are found once a tick, as far as the eye reaches.
void SightLines::FindOutlineOfOrigins()
{
  const NeighbourGrid& grid = world_.Grid();
  if (origins_.rebuilds != grid.Rebuilds())
  {
    const std::size_t count = grid.Sorted().size();
    const auto [left, right] = std::ranges::minmax(std::span(grid.OriginX(), count));
    const auto [back, front] = std::ranges::minmax(std::span(grid.OriginY(), count));
    origins_ = {grid.Rebuilds(), left, right, back, front};
  }
  left_ = static_cast<float>(std::clamp(origins_.left - eye_.x(), -reach_, 0.0));
  right_ = static_cast<float>(std::clamp(origins_.right - eye_.x(), 0.0, reach_));
  back_ = static_cast<float>(std::clamp(origins_.back - eye_.y(), -reach_, 0.0));
  front_ = static_cast<float>(std::clamp(origins_.front - eye_.y(), 0.0, reach_));
}

void SightLines::FindOutline()
{
  has_outline_ = true;
  if (are_origins_) return FindOutlineOfOrigins();
  FloatLanes left{}, right{}, back{}, front{};
  for (std::size_t i = 0; i < shown_.count; i += kLanes)
  {
    const IntLanes are_there = FirstLanes(shown_.count - i);
    const FloatLanes x = are_there ? LoadLanes(&shown_.x[i]) : FloatLanes{};
    const FloatLanes y = are_there ? LoadLanes(&shown_.y[i]) : FloatLanes{};
    left = Minimum(left, x);
    right = Maximum(right, x);
    back = Minimum(back, y);
    front = Maximum(front, y);
  }
  left_ = Lowest(left);
  right_ = Highest(right);
  back_ = Lowest(back);
  front_ = Highest(front);
}

void SightLines::CollectBodies()
{
  FindHeights();
  has_outline_ = false;
  boxes_.clear();
  tilted_.clear();
  foreign_.clear();
  discs_.count = 0;
  if (reach_ <= usual_reach_)
    for (const std::uint32_t body : fixed_.Near(eye_.x(), eye_.y()))
      AddBody(body, IsUpright(world_.Space().Poses(), body));
  else
  {
    ++stamp_;
    fixed_.ForEachInSquare(eye_.x(), eye_.y(), reach_,
                           [&](std::uint32_t body)
                           {
                             if (stamps_[body] == stamp_) return;
                             stamps_[body] = stamp_;
                             AddBody(body, IsUpright(world_.Space().Poses(), body));
                           });
  }

  // All that are near, if all of them are upright cylinders and hide things from the observer.
  const NearBodies* discs = &near_;
  const NeighbourGrid& grid = world_.Grid();
  if (discs_.count > 0 || !grid.AllUpright() || !grid.AllCylinders() || !world_.Membership().IsOneWorld())
  {
    for (std::size_t i = 0; i < near_.count; ++i)
    {
      const auto body = static_cast<std::uint32_t>(near_.entity[i]);
      const bool is_upright = grid.AllUpright() || IsUpright(world_.Space().Poses(), body);
      if (is_upright && world_.Extent(body).kind == Shape::Kind::kBox && IsOutside(i)) continue;
      AddBody(body, is_upright);
    }
    discs = &discs_;
  }

  field_.Sort(*discs, static_cast<float>(eye_.z()), lowest_, highest_, static_cast<float>(reach_),
              are_origins_ && discs == &near_);
}

// Returns whether an upright body around the eye is surely farther to one side than all points and the eye.
bool SightLines::IsOutside(std::size_t near)
{
  if (!has_outline_) FindOutline();
  const float reach = near_.radius[near] + 1e-3F;
  const float x = near_.x[near];
  const float y = near_.y[near];
  return (x < left_ - reach) | (x > right_ + reach) | (y < back_ - reach) | (y > front_ + reach);
}

void SightLines::AddBody(std::uint32_t body, bool upright)
{
  if (!world_.CanHideFrom(observer_, body)) return foreign_.push_back(body);
  if (!upright || world_.IsArticulated(body)) return tilted_.push_back(body);
  const BodyExtent& extent = world_.Extent(body);
  if (extent.kind == Shape::Kind::kBox) return AddBox(body);
  const PoseArrays& poses = world_.Space().Poses();
  const std::size_t i = discs_.count++;
  discs_.x[i] = static_cast<float>(poses.x[body] - eye_.x());
  discs_.y[i] = static_cast<float>(poses.y[body] - eye_.y());
  discs_.radius[i] = extent.radius;
  discs_.low[i] = static_cast<float>(poses.z[body] + extent.low);
  discs_.high[i] = static_cast<float>(poses.z[body] + extent.high);
  discs_.entity[i] = static_cast<std::int32_t>(body);
}

void SightLines::AddBox(std::uint32_t body)
{
  const PoseArrays& poses = world_.Space().Poses();
  const BodyExtent& extent = world_.Extent(body);
  const Vector3& half = world_.Body(body).half_size;
  const double dx = poses.x[body] - eye_.x();
  const double dy = poses.y[body] - eye_.y();
  const double z = poses.z[body] - eye_.z();
  const double reach = static_cast<double>(extent.radius) + 1e-4;
  if (!has_outline_) FindOutline();
  if (dx < static_cast<double>(left_) - reach || dx > static_cast<double>(right_) + reach ||
      dy < static_cast<double>(back_) - reach || dy > static_cast<double>(front_) + reach)
    return;
  Box box{};
  box.heading = HeadingOf(poses, body);
  box.x = static_cast<float>(-(box.heading.cos * dx + box.heading.sin * dy));
  box.y = static_cast<float>(box.heading.sin * dx - box.heading.cos * dy);
  box.half_x = static_cast<float>(half.x());
  box.half_y = static_cast<float>(half.y());
  box.low = static_cast<float>(z) + extent.low;
  box.high = static_cast<float>(z) + extent.high;
  box.entity = static_cast<std::int32_t>(body);

  // Towards the box along one of its axes.
  const float outside_x = __builtin_fabsf(box.x) - box.half_x;
  const float outside_y = __builtin_fabsf(box.y) - box.half_y;
  const auto cosine = static_cast<float>(box.heading.cos);
  const auto sine = static_cast<float>(box.heading.sin);
  const bool along_x = outside_x > outside_y;
  const float side = (along_x ? box.x : box.y) > 0 ? -1.0F : 1.0F;
  box.normal_x = side * (along_x ? cosine : -sine);
  box.normal_y = side * (along_x ? sine : cosine);
  const float outside = std::max(outside_x, outside_y);
  box.distance = outside > 0 ? outside * 0.9999F - 1e-5F : -std::numeric_limits<float>::infinity();
  // No point is farther towards the box than this corner of the outline.
  const float farthest =
      std::max(left_ * box.normal_x, right_ * box.normal_x) + std::max(back_ * box.normal_y, front_ * box.normal_y);
  if (farthest >= box.distance) boxes_.push_back(box);
}

void SightLines::HideBehindBox(const Box& box)
{
  const auto cosine = static_cast<float>(box.heading.cos);
  const auto sine = static_cast<float>(box.heading.sin);
  for (std::size_t group = 0; group < shown_.count; group += kLanes)
  {
    const FloatLanes toward = LoadLanes(&shown_.x[group]) * box.normal_x + LoadLanes(&shown_.y[group]) * box.normal_y;
    ForEachBit(LaneMask(toward >= box.distance) & seen_.Group(group),
               [&](unsigned bit)
               {
                 const std::size_t i = group + bit;
                 if (shown_.owner[i] == box.entity) return;
                 const float x = shown_.x[i];
                 const float y = shown_.y[i];
                 float enter = 0, leave = 1;
                 ClipSlab(box.x, cosine * x + sine * y, -box.half_x, box.half_x, enter, leave);
                 ClipSlab(box.y, cosine * y - sine * x, -box.half_y, box.half_y, enter, leave);
                 ClipSlab(0, shown_.z[i], box.low, box.high, enter, leave);
                 if (enter <= leave) seen_.Hide(i);
               });
  }
}

bool SightLines::HiddenByOthers(std::size_t point) const
{
  const auto owner = static_cast<std::uint32_t>(shown_.owner[point]);
  const Vector3 target = eye_ + Vector3(shown_.x[point], shown_.y[point], shown_.z[point]);
  const auto hides = [&](std::uint32_t body) { return body != owner && world_.HitOn(body, eye_, target).has_value(); };
  for (const std::uint32_t body : tilted_)
    if (hides(body)) return true;
  for (const std::uint32_t body : foreign_)
    if ((owner == kNobody || world_.Membership().ShareEngine(owner, body)) && hides(body)) return true;
  return false;
}

bool SightLines::HiddenByTerrain(std::size_t point) const
{
  const auto owner = static_cast<std::uint32_t>(shown_.owner[point]);
  const Vector3 way(shown_.x[point], shown_.y[point], shown_.z[point]);
  const auto hides = [&](std::uint32_t terrain)
  {
    return world_.CanHideFrom(observer_, terrain) ||
           (owner != kNobody && world_.Membership().ShareEngine(owner, terrain));
  };
  // Points on the ground, such as laser spots, are not hidden by it.
  constexpr double kOnGround = 0.005;  // m
  const double length = way.norm();
  return world_.Terrain().FirstHit(eye_, eye_ + way, hides) * length < length - kOnGround;
}

}  // namespace swarmanoid
