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

namespace swarmanoid
{
namespace
{

constexpr std::size_t kSide = 8;  // numbers of a row that are packed together: a cache line
// The most numbers of the ticks that are packed together; they fit into the caches.
constexpr std::size_t kMostNumbers = std::size_t{1} << 19U;
using Line = std::array<std::uint64_t, kSide>;

// Maps small differences of either sign to small numbers.
std::uint64_t Folded(std::uint64_t difference) { return (difference << 1U) ^ (0 - (difference >> 63U)); }
std::uint64_t Unfolded(std::uint64_t folded) { return (folded >> 1U) ^ (0 - (folded & 1U)); }

// Returns the expected value of the number at `at` in the row of a tick.
double Expected(const double* at, std::size_t tick, std::size_t row, bool moves)
{
  if (tick == 0) return 0;
  const double before = *(at - row);
  if (!moves || tick == 1) return before;
  return before + (before - *(at - 2 * row));
}

// Computes the same for a line of numbers that all move, or all stay.
template <bool kMoves>
void FoldLine(const double* at, std::size_t row, Line& folded)
{
  const double* before = at - row;
  const double* before_that = kMoves ? before - row : before;
  for (std::size_t k = 0; k < kSide; ++k)
  {
    double expected = before[k];
    if constexpr (kMoves) expected += before[k] - before_that[k];
    folded[k] = Folded(std::bit_cast<std::uint64_t>(at[k]) - std::bit_cast<std::uint64_t>(expected));
  }
}

}  // namespace

std::size_t TicksTogether(std::size_t row) { return row * kSide <= kMostNumbers ? kSide : 1; }

void RowPacker::Begin(std::size_t row, std::size_t moving)
{
  row_ = row;
  moving_ = moving;
  together_ = TicksTogether(row);
  packed_ = waiting_ = used_ = 0;
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
  // All eight bytes of each number are written; the next number overwrites the unneeded ones.
  char* out = room_.AtLeast(used_ + (waiting_ * row_ + 1) * sizeof(std::uint64_t)) + used_;
  std::array<Line, kSide> lines{};  // one for each tick
  for (std::size_t first = 0; first < row_; first += kSide)
  {
    const std::size_t count = std::min(kSide, row_ - first);
    const bool all_move = first + kSide <= moving_;
    const bool none_moves = first >= moving_;
    Line any{};
    for (std::size_t tick = 0; tick < waiting_; ++tick)
    {
      const double* at = Row(kBefore + tick) + first;
      Line& folded = lines[tick];
      if (count == kSide && packed_ + tick > 1 && all_move)
        FoldLine<true>(at, row_, folded);
      else if (count == kSide && packed_ + tick > 1 && none_moves)
        FoldLine<false>(at, row_, folded);
      else
        for (std::size_t k = 0; k < count; ++k)
          folded[k] = Folded(std::bit_cast<std::uint64_t>(at[k]) -
                             std::bit_cast<std::uint64_t>(Expected(at + k, packed_ + tick, row_, first + k < moving_)));
      for (std::size_t k = 0; k < kSide; ++k) any[k] |= folded[k];
    }
    if (std::ranges::all_of(any, [](std::uint64_t differences) { return differences == 0; }))
    {
      widths_.insert(widths_.end(), count, '\0');
      continue;
    }
    for (std::size_t k = 0; k < count; ++k)
    {
      const std::size_t width = (static_cast<std::size_t>(std::bit_width(any[k])) + 7) / 8;
      widths_.push_back(static_cast<char>(width));
      if (width == 0) continue;
      for (std::size_t tick = 0; tick < waiting_; ++tick, out += width)
        std::memcpy(out, &lines[tick][k], sizeof(std::uint64_t));
    }
  }
  used_ = static_cast<std::size_t>(out - room_.Bytes());
  // If only one row was packed, the row before it stays.
  std::copy_n(Row(waiting_), kBefore * row_, Row(0));
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
        const auto expected = std::bit_cast<std::uint64_t>(Expected(at, tick, row, k < moving));
        *at = std::bit_cast<double>(expected + Unfolded(folded));
      }
    }
  if (left != 0) throw damaged();
  return rows;
}

}  // namespace swarmanoid
