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

// Squares of the radii, less than 0 of those that hide nothing, and heights.
void DiscField::Measure(float eye, float lowest, float highest)
{
  const NearBodies& discs = *discs_;
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
      square = (LoadLanes(&discs.low[i]) - eye <= highest) & (LoadLanes(&discs.high[i]) - eye >= lowest)
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

namespace
{

// Of the masks of two cylinders all bits but those of their own places; from the middle on, by half the first place
// from that of the first line on.
constexpr std::size_t kOwnMiddle = 32;
constexpr auto kNotOwn = []
{
  std::array<std::uint64_t, 2 * kOwnMiddle> masks{};
  masks.fill(~std::uint64_t{0});
  for (std::size_t i = 0; i < kByteLanes / 2; ++i)
    masks[kOwnMiddle + i] = ~((std::uint64_t{1} | std::uint64_t{2} << kByteLanes) << 2 * i);
  return masks;
}();

}  // namespace

// The line from the eye to a point is as high as a cylinder from one place of it to another; the cylinder hides the
// point where what is nearest between these places is within its circle.
template <bool kMixedHeights, DiscField::Owners kOwners>
void DiscField::TestPairs(const std::int32_t* owners)
{
  Chunk& chunk = chunk_;
  StoreLanes(IntLanes{}, &chunk.pairs[chunk.count]);
  for (std::size_t pair = 0; pair < chunk.count; pair += kLanes)
  {
    const IntLanes both = LoadLanes(&chunk.pairs[pair]);
    const IntLanes line = both & (kByteLanes - 1);
    IntLanes disc = both >> std::countr_zero(unsigned{kByteLanes});
    if constexpr (kOwners == Owners::kPlaces) disc = Gathered(before_.place.data(), disc);
    FloatLanes first = Gathered(chunk.first.data(), line);
    FloatLanes last = Gathered(chunk.last.data(), line);
    if constexpr (kMixedHeights)
    {
      const FloatLanes slope = Gathered(chunk.slope.data(), line);
      const FloatLanes a = Gathered(disc_low_.data(), disc) * slope;
      const FloatLanes b = Gathered(disc_high_.data(), disc) * slope;
      first = Maximum(Minimum(a, b), FloatLanes{});
      last = Minimum(Maximum(a, b), Gathered(chunk.length.data(), line));
    }
    IntLanes meets =
        Meets(Gathered(discs_->x.data(), disc), Gathered(discs_->y.data(), disc), Gathered(square_.data(), disc),
              Gathered(chunk.x.data(), line), Gathered(chunk.y.data(), line), first, last) &
        (first <= last) & FirstLanes(chunk.count - pair);
    if constexpr (kOwners == Owners::kPlaces) meets &= Gathered(owners, line) != disc;
    if constexpr (kOwners == Owners::kEntities)
      meets &= Gathered(owners, line) != Gathered(discs_->entity.data(), disc);
    chunk.hidden |= meets & (Everywhere(1) << line);
  }
}

template <bool kMixedHeights, DiscField::Owners kOwners, class Found>
void DiscField::LookByBytes(const SightPoints& points, Found&& found)
{
  Chunk& chunk = chunk_;
  const std::size_t discs = kOwners == Owners::kPlaces ? before_.count : discs_->count;
  static_assert(std::endian::native == std::endian::little && kFew <= 2 * kOwnMiddle);
  const auto* const bytes =
      reinterpret_cast<const std::uint8_t*>(kOwners == Owners::kPlaces ? before_.meets.data() : bytes_.meets.data());
  for (std::size_t begin = 0; begin < points.count; begin += kByteLanes)
  {
    const std::size_t count = std::min<std::size_t>(kByteLanes, points.count - begin);
    for (std::size_t i = 0; i < count; i += kLanes)
    {
      const Lines lines = LinesTo(points, begin + i);
      StoreLanes(lines.x, &chunk.x[i]);
      StoreLanes(lines.y, &chunk.y[i]);
      StoreLanes(lines.first, &chunk.first[i]);
      StoreLanes(lines.last, &chunk.last[i]);
      if constexpr (kMixedHeights)
      {
        StoreLanes(lines.inverse * lines.length, &chunk.slope[i]);
        StoreLanes(lines.length, &chunk.length[i]);
      }
      StoreLowBytes(Truncated(TurnInBytes(lines.x, lines.y)), &chunk.turn[i]);
      StoreLowBytes(Truncated(Minimum(lines.length * steps_per_m_, Everywhere(kFarthestByte))), &chunk.distance[i]);
    }
    const std::uint64_t are_there = ((std::uint64_t{1} << count) - 1) * ((std::uint64_t{1} << kByteLanes) + 1);
    const ByteLanes turn = LoadLanes(chunk.turn.data());
    const ByteLanes distance = LoadLanes(chunk.distance.data());
    const std::int32_t* const owners = &points.owner[begin];
    const std::uint64_t* const not_own = &kNotOwn[kOwnMiddle - (kOwners == Owners::kSamePlaces ? begin / 2 : 0)];
    const auto meet = [&](const std::uint8_t* disc) -> std::uint64_t
    { return ByteMask((turn - Everywhere(disc[0]) <= Everywhere(disc[1])) & (distance >= Everywhere(disc[2]))); };
    chunk.hidden = IntLanes{};
    for (std::size_t from = 0; from < discs; from += kBlock)
    {
      const std::size_t behind = std::min(from + kBlock, discs);
      std::int32_t* pairs = chunk.pairs.data();
      // Two at a time; what stands behind the last one meets nothing.
      for (std::size_t disc = from; disc < behind; disc += 2)
      {
        const std::uint8_t* const one = bytes + disc * sizeof(std::int32_t);
        std::uint64_t mask = (meet(one) | meet(one + sizeof(std::int32_t)) << kByteLanes) & are_there;
        if constexpr (kOwners == Owners::kSamePlaces) mask &= not_own[disc / 2];
        const auto place = static_cast<std::int32_t>(disc * kByteLanes);
        // The first two without a branch that would be guessed wrong.
        const auto those = static_cast<std::size_t>(std::popcount(mask));
        constexpr std::uint64_t kSome = std::uint64_t{1} << 63;
        pairs[0] = place + std::countr_zero(mask | kSome);
        mask &= mask - 1;
        pairs[1] = place + std::countr_zero(mask | kSome);
        for (std::size_t k = 2; k < those; ++k)
        {
          mask &= mask - 1;
          pairs[k] = place + std::countr_zero(mask);
        }
        pairs += those;
      }
      chunk.count = static_cast<std::size_t>(pairs - chunk.pairs.data());
      TestPairs<kMixedHeights, kOwners>(owners);
    }
    std::uint32_t hidden = 0;
    for (int lane = 0; lane < kLanes; ++lane) hidden |= static_cast<std::uint32_t>(chunk.hidden[lane]);
    found(begin, static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1) & ~hidden);
  }
}

