#include "controller_host/devices/disc_field.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace swarmanoid
{
namespace
{

constexpr float kInfinity = std::numeric_limits<float>::infinity();
// More than this are split into sectors.
constexpr std::size_t kFew = 56;

IntLanes FirstLanes(std::size_t count)
{
  IntLanes lanes{};
  for (int i = 0; i < kLanes; ++i) lanes[i] = static_cast<std::size_t>(i) < count ? -1 : 0;
  return lanes;
}

float Lowest(FloatLanes lanes)
{
  float lowest = lanes[0];
  for (int i = 1; i < kLanes; ++i) lowest = std::min(lowest, lanes[i]);
  return lowest;
}

float Highest(FloatLanes lanes) { return -Lowest(-lanes); }

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
  is_split_ = discs.count > kFew;
  SortByQuadrants(discs, eye, lowest, highest);
  if (is_split_)
  {
    const auto end = quadrants_.filled.begin() + kQuadrants;
    cells_.Reserve(kQuadrants * kSectors, *std::max_element(quadrants_.filled.begin(), end));
    for (std::size_t quadrant = 0; quadrant < kQuadrants; ++quadrant) SplitQuadrant(quadrant);
  }
  Close(is_split_ ? kQuadrants * kSectors : kQuadrants);
}

void DiscField::Classify(const NearBodies& discs, float eye, float lowest, float highest)
{
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
      selection.Store(is_split_ ? radius : radius * radius, &cells.radius[place]);
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

// A cylinder touches a sector where it does not lie wholly beyond either border.
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
void DiscField::Close(std::size_t cells)
{
  Cells& tested = is_split_ ? cells_ : quadrants_;
  const auto end = tested.filled.begin() + static_cast<std::ptrdiff_t>(cells);
  const auto whole_lanes = [](std::size_t places) { return (places + kLanes - 1) / kLanes * kLanes; };
  const std::size_t all = std::accumulate(tested.filled.begin(), end, std::size_t{0});
  const std::size_t usual = whole_lanes((all + all / 3) / cells);
  for (std::size_t cell = 0; cell < cells; ++cell)
  {
    depth_[cell] = std::max(usual, whole_lanes(tested.filled[cell]));
    for (std::size_t place = tested.filled[cell]; place < depth_[cell]; place += kLanes)
      StoreLanes(Everywhere(-1.0F), &tested.radius[cell * tested.stride + place]);
  }
}

// The line from the eye to a point is as high as a cylinder from one place of it to another; the cylinder hides the
// point where what is nearest between these places is within its circle.
template <bool kMixedHeights>
void DiscField::LookEach(const SightPoints& points, char* seen) const
{
  const Cells& cells = is_split_ ? cells_ : quadrants_;
  for (std::size_t group = 0; group < points.count; group += kLanes)
  {
    FloatLanes group_x = LoadLanes(&points.x[group]);
    const FloatLanes group_y = LoadLanes(&points.y[group]);
    // Straight above or below: moved aside by a micrometre, so that it has a direction.
    group_x = group_x * group_x + group_y * group_y < 1e-12F ? Everywhere(1e-6F) : group_x;
    FloatLanes z = LoadLanes(&points.z[group]);
    const FloatLanes lengths = SquareRoot(group_x * group_x + group_y * group_y);
    const FloatLanes units_x = group_x / lengths;
    const FloatLanes units_y = group_y / lengths;
    FloatLanes from{}, to = Everywhere(1.0F);
    if (heights_ != Heights::kSpanning)
    {
      constexpr float kTiny = 1e-20F;  // a level line: the quotients become huge, not NaN
      z = z == 0 ? Everywhere(kTiny) : z;
      const FloatLanes inverse = 1 / z;
      from = kMixedHeights ? inverse : Maximum(Minimum(low_ * inverse, high_ * inverse), from);
      to = Minimum(Maximum(low_ * inverse, high_ * inverse), to);
    }
    IntLanes cell = (group_x < 0 ? Everywhere(1) : IntLanes{}) + (group_y < 0 ? Everywhere(2) : IntLanes{});
    if (is_split_)
    {
      const FloatLanes beside = Magnitude(group_y);
      const IntLanes sector = Truncated(beside / (Magnitude(group_x) + beside) * static_cast<float>(kSectors));
      constexpr int kLast = static_cast<int>(kSectors) - 1;
      cell = cell * static_cast<int>(kSectors) + (sector < kLast ? sector : Everywhere(kLast));
    }
    const std::size_t count = std::min<std::size_t>(kLanes, points.count - group);
    for (std::size_t i = 0; i < count; ++i)
    {
      const float x = units_x[i];
      const float y = units_y[i];
      const std::int32_t owner = points.owner[group + i];
      FloatLanes first = Everywhere(from[i] * lengths[i]);
      FloatLanes last = Everywhere(to[i] * lengths[i]);
      const float slope = from[i] * lengths[i];  // of kMixed: m along the floor for each metre of height
      IntLanes hits{};
      const std::size_t begin = static_cast<std::size_t>(cell[i]) * cells.stride;
      const std::size_t end = begin + depth_[static_cast<std::size_t>(cell[i])];
      for (std::size_t place = begin; place < end; place += kLanes)
      {
        const FloatLanes disc_x = LoadLanes(&cells.x[place]);
        const FloatLanes disc_y = LoadLanes(&cells.y[place]);
        if constexpr (kMixedHeights)
        {
          const FloatLanes a = LoadLanes(&cells.low[place]) * slope;
          const FloatLanes b = LoadLanes(&cells.high[place]) * slope;
          first = Maximum(Minimum(a, b), FloatLanes{});
          last = Minimum(Maximum(a, b), Everywhere(lengths[i]));
        }
        const FloatLanes along = disc_x * x + disc_y * y;
        const FloatLanes nearest = Minimum(Maximum(along, first), last);
        const FloatLanes beside_x = nearest * x - disc_x;
        const FloatLanes beside_y = nearest * y - disc_y;
        hits |= (beside_x * beside_x + beside_y * beside_y <= LoadLanes(&cells.radius[place])) &
                (LoadLanes(&cells.entity[place]) != owner) & (first <= last);
      }
      seen[group + i] = LaneMask(hits) == 0;
    }
  }
}

void DiscField::Look(const SightPoints& points, char* seen) const
{
  if (heights_ == Heights::kMixed)
    LookEach<true>(points, seen);
  else
    LookEach<false>(points, seen);
}

}  // namespace swarmanoid
