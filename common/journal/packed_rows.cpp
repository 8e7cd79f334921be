// A journal would have 7 doubles of each body at each tick. Bodies move smoothly, so a number of a pose is close to the
// line through its last two values; other numbers are compared with their last value alone. The integer difference of
// the bits is small. The difference is folded so that small negative ones are small numbers too. Its unused upper bytes
// are left out, and zstd compresses the rest. The header names the source.
//
// Invariant: packing and unpacking compute the expected number by the same operations, so that the difference restores
// every bit.
#include "common/journal/packed_rows.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "common/math/lanes.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kSide = 8;  // numbers of a row that are packed together: a cache line
// The most numbers of the ticks that are packed together; they fit into the caches.
constexpr std::size_t kMostNumbers = std::size_t{1} << 19U;
using Line = std::array<std::uint64_t, kSide>;
typedef std::uint64_t BitLanes __attribute__((vector_size(sizeof(DoubleLanes))));

// Maps small differences of either sign to small numbers.
std::uint64_t Folded(std::uint64_t difference) { return (difference << 1U) ^ (0 - (difference >> 63U)); }
std::uint64_t Unfolded(std::uint64_t folded) { return (folded >> 1U) ^ (0 - (folded & 1U)); }

// Returns the expected value of a number at a tick, from its values one and two ticks before.
double Expected(const double* before, const double* before_that, std::size_t tick, bool moves)
{
  if (tick == 0) return 0;
  if (!moves || tick == 1) return *before;
  return *before + (*before - *before_that);
}

std::uint64_t FoldedDifference(double number, double expected)
{
  return Folded(std::bit_cast<std::uint64_t>(number) - std::bit_cast<std::uint64_t>(expected));
}

// Does so in each lane.
BitLanes FoldedDifference(DoubleLanes numbers, DoubleLanes expected)
{
  const BitLanes difference = reinterpret_cast<BitLanes>(numbers) - reinterpret_cast<BitLanes>(expected);
  return difference << 1 ^ reinterpret_cast<BitLanes>(reinterpret_cast<LongLanes>(difference) < 0);
}

char BytesOf(std::uint64_t folded) { return static_cast<char>((std::bit_width(folded) + 7) / 8); }

// Packs the numbers [first, end) of some rows, line by line: each in as many bytes as its largest difference needs.
class LinePacker
{
public:
  using Rows = std::array<const double*, RowPacker::kBefore + kSide>;

  LinePacker(const Rows& rows, std::size_t ticks, char* widths, char* out)
      : rows_(rows), ticks_(ticks), widths_(widths), out_(out)
  {
  }
  char* Behind() const { return out_; }

  // Packs whole lines whose numbers are all expected from that many values before.
  template <int kValues, std::size_t kTicks>
  void Whole(std::size_t first, std::size_t end)
  {
    std::array<Line, kTicks> lines;
    Line any;
    for (; first < end; first += kSide)
    {
      BitLanes any_of_line{};
      for (std::size_t k = 0; k < kSide; k += kDoubleLanes)
      {
        const BitLanes any_of_lanes = FoldLanes<kValues>(first + k, k, lines);
        std::memcpy(&any[k], &any_of_lanes, sizeof any_of_lanes);
        any_of_line |= any_of_lanes;
      }
      if (LaneMask(any_of_line != 0) == 0) continue;  // the widths are 0 already
      for (std::size_t k = 0; k < kSide; ++k)
      {
        const char width = BytesOf(any[k]);
        widths_[first + k] = width;
        for (std::size_t tick = 0; tick < kTicks; ++tick) Store(lines[tick][k], out_ + tick * width);
        out_ += kTicks * width;
      }
    }
  }
  // Packs any numbers, of which those below `moving` move. `packed`: the number of earlier rows.
  void Any(std::size_t first, std::size_t end, std::size_t moving, std::size_t packed)
  {
    for (; first < end; ++first)
    {
      std::array<std::uint64_t, kSide> folded{};
      std::uint64_t any = 0;
      for (std::size_t tick = 0; tick < ticks_; ++tick)
        any |= folded[tick] =
            FoldedDifference(rows_[tick + 2][first],
                             Expected(rows_[tick + 1] + first, rows_[tick] + first, packed + tick, first < moving));
      widths_[first] = BytesOf(any);
      for (std::size_t tick = 0; tick < ticks_; ++tick, out_ += widths_[first]) Store(folded[tick], out_);
    }
  }

private:
  // Writes the folded differences of some consecutive numbers at all ticks to the line of each tick, from place k on.
  // Returns the bits that any of them has.
  template <int kValues, std::size_t kTicks>
  BitLanes FoldLanes(std::size_t number, std::size_t k, std::array<Line, kTicks>& lines) const
  {
    BitLanes any{};
    DoubleLanes before_that = LoadLanes(rows_[0] + number);
    DoubleLanes before = LoadLanes(rows_[1] + number);
    for (std::size_t tick = 0; tick < kTicks; ++tick)
    {
      const DoubleLanes numbers = LoadLanes(rows_[tick + 2] + number);
      DoubleLanes expected{};
      if constexpr (kValues > 0) expected = before;
      if constexpr (kValues > 1) expected += before - before_that;
      const BitLanes folded = FoldedDifference(numbers, expected);
      std::memcpy(&lines[tick][k], &folded, sizeof folded);
      any |= folded;
      before_that = before;
      before = numbers;
    }
    return any;
  }
  // All eight bytes are written; the next number overwrites the unneeded ones.
  static void Store(std::uint64_t folded, char* out) { std::memcpy(out, &folded, sizeof folded); }

