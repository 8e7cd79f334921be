#include "controller_host/devices/sight_lines.h"

#include <array>

namespace swarmanoid
{
namespace
{

// Up to here all pairs are tested as they come; beyond, sorting pays.
constexpr std::size_t kUnsorted = 32;
constexpr std::size_t kRings = 64;

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

// Ring of a square distance: rings of equal area.
struct Rings
{
  float scale;
  std::size_t Of(float square_distance) const
  {
    return static_cast<std::size_t>(std::min(square_distance * scale, static_cast<float>(kRings - 1)));
  }
};

}  // namespace

SightLines::SightLines(const SensorWorld& world, double reach)
    : world_(world), fixed_(world.Space(), world.Bodies(), reach), usual_reach_(reach), stamps_(world.Space().Size(), 0)
{
}

void SightLines::LookFrom(std::uint32_t observer, const Vector3& eye, double reach)
{
  observer_ = observer;
  eye_ = eye;
  reach_ = reach;
  points_ = 0;
  point_x_.clear();
  point_y_.clear();
  point_z_.clear();
  owner_.clear();
  around_.clear();
  world_.Grid().ForEachNear(eye.x(), eye.y(), reach,
                            [&](std::uint32_t body)
                            {
                              if (body != observer_) around_.push_back(body);
                            });
}

void SightLines::AddPoint(const Vector3& offset, std::uint32_t owner)
{
  // Straight above or below: moved aside by a micrometre, so that it has a direction.
  const bool vertical = offset.x() * offset.x() + offset.y() * offset.y() < 1e-12;
  point_x_.push_back(vertical ? 1e-6F : static_cast<float>(offset.x()));
  point_y_.push_back(vertical ? 0 : static_cast<float>(offset.y()));
  point_z_.push_back(static_cast<float>(offset.z()));
  owner_.push_back(static_cast<std::int32_t>(owner));
  ++points_;
}

std::span<const char> SightLines::Solve()
{
  seen_.assign(points_, 1);
  if (points_ == 0) return seen_;
  CollectBodies();
  sorted_ = points_ > kUnsorted || discs_.size() > kUnsorted;
  if (sorted_) SortNearFirst();

  const std::size_t padded = (points_ + kLanes - 1) / kLanes * kLanes;
  point_x_.resize(padded, 1);
  point_y_.resize(padded, 0);
  point_z_.resize(padded, 0);
  owner_.resize(padded, static_cast<std::int32_t>(kNobody));
  for (std::size_t first = 0; first < points_; first += kLanes) SolveGroup(first);
  if (!tilted_.empty() || !foreign_.empty())
    for (std::size_t i = 0; i < points_; ++i)
    {
      char& seen = seen_[sorted_ ? order_[i] : i];
      if (seen && HiddenByOthers(i)) seen = 0;
    }
  return seen_;
}

void SightLines::CollectBodies()
{
  discs_.clear();
  boxes_.clear();
  tilted_.clear();
  foreign_.clear();
  largest_radius_ = 0;
  float lowest = 0, highest = 0, farthest = 0;
  for (std::size_t i = 0; i < points_; ++i)
  {
    lowest = std::min(lowest, point_z_[i]);
    highest = std::max(highest, point_z_[i]);
    farthest = std::max(farthest, point_x_[i] * point_x_[i] + point_y_[i] * point_y_[i]);
  }
  farthest = __builtin_sqrtf(farthest);
  for (const std::uint32_t body : around_) AddBody(body, lowest, highest, farthest);
  if (reach_ <= usual_reach_)
  {
    for (const std::uint32_t body : fixed_.Near(eye_.x(), eye_.y())) AddBody(body, lowest, highest, farthest);
    return;
  }
  ++stamp_;
  fixed_.ForEachInSquare(eye_.x(), eye_.y(), reach_,
                         [&](std::uint32_t body)
                         {
                           if (stamps_[body] == stamp_) return;
                           stamps_[body] = stamp_;
                           AddBody(body, lowest, highest, farthest);
                         });
}

void SightLines::AddBody(std::uint32_t body, float lowest, float highest, float farthest)
{
  if (!world_.CanHideFrom(observer_, body)) return foreign_.push_back(body);
  const PoseArrays& poses = world_.Space().Poses();
  if (!IsUpright(poses, body)) return tilted_.push_back(body);
  const BodyShape& shape = world_.Body(body);
  const auto low = static_cast<float>(poses.z[body] + shape.low - eye_.z());
  const auto high = static_cast<float>(poses.z[body] + shape.high - eye_.z());
  if (low > highest || high < lowest) return;
  const double dx = poses.x[body] - eye_.x();
  const double dy = poses.y[body] - eye_.y();
  const auto radius = static_cast<float>(shape.radius);
  const auto square = static_cast<float>(dx * dx + dy * dy);
  const float cut = farthest + radius + 1e-4F;
  if (square > cut * cut) return;
  const auto entity = static_cast<std::int32_t>(body);
  if (shape.kind == Shape::Kind::kCylinder)
  {
    largest_radius_ = std::max(largest_radius_, radius);
    discs_.push_back({static_cast<float>(dx), static_cast<float>(dy), radius * radius, square, low, high, entity,
                      low <= lowest && high >= highest});
    return;
  }
  const Heading heading = HeadingOf(poses, body);
  boxes_.push_back({heading, static_cast<float>(-(heading.cos * dx + heading.sin * dy)),
                    static_cast<float>(heading.sin * dx - heading.cos * dy), static_cast<float>(shape.half_size.x()),
                    static_cast<float>(shape.half_size.y()), low, high, entity});
}

// Counting sorts of points and discs by rings around the eye: within a ring the order stays.
void SightLines::SortNearFirst()
{
  const Rings rings{static_cast<float>(kRings / (reach_ * reach_ + 1e-9))};
  std::array<std::uint32_t, kRings + 1> start{};

  for (const Disc& disc : discs_) ++start[rings.Of(disc.square_distance) + 1];
  for (std::size_t r = 1; r <= kRings; ++r) start[r] += start[r - 1];
  sorted_discs_.resize(discs_.size());
  for (const Disc& disc : discs_) sorted_discs_[start[rings.Of(disc.square_distance)]++] = disc;
  discs_.swap(sorted_discs_);
  // For the early end of the search: the lower border of the ring.
  for (Disc& disc : discs_) disc.square_distance = static_cast<float>(rings.Of(disc.square_distance)) / rings.scale;

  start.fill(0);
  const auto ring_of_point = [&](std::size_t i)
  { return rings.Of(point_x_[i] * point_x_[i] + point_y_[i] * point_y_[i]); };
  for (std::size_t i = 0; i < points_; ++i) ++start[ring_of_point(i) + 1];
  for (std::size_t r = 1; r <= kRings; ++r) start[r] += start[r - 1];
  order_.resize(points_);
  sorted_x_.resize(points_);
  sorted_y_.resize(points_);
  sorted_z_.resize(points_);
  sorted_owner_.resize(points_);
  for (std::size_t i = 0; i < points_; ++i)
  {
    const std::uint32_t place = start[ring_of_point(i)]++;
    order_[place] = static_cast<std::uint32_t>(i);
    sorted_x_[place] = point_x_[i];
    sorted_y_[place] = point_y_[i];
    sorted_z_[place] = point_z_[i];
    sorted_owner_[place] = owner_[i];
  }
  point_x_.swap(sorted_x_);
  point_y_.swap(sorted_y_);
  point_z_.swap(sorted_z_);
  owner_.swap(sorted_owner_);
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
  IntLanes hidden{};

  float farthest = 0;
  for (std::size_t i = 0; i < count; ++i) farthest = std::max(farthest, square[i]);
  const float limit = (__builtin_sqrtf(farthest) + largest_radius_) * 1.0001F;

  for (const Disc& disc : discs_)
  {
    if (sorted_ && disc.square_distance > limit * limit) break;
    // b: how far along the line its nearest point to the disc lies, times the length; across: how far beside, likewise.
    const FloatLanes b = disc.x * x + disc.y * y;
    const FloatLanes across = disc.x * y - disc.y * x;
    const FloatLanes beside = across * across;
    const FloatLanes wide = disc.square_radius * square;
    const FloatLanes end_x = x - disc.x;
    const FloatLanes end_y = y - disc.y;
    const IntLanes end_inside = end_x * end_x + end_y * end_y <= disc.square_radius;
    const IntLanes crosses = (beside <= wide) & (b >= 0) & (b <= square);
    IntLanes hit = (crosses | ((b > square) & end_inside)) & (owner != disc.entity);
    const float to_eye = disc.x * disc.x + disc.y * disc.y;
    if (to_eye <= disc.square_radius) hit |= (b < 0) & (owner != disc.entity);
    if (LaneMask(hit) == 0) continue;
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
    hidden |= hit;
    if ((LaneMask(hidden) & all) == all) break;
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
    hidden |= (enter <= leave) & (owner != box.entity);
  }

  unsigned mask = LaneMask(hidden) & all;
  for (; mask != 0; mask &= mask - 1)
  {
    const std::size_t point = first + static_cast<unsigned>(__builtin_ctz(mask));
    seen_[sorted_ ? order_[point] : point] = 0;
  }
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
