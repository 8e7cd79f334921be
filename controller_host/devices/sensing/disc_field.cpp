// Problem: find the points that upright cylinders hide from an eye. In a swarm there may be thousands of lines and
// cylinders, and most pairs do not meet.
//
// Method: up to kFew cylinders are tested with all lines, if few enough directly, otherwise where direction bytes say
// that they may meet. A crowd that looks at itself, with cylinders higher and lower than all points, uses the bytes and
// the cover (disc_cover.h). Any other crowd is sorted into sectors, and each point is tested with the cell of its
// direction, kLanes cylinders at a time.
//
// Invariants: each way gives the same points. Cells are filled up with cylinders that hide nothing, so that loops need
// no test for the end.
#include "controller_host/devices/sensing/disc_field.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "controller_host/devices/sensing/disc_lines.h"

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

void DiscField::Sort(const NearBodies& discs, float eye, float lowest, float highest, float reach, bool at_themselves)
{
  Classify(discs, eye, lowest, highest);
  at_themselves_ = at_themselves;
  is_crowd_ = discs.count > kFew && at_themselves && heights_ == Heights::kSpanning && all_count_;
  by_bytes_ = discs.count <= kFew || is_crowd_;
  are_handful_ = discs.count <= kHandful;
  if (by_bytes_)
  {
    discs_ = &discs;
    Measure(eye, lowest, highest);
    if (are_handful_) return;
    steps_per_m_ = kFarthestByte / std::max(reach, 0.01F);
    return bytes_.Read(discs, steps_per_m_, is_crowd_);
  }
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

// Computes the squares of the radii, less than 0 for cylinders that hide nothing, and the heights. Does nothing without
// cylinders: the arrays are allocated when the first cylinder is measured.
void DiscField::Measure(float eye, float lowest, float highest)
{
  const NearBodies& discs = *discs_;
  if (discs.count == 0) return;
  const bool are_equal = discs.are_alike && all_count_ && heights_ != Heights::kMixed;
  if (are_equal && discs.count <= equal_count_ && square_[0] == discs.radius[0] * discs.radius[0]) return;
  equal_count_ = are_equal ? discs.count : 0;
  if (square_.size() < discs.count + kLanes)
    for (std::vector<float>* values : {&square_, &disc_low_, &disc_high_}) values->resize(2 * discs.count + kLanes);
  for (std::size_t i = 0; i < discs.count; i += kLanes)
  {
    const FloatLanes radius = LoadLanes(&discs.radius[i]);
    FloatLanes square = radius * radius;
    if (!all_count_)
      square = ((LoadLanes(&discs.low[i]) - eye <= highest) & (LoadLanes(&discs.high[i]) - eye >= lowest))
                   ? square
                   : Everywhere(-1.0F);
    StoreLanes(square, &square_[i]);
    if (heights_ != Heights::kMixed) continue;
    StoreLanes(LoadLanes(&discs.low[i]) - eye, &disc_low_[i]);
    StoreLanes(LoadLanes(&discs.high[i]) - eye, &disc_high_[i]);
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

template <bool kMixedHeights>
void DiscField::LookAtHandful(const PointView& points, SeenPoints& seen) const
{
  for (std::size_t group = 0; group < points.count; group += kLanes)
  {
    const Lines lines = LinesTo(points, group);
    const IntLanes owner = LoadLanes(&points.owner[group]);
    const FloatLanes slope = lines.inverse * lines.length;
    IntLanes hits{};
    for (std::size_t i = 0; i < discs_->count; ++i)
    {
      FloatLanes first = lines.first;
      FloatLanes last = lines.last;
      if constexpr (kMixedHeights)
      {
        const FloatLanes a = disc_low_[i] * slope;
        const FloatLanes b = disc_high_[i] * slope;
        first = Maximum(Minimum(a, b), FloatLanes{});
        last = Minimum(Maximum(a, b), lines.length);
      }
      IntLanes meets = Meets(Everywhere(discs_->x[i]), Everywhere(discs_->y[i]), Everywhere(square_[i]), lines.x,
                             lines.y, first, last);
      if constexpr (kMixedHeights) meets &= first <= last;
      hits |= ~(owner == discs_->entity[i]) & meets;
    }
    if constexpr (!kMixedHeights) hits &= lines.first <= lines.last;
    seen.SetGroup(group, LaneMask(FirstLanes(points.count - group) & ~hits));
  }
}

template <bool kMixedHeights>
void DiscField::LookAtMany(const PointView& points, SeenPoints& seen) const
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

void DiscField::Look(const PointView& points, SeenPoints& seen)
{
  seen.Resize(points.count);
  const bool are_mixed = heights_ == Heights::kMixed;
  if (!by_bytes_) return are_mixed ? LookAtMany<true>(points, seen) : LookAtMany<false>(points, seen);
  if (are_handful_) return are_mixed ? LookAtHandful<true>(points, seen) : LookAtHandful<false>(points, seen);
  LookByBytes(points, seen);
}

}  // namespace swarmanoid
