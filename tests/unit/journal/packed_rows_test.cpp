// The numbers of journals: packed and unpacked they are the same bits, and what is damaged is refused.
#include "common/journal/packed_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace swarmanoid
{
namespace
{

// Numbers that stay, that move smoothly, and of any bits at all.
std::vector<double> SomeRows(std::size_t ticks, std::size_t row, std::uint64_t seed)
{
  std::mt19937_64 random(seed);
  const std::vector<double> odd{0.0,
                                -0.0,
                                std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::quiet_NaN(),
                                std::numeric_limits<double>::denorm_min(),
                                -std::numeric_limits<double>::max()};
  std::vector<double> rows(ticks * row);
  for (std::size_t k = 0; k < row; ++k)
  {
    const std::uint64_t kind = random() % 4;
    for (std::size_t tick = 0; tick < ticks; ++tick)
    {
      double& value = rows[tick * row + k];
      if (kind == 0) value = static_cast<double>(k);
      if (kind == 1) value = std::sin(0.01 * static_cast<double>(tick + k));
      if (kind == 2) value = std::bit_cast<double>(random());
      if (kind == 3) value = odd[random() % odd.size()];
    }
  }
  return rows;
}

void Pack(const std::vector<double>& rows, std::size_t row, std::size_t moving, RowPacker& packer)
{
  packer.Begin(row, moving);
  for (std::size_t at = 0; at < rows.size(); at += row)
  {
    std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(at), row, packer.NextRow());
    packer.Added();
  }
  packer.Finish();
}

TEST(PackedRows, AreTheSameBitsWhateverTheNumbersAndLengths)
{
  RowPacker packed;
  std::uint64_t seed = 0;
  for (const std::size_t ticks : {1, 2, 3, 7, 8, 9, 16, 63, 64})
    for (const std::size_t row : {1, 7, 8, 9, 15, 16, 17, 40})
      for (const std::size_t moving : {std::size_t{0}, row / 3, row / 2, row})
      {
        const std::vector<double> rows = SomeRows(ticks, row, ++seed);
        Pack(rows, row, moving, packed);
        const std::vector<double> back = UnpackRows(packed.Widths(), packed.Bytes(), ticks, row, moving);
        ASSERT_EQ(back.size(), rows.size());
        for (std::size_t k = 0; k < rows.size(); ++k)
          ASSERT_EQ(std::bit_cast<std::uint64_t>(back[k]), std::bit_cast<std::uint64_t>(rows[k]))
              << ticks << " ticks of " << row << ", " << moving << " of them moving: number " << k;
      }
}

// Eight ticks of a million numbers would take 80 MiB: each row is packed at once.
TEST(PackedRows, LongRowsArePackedOneByOne)
{
  constexpr std::size_t kRow = 140000;
  ASSERT_EQ(TicksTogether(kRow), 1U);
  RowPacker packed;
  const std::vector<double> rows = SomeRows(4, kRow, 7);
  Pack(rows, kRow, 70001, packed);
  const std::vector<double> back = UnpackRows(packed.Widths(), packed.Bytes(), 4, kRow, 70001);
  ASSERT_EQ(back.size(), rows.size());
  EXPECT_EQ(std::memcmp(back.data(), rows.data(), rows.size() * sizeof(double)), 0);
}

TEST(PackedRows, WhatStaysTakesNoBytesAndWhatMovesEvenlyFew)
{
  constexpr std::size_t kTicks = 64;
  constexpr std::size_t kRow = 20;
  std::vector<double> rows;
  for (std::size_t tick = 0; tick < kTicks; ++tick)
    for (std::size_t k = 0; k < kRow; ++k)
      rows.push_back(k < 10 ? 0.5 + 0.25 * static_cast<double>(tick) : static_cast<double>(k));
  RowPacker packed;
  Pack(rows, kRow, 10, packed);
  // All but the first eight ticks, where nothing is known before.
  EXPECT_LE(packed.Bytes().size(), kRow * 8 * sizeof(double));
  Pack(rows, kRow, 0, packed);
  EXPECT_GT(packed.Bytes().size(), kRow * 8 * sizeof(double)) << "what moves was not expected to";
}

TEST(PackedRows, DamagedOnesAreRefused)
{
  constexpr std::size_t kTicks = 20;
  constexpr std::size_t kRow = 11;
  RowPacker packed;
  Pack(SomeRows(kTicks, kRow, 1), kRow, 5, packed);
  const std::vector<char> bytes(packed.Bytes().begin(), packed.Bytes().end());
  const auto unpack = [&](std::span<const char> widths, std::span<const char> of)
  { return UnpackRows(widths, of, kTicks, kRow, 5); };
  EXPECT_NO_THROW(unpack(packed.Widths(), bytes));
  EXPECT_THROW(unpack(packed.Widths().first(packed.Widths().size() - 1), bytes), std::runtime_error);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(unpack(packed.Widths(), std::span(bytes).first(size)), std::runtime_error) << size;
  for (std::size_t k = 0; k < packed.Widths().size(); ++k)
    for (const int width : {-1, 9, 127})
    {
      std::vector<char> widths(packed.Widths().begin(), packed.Widths().end());
      widths[k] = static_cast<char>(width);
      EXPECT_THROW(unpack(widths, bytes), std::runtime_error) << k;
    }
}

}  // namespace
}  // namespace swarmanoid