void DiscField::ThinOut(const SightPoints& points)
{
  cover_.Lay(bytes_, points.count);
  left_.count = before_.count = 0;
  if (left_.x.size() < points.count + 2 * kLanes) left_.Reserve(2 * points.count + 2 * kLanes);
  for (std::vector<std::int32_t>* values : {&before_.place, &before_.meets}) values->resize(left_.x.size());
  for (std::size_t i = 0; i < points.count; i += kLanes)
  {
    const IntLanes are_there = FirstLanes(points.count - i);
    const IntLanes places = static_cast<int>(i) + LaneNumbers();
    const Selection left(LaneMask(are_there & ~cover_.HidesMiddles(LoadLanes(&bytes_.middles[i]))));
    left.Store(LoadLanes(&points.x[i]), &left_.x[left_.count]);
    left.Store(LoadLanes(&points.y[i]), &left_.y[left_.count]);
    left.Store(places, &left_.owner[left_.count]);
    left_.count += left.Count();
    const IntLanes meets = LoadLanes(&bytes_.meets[i]);
    const Selection before(LaneMask(are_there & ~cover_.HidesAll(meets)));
    before.Store(places, &before_.place[before_.count]);
    before.Store(meets, &before_.meets[before_.count]);
    before_.count += before.Count();
  }
  before_.meets[before_.count] = kMeetsNothing;
}

template <bool kMixedHeights>
void DiscField::LookAtHandful(const SightPoints& points, SeenPoints& seen) const
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

void DiscField::Look(const SightPoints& points, SeenPoints& seen)
{
  seen.Resize(points.count);
  const bool are_mixed = heights_ == Heights::kMixed;
  if (!by_bytes_) return are_mixed ? LookAtMany<true>(points, seen) : LookAtMany<false>(points, seen);
  if (are_handful_) return are_mixed ? LookAtHandful<true>(points, seen) : LookAtHandful<false>(points, seen);
  const auto take = [&](std::size_t first, std::uint32_t those)
  {
    for (std::size_t i = first; i < std::min<std::size_t>(first + kByteLanes, points.count); i += kLanes)
      seen.SetGroup(i, those >> (i - first) & ((1U << kLanes) - 1));
  };
  if (is_crowd_)
  {
    ThinOut(points);
    seen.HideAll();
    return LookByBytes<false, Owners::kPlaces>(
        left_, [&](std::size_t first, std::uint32_t those)
        { ForEachBit(those, [&](unsigned bit) { seen.Show(static_cast<std::size_t>(left_.owner[first + bit])); }); });
  }
  if (at_themselves_)
    return are_mixed ? LookByBytes<true, Owners::kSamePlaces>(points, take)
                     : LookByBytes<false, Owners::kSamePlaces>(points, take);
  return are_mixed ? LookByBytes<true, Owners::kEntities>(points, take)
                   : LookByBytes<false, Owners::kEntities>(points, take);
}

}  // namespace swarmanoid
