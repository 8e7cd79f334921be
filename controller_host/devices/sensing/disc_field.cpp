#include "controller_host/devices/sensing/disc_field.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace swarmanoid
{
namespace
{

constexpr float kInfinity = std::numeric_limits<float>::infinity();

// Directions at equal steps of y / (x + y), from +x to +y, of length 1.
struct Borders
{
  std::array<float, 9> x, y;
};
Borders MakeBorders()
{
  Borders borders{};
  for (std::size_t k = 0; k <= 8; ++k)
  {
    const double y = static_cast<double>(k) / 8;
    const double length = __builtin_sqrt((1 - y) * (1 - y) + y * y);
    borders.x[k] = static_cast<float>((1 - y) / length);
    borders.y[k] = static_cast<float>(y / length);
  }
  return borders;
}
const Borders kBorders = MakeBorders();

}  // namespace

void SightPoints::Reserve(std::size_t points)
{
  for (std::vector<float>* values : {&x, &y, &z}) values->resize(points + kLanes, 0);
  owner.resize(points + kLanes, 0);
}

void DiscField::Cells::Reserve(std::size_t cells, std::size_t places)
{
  if (places + 2 * kLanes <= stride) return;
  // An odd number of cache lines, so that the cells do not compete for the same places of the cache.
  stride = (2 * places + 2 * kLanes) / 32 * 32 + 48;
  for (std::vector<float>* values : {&x, &y, &radius, &low, &high}) values->assign(stride * cells, 0);
  entity.assign(stride * cells, 0);
}

void DiscField::Sort(const NearBodies& discs, float eye, float lowest, float highest)
{
  Classify(discs, eye, lowest, highest);
  few_ = discs.count <= kFew ? &discs : nullptr;
  if (few_ != nullptr) return CutIntoStrips(discs, eye, lowest, highest);
  SortByQuadrants(discs, eye, lowest, highest);
  cells_.Reserve(kQuadrants * kSectors,
                 *std::max_element(quadrants_.filled.begin(), quadrants_.filled.begin() + kQuadrants));
  for (std::size_t quadrant = 0; quadrant < kQuadrants; ++quadrant) SplitQuadrant(quadrant);
  Close();
}

void DiscField::Classify(const NearBodies& discs, float eye, float lowest, float highest)
{
  if (discs.are_alike && discs.count > 0)
  {
    low_ = discs.low[0] - eye;
    high_ = discs.high[0] - eye;
    all_count_ = low_ <= highest && high_ >= lowest;
    heights_ = low_ <= lowest && high_ >= highest ? Heights::kSpanning : Heights::kEqual;
    return;
  }
  FloatLanes lowest_low = Everywhere(kInfinity), highest_low = -lowest_low;
  FloatLanes lowest_high = lowest_low, highest_high = -lowest_low;
  all_count_ = true;
  for (std::size_t i = 0; i < discs.count; i += kLanes)
  {
    const FloatLanes low = LoadLanes(&discs.low[i]) - eye;
    const FloatLanes high = LoadLanes(&discs.high[i]) - eye;
    IntLanes counts = (low <= highest) & (high >= lowest);
    IntLanes are_there = Everywhere(-1);
    if (discs.count - i < kLanes) are_there = FirstLanes(discs.count - i);
    all_count_ &= LaneMask(are_there & ~counts) == 0;
    counts &= are_there;
    lowest_low = Minimum(lowest_low, counts ? low : Everywhere(kInfinity));
    highest_low = Maximum(highest_low, counts ? low : Everywhere(-kInfinity));
    lowest_high = Minimum(lowest_high, counts ? high : Everywhere(kInfinity));
    highest_high = Maximum(highest_high, counts ? high : Everywhere(-kInfinity));
  }
  low_ = Lowest(lowest_low);
  high_ = Highest(highest_high);
  if (Highest(highest_low) <= lowest && Lowest(lowest_high) >= highest)
    heights_ = Heights::kSpanning;
  else if (Highest(highest_low) == low_ && Lowest(lowest_high) == high_)
    heights_ = Heights::kEqual;
  else
    heights_ = Heights::kMixed;
}

void DiscField::CutIntoStrips(const NearBodies& discs, float eye, float lowest, float highest)
{
  strips_ = (discs.count + kStrip - 1) / kStrip;
  for (std::size_t i = 0; i < discs.count; i += kLanes)
  {
    IntLanes counts = FirstLanes(discs.count - i);
    if (!all_count_)
      counts &= (LoadLanes(&discs.low[i]) - eye <= highest) & (LoadLanes(&discs.high[i]) - eye >= lowest);
    const FloatLanes y = LoadLanes(&discs.y[i]);
    const FloatLanes radius = LoadLanes(&discs.radius[i]);
    const FloatLanes reach = radius * 1.0001F + 1e-4F;  // covers the rounding of the test
    const FloatLanes back = LowestOfFour(counts ? y - reach : Everywhere(kInfinity));
    const FloatLanes front = HighestOfFour(counts ? y + reach : Everywhere(-kInfinity));
    for (int strip = 0; strip < kLanes / 4; ++strip)
    {
      strip_back_[i / kStrip + static_cast<std::size_t>(strip)] = back[strip * 4];
      strip_front_[i / kStrip + static_cast<std::size_t>(strip)] = front[strip * 4];
    }
    StoreLanes(counts ? radius * radius : Everywhere(-1.0F), &square_[i]);
    if (heights_ != Heights::kMixed) continue;
    StoreLanes(LoadLanes(&discs.low[i]) - eye, &few_low_[i]);
    StoreLanes(LoadLanes(&discs.high[i]) - eye, &few_high_[i]);
  }
}

void DiscField::SortByQuadrants(const NearBodies& discs, float eye, float lowest, float highest)
{
  Cells& cells = quadrants_;
  cells.Reserve(kQuadrants, discs.count);
  std::array<std::size_t, kQuadrants> filled{};
  for (std::size_t i = 0; i < discs.count; i += kLanes)
  {
    const FloatLanes x = LoadLanes(&discs.x[i]);
    const FloatLanes y = LoadLanes(&discs.y[i]);
    const FloatLanes radius = LoadLanes(&discs.radius[i]);
    const IntLanes entity = LoadLanes(&discs.entity[i]);
    IntLanes counts = Everywhere(-1);
    if (!all_count_) counts = (LoadLanes(&discs.low[i]) - eye <= highest) & (LoadLanes(&discs.high[i]) - eye >= lowest);
    if (discs.count - i < kLanes) counts &= FirstLanes(discs.count - i);

    const FloatLanes reach = radius * 1.0001F + 1e-6F;
    const IntLanes sides[2] = {counts & (x >= -reach), counts & (x <= reach)};
    const IntLanes halves[2] = {y >= -reach, y <= reach};
    for (std::size_t quadrant = 0; quadrant < kQuadrants; ++quadrant)
    {
      const Selection selection(LaneMask(sides[quadrant & 1U] & halves[quadrant >> 1U]));
      const std::size_t place = quadrant * cells.stride + filled[quadrant];
      selection.Store(x, &cells.x[place]);
      selection.Store(y, &cells.y[place]);
      selection.Store(radius, &cells.radius[place]);
      selection.Store(entity, &cells.entity[place]);
      if (heights_ == Heights::kMixed)
      {
        selection.Store(LoadLanes(&discs.low[i]) - eye, &cells.low[place]);
        selection.Store(LoadLanes(&discs.high[i]) - eye, &cells.high[place]);
      }
      filled[quadrant] += selection.Count();
    }
  }
  std::copy(filled.begin(), filled.end(), cells.filled.begin());
}

// A cylinder touches a sector if it does not lie wholly beyond either border.
void DiscField::SplitQuadrant(std::size_t quadrant)
{
  const std::size_t from = quadrant * quadrants_.stride;
  const std::size_t count = quadrants_.filled[quadrant];
  const float side_x = (quadrant & 1U) != 0 ? -1.0F : 1.0F;
  const float side_y = (quadrant & 2U) != 0 ? -1.0F : 1.0F;
  std::array<std::size_t, kSectors> filled{};
  for (std::size_t i = 0; i < count; i += kLanes)
  {
    const FloatLanes x = LoadLanes(&quadrants_.x[from + i]);
    const FloatLanes y = LoadLanes(&quadrants_.y[from + i]);
    const FloatLanes radius = LoadLanes(&quadrants_.radius[from + i]);
    const IntLanes entity = LoadLanes(&quadrants_.entity[from + i]);
    const FloatLanes reach = radius * 1.0001F + 1e-6F;
    const FloatLanes ahead = x * side_x;
    const FloatLanes beside = y * side_y;
    IntLanes counts = FirstLanes(count - i);
    for (std::size_t sector = 0; sector < kSectors; ++sector)
    {
      const FloatLanes beyond = beside * kBorders.x[sector + 1] - ahead * kBorders.y[sector + 1];
      const Selection selection(LaneMask(counts & (beyond <= reach)));
      counts &= beyond >= -reach;
      const std::size_t place = (quadrant * kSectors + sector) * cells_.stride + filled[sector];
      selection.Store(x, &cells_.x[place]);
      selection.Store(y, &cells_.y[place]);
      selection.Store(radius * radius, &cells_.radius[place]);
      selection.Store(entity, &cells_.entity[place]);
      if (heights_ == Heights::kMixed)
      {
        selection.Store(LoadLanes(&quadrants_.low[from + i]), &cells_.low[place]);
        selection.Store(LoadLanes(&quadrants_.high[from + i]), &cells_.high[place]);
      }
      filled[sector] += selection.Count();
    }
  }
  std::copy(filled.begin(), filled.end(), cells_.filled.begin() + static_cast<std::ptrdiff_t>(quadrant * kSectors));
}

// Fills the cells with cylinders that hide nothing, all to a depth that is enough for most.
void DiscField::Close()
{
  const auto whole_lanes = [](std::size_t places) { return (places + kLanes - 1) / kLanes * kLanes; };
  const std::size_t all = std::accumulate(cells_.filled.begin(), cells_.filled.end(), std::size_t{0});
  const std::size_t usual = whole_lanes((all + all / 3) / cells_.filled.size());
  for (std::size_t cell = 0; cell < cells_.filled.size(); ++cell)
  {
    depth_[cell] = std::max(usual, whole_lanes(cells_.filled[cell]));
    for (std::size_t place = cells_.filled[cell]; place < depth_[cell]; place += kLanes)
      StoreLanes(Everywhere(-1.0F), &cells_.radius[cell * cells_.stride + place]);
  }
}

inline DiscField::Lines DiscField::LinesTo(const SightPoints& points, std::size_t group) const
{
  FloatLanes x = LoadLanes(&points.x[group]);
  const FloatLanes y = LoadLanes(&points.y[group]);
  // Straight above or below: moved aside by a micrometre, so that it has a direction.
  x = x * x + y * y < 1e-12F ? Everywhere(1e-6F) : x;
  Lines lines;
  lines.length = SquareRoot(x * x + y * y);
  lines.x = x / lines.length;
  lines.y = y / lines.length;
  lines.from = lines.inverse = FloatLanes{};
  lines.to = Everywhere(1.0F);
  if (heights_ != Heights::kSpanning)
  {
    constexpr float kTiny = 1e-20F;  // a level line: the quotients become huge, not NaN
    const FloatLanes z = LoadLanes(&points.z[group]);
    lines.inverse = 1 / (z == 0 ? Everywhere(kTiny) : z);
  }
  if (heights_ == Heights::kEqual)
  {
    const FloatLanes low = low_ * lines.inverse;
    const FloatLanes high = high_ * lines.inverse;
    lines.from = Maximum(Minimum(low, high), lines.from);
    lines.to = Minimum(Maximum(low, high), lines.to);
  }
  lines.first = lines.from * lines.length;
  lines.last = lines.to * lines.length;
  return lines;
}

namespace
{

// Whether what is nearest to the middle of a circle, between two places of a line, is within it.
inline IntLanes Meets(FloatLanes circle_x, FloatLanes circle_y, FloatLanes square, FloatLanes x, FloatLanes y,
                      FloatLanes first, FloatLanes last)
{
  const FloatLanes along = circle_x * x + circle_y * y;
  const FloatLanes nearest = Minimum(Maximum(along, first), last);
  const FloatLanes beside_x = nearest * x - circle_x;
  const FloatLanes beside_y = nearest * y - circle_y;
  return beside_x * beside_x + beside_y * beside_y <= square;
}

}  // namespace

// The line from the eye to a point is as high as a cylinder from one place of it to another; the cylinder hides the
// point where what is nearest between these places is within its circle.
template <bool kMixedHeights, bool kOwnHit>
void DiscField::LookAtFew(const SightPoints& points, SeenPoints& seen) const
{
  const float* const disc_x = few_->x.data();
  const float* const disc_y = few_->y.data();
  const std::int32_t* const entity = few_->entity.data();
  for (std::size_t group = 0; group < points.count; group += kLanes)
  {
    const Lines lines = LinesTo(points, group);
    const IntLanes are_there = FirstLanes(points.count - group);
    const IntLanes owner = LoadLanes(&points.owner[group]);

    // The strips that any of the lines reaches at the heights of the cylinders.
    const FloatLanes y = are_there ? LoadLanes(&points.y[group]) : Everywhere(points.y[group]);
    const FloatLanes one_end = lines.from * y;
    const FloatLanes other_end = lines.to * y;
    const float back = Lowest(Minimum(one_end, other_end));
    const float front = Highest(Maximum(one_end, other_end));
    unsigned strips = 0;
    for (std::size_t strip = 0; strip < strips_; strip += kLanes)
      strips |= LaneMask((LoadLanes(&strip_back_[strip]) <= front) & (LoadLanes(&strip_front_[strip]) >= back))
                << strip;
    strips &= (1U << strips_) - 1U;
    // Those between the first and the last one too: they are few, and branches cost more.
    const std::size_t begin = kStrip * static_cast<std::size_t>(std::countr_zero(strips | 1U << strips_));
    const std::size_t end = kStrip * static_cast<std::size_t>(std::bit_width(strips));

    const FloatLanes slope = lines.inverse * lines.length;
    IntLanes hits{};
    for (std::size_t strip = begin; strip < end; strip += kStrip)
      for (std::size_t i = strip; i < strip + kStrip; ++i)
      {
        FloatLanes first = lines.first;
        FloatLanes last = lines.last;
        if constexpr (kMixedHeights)
        {
          const FloatLanes a = few_low_[i] * slope;
          const FloatLanes b = few_high_[i] * slope;
          first = Maximum(Minimum(a, b), FloatLanes{});
          last = Minimum(Maximum(a, b), lines.length);
        }
        IntLanes meets =
            Meets(Everywhere(disc_x[i]), Everywhere(disc_y[i]), Everywhere(square_[i]), lines.x, lines.y, first, last);
        if constexpr (kMixedHeights) meets &= first <= last;
        if constexpr (kOwnHit)
          hits += meets;
        else
          hits |= ~(owner == entity[i]) & meets;
      }
    if constexpr (!kMixedHeights) hits &= lines.first <= lines.last;
    const IntLanes hidden = kOwnHit ? hits < -1 : hits;
    seen.SetGroup(group, LaneMask(are_there & ~hidden));
  }
}

template <bool kMixedHeights>
void DiscField::LookAtMany(const SightPoints& points, SeenPoints& seen) const
{
  const Cells& cells = cells_;
  for (std::size_t group = 0; group < points.count; group += kLanes)
  {
    const Lines lines = LinesTo(points, group);
    const FloatLanes slopes = lines.inverse * lines.length;
    const FloatLanes beside = Magnitude(lines.y);
    const IntLanes sector = Truncated(beside / (Magnitude(lines.x) + beside) * static_cast<float>(kSectors));
    constexpr int kLast = static_cast<int>(kSectors) - 1;
    const IntLanes cell = ((lines.x < 0 ? Everywhere(1) : IntLanes{}) + (lines.y < 0 ? Everywhere(2) : IntLanes{})) *
                              static_cast<int>(kSectors) +
                          (sector < kLast ? sector : Everywhere(kLast));
    const std::size_t count = std::min<std::size_t>(kLanes, points.count - group);
    unsigned mask = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      const FloatLanes x = Everywhere(lines.x[i]);
      const FloatLanes y = Everywhere(lines.y[i]);
      const std::int32_t owner = points.owner[group + i];
      FloatLanes first = Everywhere(lines.first[i]);
      FloatLanes last = Everywhere(lines.last[i]);
      IntLanes hits{};
      const std::size_t begin = static_cast<std::size_t>(cell[i]) * cells.stride;
      const std::size_t end = begin + depth_[static_cast<std::size_t>(cell[i])];
      for (std::size_t place = begin; place < end; place += kLanes)
      {
        if constexpr (kMixedHeights)
        {
          const FloatLanes a = LoadLanes(&cells.low[place]) * slopes[i];
          const FloatLanes b = LoadLanes(&cells.high[place]) * slopes[i];
          first = Maximum(Minimum(a, b), FloatLanes{});
          last = Minimum(Maximum(a, b), Everywhere(lines.length[i]));
        }
        hits |= Meets(LoadLanes(&cells.x[place]), LoadLanes(&cells.y[place]), LoadLanes(&cells.radius[place]), x, y,
                      first, last) &
                (LoadLanes(&cells.entity[place]) != owner) & (first <= last);
      }
      mask |= (LaneMask(hits) == 0 ? 1U : 0U) << i;
    }
    seen.SetGroup(group, mask);
  }
}

void DiscField::Look(const SightPoints& points, bool are_origins, SeenPoints& seen) const
{
  seen.Resize(points.count);
  const bool are_mixed = heights_ == Heights::kMixed;
  if (few_ == nullptr) return are_mixed ? LookAtMany<true>(points, seen) : LookAtMany<false>(points, seen);
  if (are_mixed) return LookAtFew<true, false>(points, seen);
  constexpr float kThick = 0.01F;  // m, far beyond rounding
  const bool has_own = are_origins && heights_ == Heights::kSpanning && all_count_ && few_->are_alike &&
                       few_->count > 0 && few_->radius[0] > kThick;
  return has_own ? LookAtFew<false, true>(points, seen) : LookAtFew<false, false>(points, seen);
}

}  // namespace swarmanoid
