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
void DiscField::TestPairs(const std::int32_t* owners, const std::int32_t* places)
{
  Chunk& chunk = chunk_;
  StoreLanes(IntLanes{}, &chunk.pairs[chunk.count]);
  for (std::size_t pair = 0; pair < chunk.count; pair += kLanes)
  {
    const IntLanes both = LoadLanes(&chunk.pairs[pair]);
    const IntLanes line = both & (kByteLanes - 1);
    IntLanes disc = both >> std::countr_zero(unsigned{kByteLanes});
    if constexpr (kOwners == Owners::kPlaces) disc = Gathered(places, disc);
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
void DiscField::LookThrough(const PointView& points, const Candidates& discs, Found&& found)
{
  Chunk& chunk = chunk_;
  static_assert(std::endian::native == std::endian::little && kFew <= 2 * kOwnMiddle && kFew <= kBlock);
  const auto* const bytes = reinterpret_cast<const std::uint8_t*>(discs.meets);
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
    const auto meet = [&](const std::uint8_t* disc) -> std::uint64_t
    { return ByteMask((turn - Everywhere(disc[0]) <= Everywhere(disc[1])) & (distance >= Everywhere(disc[2]))); };
    chunk.hidden = IntLanes{};
    for (std::size_t from = 0; from < discs.count; from += kBlock)
    {
      const std::size_t behind = std::min(from + kBlock, discs.count);
      // Two cylinders are tested at a time. The entry after the last one meets nothing. Those that no line may meet are
      // left out without a branch, which would be guessed wrong.
      std::size_t some = 0;
      const std::uint64_t* not_own = &kNotOwn[kOwnMiddle - (kOwners == Owners::kSamePlaces ? begin / 2 : 0)];
      for (std::size_t disc = from; disc < behind; disc += 2)
      {
        const std::uint8_t* const one = bytes + disc * sizeof(std::int32_t);
        std::uint64_t meeting = (meet(one) | meet(one + sizeof(std::int32_t)) << kByteLanes) & are_there;
        if constexpr (kOwners == Owners::kSamePlaces) meeting &= *not_own++;
        chunk.meeting[some] = meeting;
        chunk.disc[some] = static_cast<std::uint32_t>(disc);
        some += meeting != 0 ? 1 : 0;
      }
      std::int32_t* pairs = chunk.pairs.data();
      for (std::size_t two = 0; two < some; ++two)
      {
        std::uint64_t meeting = chunk.meeting[two];
        const auto first = static_cast<std::int32_t>(chunk.disc[two] * kByteLanes);
        const auto those = static_cast<std::size_t>(std::popcount(meeting));
        // The first two again without a branch.
        constexpr std::uint64_t kSome = std::uint64_t{1} << 63;
        pairs[0] = first + std::countr_zero(meeting);
        meeting &= meeting - 1;
        pairs[1] = first + std::countr_zero(meeting | kSome);
        for (std::size_t k = 2; k < those; ++k)
        {
          meeting &= meeting - 1;
          pairs[k] = first + std::countr_zero(meeting);
        }
        pairs += those;
      }
      chunk.count = static_cast<std::size_t>(pairs - chunk.pairs.data());
      TestPairs<kMixedHeights, kOwners>(owners, discs.place);
    }
    std::uint32_t hidden = 0;
    for (int lane = 0; lane < kLanes; ++lane) hidden |= static_cast<std::uint32_t>(chunk.hidden[lane]);
    found(begin, static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1) & ~hidden);
  }
}

void DiscField::Half::Reserve(std::size_t places)
{
  if (place.size() >= places + kLanes) return;
  left.Reserve(2 * places);
  for (std::vector<std::int32_t>* values : {&place, &meets}) values->resize(2 * places + kLanes);
}

// Keeps the points and the cylinders that the cover does not hide, in the half of the directions in which they are.
// Cylinders at the borders are in both.
void DiscField::ThinOut(const PointView& points)
{
  constexpr int kHalfTurn = 128;
  cover_.Lay(bytes_, points.count);
  for (Half& half : halves_) half.Reserve(points.count);
  std::size_t left_counts[2] = {}, counts[2] = {};
  for (std::size_t i = 0; i < points.count; i += kLanes)
  {
    const FloatLanes x = LoadLanes(points.x + i);
    const FloatLanes y = LoadLanes(points.y + i);
    const IntLanes middles = LoadLanes(&bytes_.middles[i]);
    const IntLanes meets = LoadLanes(&bytes_.meets[i]);
    const IntLanes places = static_cast<int>(i) + LaneNumbers();
    const IntLanes are_there = FirstLanes(points.count - i);
    const IntLanes are_left = are_there & ~cover_.HidesMiddles(middles);
    const IntLanes in_second = LowestByte(middles) >= kHalfTurn;
    const IntLanes are_before = are_there & ~cover_.HidesAll(meets);
    const IntLanes first = LowestByte(meets);
    const IntLanes last = first + SecondByte(meets);
    const IntLanes points_in[2] = {are_left & ~in_second, are_left & in_second};
    const IntLanes discs_in[2] = {are_before & ((first < kHalfTurn) | (last >= 2 * kHalfTurn)),
                                  are_before & (last >= kHalfTurn)};
    for (std::size_t h = 0; h < 2; ++h)
    {
      Half& half = halves_[h];
      const Selection left(LaneMask(points_in[h]));
      left.Store(x, half.left.x.data() + left_counts[h]);
      left.Store(y, half.left.y.data() + left_counts[h]);
      left.Store(places, half.left.owner.data() + left_counts[h]);
      left_counts[h] += left.Count();
      const Selection before(LaneMask(discs_in[h]));
      before.Store(places, half.place.data() + counts[h]);
      before.Store(meets, half.meets.data() + counts[h]);
      counts[h] += before.Count();
    }
  }
  for (std::size_t h = 0; h < 2; ++h)
  {
    halves_[h].left.count = left_counts[h];
    halves_[h].count = counts[h];
    halves_[h].meets[counts[h]] = kMeetsNothing;
  }
}

void DiscField::LookByBytes(const PointView& points, SeenPoints& seen)
{
  const bool are_mixed = heights_ == Heights::kMixed;
  if (is_crowd_)
  {
    ThinOut(points);
    seen.HideAll();
    for (const Half& half : halves_)
      LookThrough<false, Owners::kPlaces>(
          half.left, {half.count, half.meets.data(), half.place.data()},
          [&](std::size_t first, std::uint32_t those) {
            ForEachBit(those, [&](unsigned bit) { seen.Show(static_cast<std::size_t>(half.left.owner[first + bit])); });
          });
    return;
  }
  const Candidates all{discs_->count, bytes_.meets.data(), nullptr};
  const auto take = [&](std::size_t first, std::uint32_t those)
  {
    for (std::size_t i = first; i < std::min<std::size_t>(first + kByteLanes, points.count); i += kLanes)
      seen.SetGroup(i, those >> (i - first) & ((1U << kLanes) - 1));
  };
  if (at_themselves_)
    return are_mixed ? LookThrough<true, Owners::kSamePlaces>(points, all, take)
                     : LookThrough<false, Owners::kSamePlaces>(points, all, take);
  return are_mixed ? LookThrough<true, Owners::kEntities>(points, all, take)
                   : LookThrough<false, Owners::kEntities>(points, all, take);
}

}  // namespace swarmanoid
