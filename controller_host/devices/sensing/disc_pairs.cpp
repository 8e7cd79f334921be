// DiscField by directions and distances in bytes: which pairs of a line and a cylinder are tested.
#include <algorithm>
#include <bit>

#include "controller_host/devices/sensing/disc_field.h"
#include "controller_host/devices/sensing/disc_lines.h"

namespace swarmanoid
{
namespace
{

// These masks clear the bits of two cylinders' own places. The first half is read for the cylinders' first place, and
// the second half relative to the place of the first line.
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
void DiscField::LookThrough(const SightPoints& points, Found&& found)
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
      // Two cylinders are tested at a time. The entry after the last one meets nothing.
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

void DiscField::LookByBytes(const SightPoints& points, SeenPoints& seen)
{
  const bool are_mixed = heights_ == Heights::kMixed;
  const auto take = [&](std::size_t first, std::uint32_t those)
  {
    for (std::size_t i = first; i < std::min<std::size_t>(first + kByteLanes, points.count); i += kLanes)
      seen.SetGroup(i, those >> (i - first) & ((1U << kLanes) - 1));
  };
  if (is_crowd_)
  {
    ThinOut(points);
    seen.HideAll();
    return LookThrough<false, Owners::kPlaces>(
        left_, [&](std::size_t first, std::uint32_t those)
        { ForEachBit(those, [&](unsigned bit) { seen.Show(static_cast<std::size_t>(left_.owner[first + bit])); }); });
  }
  if (at_themselves_)
    return are_mixed ? LookThrough<true, Owners::kSamePlaces>(points, take)
                     : LookThrough<false, Owners::kSamePlaces>(points, take);
  return are_mixed ? LookThrough<true, Owners::kEntities>(points, take)
                   : LookThrough<false, Owners::kEntities>(points, take);
}

}  // namespace swarmanoid