  const Rows& rows_;
  std::size_t ticks_;
  char* widths_;
  char* out_;
};

}  // namespace

std::size_t TicksTogether(std::size_t row) { return row * kSide <= kMostNumbers ? kSide : 1; }

void RowPacker::Begin(std::size_t row, std::size_t moving)
{
  row_ = row;
  moving_ = moving;
  together_ = TicksTogether(row);
  packed_ = waiting_ = used_ = oldest_ = 0;
  widths_.clear();
  recent_.AtLeast((kBefore + together_) * row * sizeof(double));
}

void RowPacker::Added()
{
  if (++waiting_ == together_) Pack();
}

void RowPacker::Finish()
{
  if (waiting_ > 0) Pack();
}

void RowPacker::Pack()
{
  char* const out = room_.AtLeast(used_ + (waiting_ * row_ + 1) * sizeof(std::uint64_t)) + used_;
  const std::size_t packed_widths = widths_.size();
  widths_.resize(packed_widths + row_);
  LinePacker::Rows rows{};
  for (std::size_t place = 0; place < kBefore + waiting_; ++place) rows[place] = Row(place);
  LinePacker lines(rows, waiting_, widths_.data() + packed_widths, out);
  const bool is_one = waiting_ == 1;
  if (!is_one && (waiting_ != kSide || packed_ < kBefore))
    lines.Any(0, row_, moving_, packed_);
  else
  {
    // The first rows are expected as if nothing moved.
    const std::size_t moving = packed_ < kBefore ? 0 : moving_;
    const std::size_t end_of_moving = moving / kSide * kSide;
    const std::size_t start_of_others = std::min((moving + kSide - 1) / kSide * kSide, row_);
    const std::size_t end_of_others = start_of_others + (row_ - start_of_others) / kSide * kSide;
    is_one ? lines.Whole<2, 1>(0, end_of_moving) : lines.Whole<2, kSide>(0, end_of_moving);
    lines.Any(end_of_moving, start_of_others, moving, packed_);
    if (packed_ == 0)
      lines.Whole<0, 1>(start_of_others, end_of_others);
    else
      is_one ? lines.Whole<1, 1>(start_of_others, end_of_others)
             : lines.Whole<1, kSide>(start_of_others, end_of_others);
    lines.Any(end_of_others, row_, moving, packed_);
  }
  used_ = static_cast<std::size_t>(lines.Behind() - room_.Bytes());
  oldest_ = (oldest_ + waiting_) % (kBefore + together_);
  packed_ += waiting_;
  waiting_ = 0;
}

std::vector<double> UnpackRows(std::span<const char> widths, std::span<const char> bytes, std::size_t ticks,
                               std::size_t row, std::size_t moving)
{
  const auto damaged = [] { return std::runtime_error("journal: the rows of a block are not as long as it says"); };
  const std::size_t together = TicksTogether(row);
  if (widths.size() != (ticks + together - 1) / together * row) throw damaged();
  std::vector<double> rows(ticks * row);
  auto width = widths.begin();
  const char* in = bytes.data();
  std::size_t left = bytes.size();
  for (std::size_t from = 0; from < ticks; from += together)
    for (std::size_t k = 0; k < row; ++k, ++width)
    {
      const auto size = static_cast<std::size_t>(static_cast<unsigned char>(*width));
      const std::size_t until = std::min(ticks, from + together);
      if (size > sizeof(double) || size * (until - from) > left) throw damaged();
      left -= size * (until - from);
      for (std::size_t tick = from; tick < until; ++tick, in += size)
      {
        std::uint64_t folded = 0;
        std::memcpy(&folded, in, size);
        double* at = rows.data() + tick * row + k;
        const double* const before = at - std::min(tick, std::size_t{1}) * row;
        const double* const before_that = at - std::min(tick, std::size_t{2}) * row;
        const auto expected = std::bit_cast<std::uint64_t>(Expected(before, before_that, tick, k < moving));
        *at = std::bit_cast<double>(expected + Unfolded(folded));
      }
    }
  if (left != 0) throw damaged();
  return rows;
}

}  // namespace swarmanoid
