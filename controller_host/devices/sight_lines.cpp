#include "controller_host/devices/sight_lines.h"

#include <array>

namespace swarmanoid
{
namespace
{

// Up to here all pairs are tested as they come; beyond, sorting pays.
constexpr std::size_t kUnsorted = 12;
constexpr std::size_t kMostRings = 64;
constexpr std::size_t kFewestRings = 16;

FloatLanes SquareRoot(FloatLanes lanes)
{
#if defined(__AVX__)
  return reinterpret_cast<FloatLanes>(_mm256_sqrt_ps(reinterpret_cast<__m256>(lanes)));
#elif defined(__SSE2__)
  return reinterpret_cast<FloatLanes>(_mm_sqrt_ps(reinterpret_cast<__m128>(lanes)));
#else
  for (int i = 0; i < kLanes; ++i) lanes[i] = __builtin_sqrtf(lanes[i]);
  return lanes;
#endif
}

FloatLanes Minimum(FloatLanes a, FloatLanes b) { return a < b ? a : b; }
FloatLanes Maximum(FloatLanes a, FloatLanes b) { return a > b ? a : b; }
FloatLanes Everywhere(float value) { return FloatLanes{} + value; }

FloatLanes Load(const std::vector<float>& values, std::size_t i)
{
  return *reinterpret_cast<const FloatLanes*>(&values[i]);
}

// Narrows the part [enter, leave] of the way to where start + t * step lies between low and high.
void ClipSlab(FloatLanes start, FloatLanes step, float low, float high, FloatLanes& enter, FloatLanes& leave)
{
  constexpr float kTiny = 1e-20F;  // parallel ones: the quotients become huge, not NaN
  step = step == 0 ? Everywhere(kTiny) : step;
  const FloatLanes a = (low - start) / step;
  const FloatLanes b = (high - start) / step;
  enter = Maximum(enter, Minimum(a, b));
  leave = Minimum(leave, Maximum(a, b));
}

}  // namespace

SightLines::SightLines(const SensorWorld& world, double reach)
    : world_(world),
      fixed_(world.Space(), world.Bodies(), reach),
      usual_reach_(reach),
      around_(world.Grid().Sorted().size() + 1),
      sorted_around_(around_.size()),
      stamps_(world.Space().Size(), 0)
{
}

void SightLines::LookFrom(std::uint32_t observer, const Vector3& eye, double reach)
{
  observer_ = observer;
  eye_ = eye;
  reach_ = reach;
  points_ = 0;
  const double* const x = world_.Space().Poses().x.data();
  const double* const y = world_.Space().Poses().y.data();
  const double eye_x = eye.x();
  const double eye_y = eye.y();
  Neighbour* next = around_.data();
  world_.Grid().ForEachNear(eye_x, eye_y, reach,
                            [&next, observer, x, y, eye_x, eye_y](std::uint32_t body)
                            {
                              *next = {body, 0, x[body] - eye_x, y[body] - eye_y};
                              next += body != observer;
                            });
  neighbours_ = static_cast<std::size_t>(next - around_.data());
  if (neighbours_ > kUnsorted) SortAround();
}

// A counting sort by rings of equal area around the eye; within a ring the order stays.
void SightLines::SortAround()
{
  const std::size_t rings = neighbours_ > 64 ? kMostRings : kFewestRings;
  const auto scale = static_cast<float>(static_cast<double>(rings) / (reach_ * reach_ + 1e-9));
  const auto last = static_cast<float>(rings - 1);
  std::array<std::uint32_t, kMostRings + 1> start{};
  Neighbour* const neighbours = around_.data();
  for (std::size_t n = 0; n < neighbours_; ++n)
  {
    Neighbour& neighbour = neighbours[n];
    const auto square = static_cast<float>(neighbour.x * neighbour.x + neighbour.y * neighbour.y);
    const auto ring = static_cast<std::int32_t>(std::min(square * scale, last));
    neighbour.ring_start = static_cast<float>(ring);
    ++start[static_cast<std::size_t>(ring) + 1];
  }
  for (std::size_t r = 1; r <= rings; ++r) start[r] += start[r - 1];
  Neighbour* const sorted = sorted_around_.data();
  for (std::size_t n = 0; n < neighbours_; ++n)
  {
    Neighbour& place = sorted[start[static_cast<std::size_t>(static_cast<std::int32_t>(neighbours[n].ring_start))]++];
    place = neighbours[n];
    place.ring_start = place.ring_start / scale;
  }
  around_.swap(sorted_around_);
}

void SightLines::Grow()
{
  const std::size_t size = 2 * point_x_.size() + 64;
  point_x_.resize(size, 1);
  point_y_.resize(size, 0);
  point_z_.resize(size, 0);
  owner_.resize(size, static_cast<std::int32_t>(kNobody));
}

std::span<const char> SightLines::Solve()
{
  seen_.assign(points_, 1);
  if (points_ == 0) return seen_;
  CollectBodies();
  for (std::size_t first = 0; first < points_; first += kLanes) SolveGroup(first);
  if (!tilted_.empty() || !foreign_.empty())
    for (std::size_t i = 0; i < points_; ++i)
      if (seen_[i] && HiddenByOthers(i)) seen_[i] = 0;
  return seen_;
}

void SightLines::CollectBodies()
{
  discs_.clear();
  boxes_.clear();
  tilted_.clear();
  foreign_.clear();
  largest_radius_ = 0;
  all_span_ = true;
  Bounds bounds;
  for (std::size_t i = 0; i < points_; ++i)
  {
    bounds.lowest = std::min(bounds.lowest, point_z_[i]);
    bounds.highest = std::max(bounds.highest, point_z_[i]);
    bounds.farthest = std::max(bounds.farthest, point_x_[i] * point_x_[i] + point_y_[i] * point_y_[i]);
  }
  bounds.farthest = __builtin_sqrtf(bounds.farthest);

  // The fixed ones first: SolveGroup stops at the first disc that is too far.
  if (reach_ <= usual_reach_)
    for (const std::uint32_t body : fixed_.Near(eye_.x(), eye_.y())) AddFixed(body, bounds);
  else
  {
    ++stamp_;
    fixed_.ForEachInSquare(eye_.x(), eye_.y(), reach_,
                           [&](std::uint32_t body)
                           {
                             if (stamps_[body] == stamp_) return;
                             stamps_[body] = stamp_;
                             AddFixed(body, bounds);
                           });
  }
  const bool all_upright = world_.Grid().AllUpright();
  const PoseArrays& poses = world_.Space().Poses();
  if (all_upright && world_.Membership().IsOneWorld())
  {
    for (const Neighbour& neighbour : Around())
      AddUpright(neighbour.entity, neighbour.x, neighbour.y, neighbour.ring_start, bounds);
    return;
  }
  for (const Neighbour& neighbour : Around())
    AddBody(neighbour.entity, neighbour.x, neighbour.y, neighbour.ring_start,
            all_upright || IsUpright(poses, neighbour.entity), bounds);
}

void SightLines::AddFixed(std::uint32_t body, const Bounds& bounds)
{
  const PoseArrays& poses = world_.Space().Poses();
  AddBody(body, poses.x[body] - eye_.x(), poses.y[body] - eye_.y(), 0, IsUpright(poses, body), bounds);
}

void SightLines::AddBody(std::uint32_t body, double dx, double dy, float ring_start, bool upright, const Bounds& bounds)
{
  if (!world_.CanHideFrom(observer_, body)) return foreign_.push_back(body);
  if (!upright) return tilted_.push_back(body);
  AddUpright(body, dx, dy, ring_start, bounds);
}

inline void SightLines::AddUpright(std::uint32_t body, double dx, double dy, float ring_start, const Bounds& bounds)
{
  const PoseArrays& poses = world_.Space().Poses();
  const BodyExtent& extent = world_.Extent(body);
  const auto z = static_cast<float>(poses.z[body] - eye_.z());
  const float low = z + extent.low;
  const float high = z + extent.high;
  if (low > bounds.highest || high < bounds.lowest) return;
  const auto square = static_cast<float>(dx * dx + dy * dy);
  const float cut = bounds.farthest + extent.radius + 1e-4F;
  if (square > cut * cut) return;
  const auto entity = static_cast<std::int32_t>(body);
  if (extent.kind == Shape::Kind::kCylinder)
  {
    largest_radius_ = std::max(largest_radius_, extent.radius);
    const float square_radius = extent.radius * extent.radius;
    const bool spans = low <= bounds.lowest && high >= bounds.highest;
    const bool holds_eye = square <= square_radius;
    all_span_ = all_span_ && spans && !holds_eye;
    discs_.push_back({static_cast<float>(dx), static_cast<float>(dy), square_radius, ring_start,
                      high < 0 ? __builtin_sqrtf(square) + extent.radius : 0, low, high, entity, spans, holds_eye});
    return;
  }
  const Vector3& half = world_.Body(body).half_size;
  const Heading heading = HeadingOf(poses, body);
  boxes_.push_back({heading, static_cast<float>(-(heading.cos * dx + heading.sin * dy)),
                    static_cast<float>(heading.sin * dx - heading.cos * dy), static_cast<float>(half.x()),
                    static_cast<float>(half.y()), low, high, entity});
}

void SightLines::SolveGroup(std::size_t first)
{
  const FloatLanes x = Load(point_x_, first);
  const FloatLanes y = Load(point_y_, first);
  const FloatLanes z = Load(point_z_, first);
  IntLanes owner;
  __builtin_memcpy(&owner, &owner_[first], sizeof owner);
  const FloatLanes square = x * x + y * y;
  const std::size_t count = std::min<std::size_t>(kLanes, points_ - first);
  const unsigned all = (1U << count) - 1U;

  float farthest = 0, nearest = square[0], lowest = 0;
  IntLanes open{};  // lanes with a point that is seen so far
  for (std::size_t i = 0; i < count; ++i)
  {
    farthest = std::max(farthest, square[i]);
    nearest = std::min(nearest, square[i]);
    lowest = std::min(lowest, z[i]);
    open[i] = -1;
  }
  nearest = __builtin_sqrtf(nearest) * 0.9999F;
  const float limit = (__builtin_sqrtf(farthest) + largest_radius_) * 1.0001F;

  const float limit_square = limit * limit;
  if (all_span_)
    for (const Disc& disc : discs_)
    {
      // As below, without branches that depend on who is hidden by whom.
      if (disc.ring_start > limit_square) break;
      const FloatLanes b = disc.x * x + disc.y * y;
      const FloatLanes across = disc.x * y - disc.y * x;
      const FloatLanes end_x = x - disc.x;
      const FloatLanes end_y = y - disc.y;
      const IntLanes hit = (across * across <= disc.square_radius * square) & (b >= 0) &
                           ((b <= square) | (end_x * end_x + end_y * end_y <= disc.square_radius));
      open &= ~(hit & (owner != disc.entity));
      if (LaneMask(open) == 0) break;
    }
  else
    for (const Disc& disc : discs_)
    {
      if (disc.ring_start > limit_square) break;
      // Lines that still pass above it where it ends. (high and lowest are below 0 here.)
      if (disc.high < 0 && disc.far_edge * lowest > disc.high * nearest) continue;
      // b: how far along the line its nearest point to the disc lies, times the length; across: how far beside,
      // likewise.
      const FloatLanes b = disc.x * x + disc.y * y;
      const FloatLanes across = disc.x * y - disc.y * x;
      const FloatLanes beside = across * across;
      const FloatLanes wide = disc.square_radius * square;
      IntLanes hit = (beside <= wide) & (b >= 0) & open;
      if (LaneMask(hit) == 0 && !disc.holds_eye) continue;

      const FloatLanes end_x = x - disc.x;
      const FloatLanes end_y = y - disc.y;
      hit &= (b <= square) | (end_x * end_x + end_y * end_y <= disc.square_radius);
      if (disc.holds_eye) hit = open;
      hit &= owner != disc.entity;
      if (!disc.spans)
      {
        // Between entering and leaving the circle the line must be as high as the body somewhere.
        const FloatLanes inside = wide - beside;
        const FloatLanes half = SquareRoot(inside > 0 ? inside : FloatLanes{});
        const FloatLanes enter = Maximum((b - half) / square, FloatLanes{});
        const FloatLanes leave = Minimum((b + half) / square, Everywhere(1));
        const FloatLanes z_enter = z * enter;
        const FloatLanes z_leave = z * leave;
        hit &= (Maximum(z_enter, z_leave) >= disc.low) & (Minimum(z_enter, z_leave) <= disc.high);
      }
      open &= ~hit;
      if (LaneMask(open) == 0) break;
    }

  for (const Box& box : boxes_)
  {
    const auto cosine = static_cast<float>(box.heading.cos);
    const auto sine = static_cast<float>(box.heading.sin);
    FloatLanes enter{};
    FloatLanes leave = Everywhere(1);
    ClipSlab(Everywhere(box.x), cosine * x + sine * y, -box.half_x, box.half_x, enter, leave);
    ClipSlab(Everywhere(box.y), cosine * y - sine * x, -box.half_y, box.half_y, enter, leave);
    ClipSlab(FloatLanes{}, z, box.low, box.high, enter, leave);
    open &= ~((enter <= leave) & (owner != box.entity));
  }

  for (unsigned hidden = ~LaneMask(open) & all; hidden != 0; hidden &= hidden - 1)
    seen_[first + static_cast<unsigned>(__builtin_ctz(hidden))] = 0;
}

bool SightLines::HiddenByOthers(std::size_t point) const
{
  const CSwarmanoidSpace& space = world_.Space();
  const auto owner = static_cast<std::uint32_t>(owner_[point]);
  const Vector3 target = eye_ + Vector3(point_x_[point], point_y_[point], point_z_[point]);
  const auto hides = [&](std::uint32_t body)
  { return body != owner && SegmentHit(world_.Body(body), space.GetPose(body), eye_, target).has_value(); };
  for (const std::uint32_t body : tilted_)
    if (hides(body)) return true;
  if (owner == kNobody) return false;
  for (const std::uint32_t body : foreign_)
    if (world_.Membership().ShareEngine(owner, body) && hides(body)) return true;
  return false;
}

}  // namespace swarmanoid
