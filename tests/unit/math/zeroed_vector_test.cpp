#include "common/math/zeroed_vector.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <numeric>

namespace swarmanoid
{
namespace
{

std::size_t ResidentBytes()
{
  std::ifstream file("/proc/self/statm");
  std::size_t size = 0, resident = 0;
  file >> size >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

// Whether reading alone takes memory, the system decides.
TEST(ZeroedVector, TakesMemoryForWhatIsWrittenAlone)
{
  constexpr std::size_t kNumbers = 16U << 20U;  // 128 MiB
  const std::size_t before = ResidentBytes();
  ZeroedVector<double> numbers;
  numbers.resize(kNumbers);
  EXPECT_LT(ResidentBytes(), before + (16U << 20U));
  std::fill_n(numbers.begin() + kNumbers / 2, kNumbers / 2, 1.0);
  EXPECT_GT(ResidentBytes(), before + (48U << 20U));
  EXPECT_LT(ResidentBytes(), before + (80U << 20U));
  EXPECT_EQ(std::accumulate(numbers.begin(), numbers.end(), 0.0), kNumbers / 2);
}

TEST(ZeroedVector, WhatItHadBeforeIsGone)
{
  ZeroedVector<std::uint32_t> numbers(100, 7);
  numbers.clear();
  numbers.resize(100);
  for (const std::uint32_t number : numbers) EXPECT_EQ(number, 0U);
  numbers.resize(10, 3);
  numbers.resize(200, 5);
  EXPECT_EQ(std::accumulate(numbers.begin(), numbers.end(), 0U), 190U * 5);
}

TEST(ZeroedVector, KeepsItsNumbersWhenItGrowsShrinksAndIsCopied)
{
  ZeroedVector<std::uint32_t> numbers;
  for (std::uint32_t k = 0; k < 100; ++k) numbers.push_back(k % 3);
  const ZeroedVector<std::uint32_t> copy = numbers;
  numbers.resize(50);
  numbers.shrink_to_fit();
  EXPECT_EQ(numbers.capacity(), 50U);
  numbers.resize(100);
  for (std::uint32_t k = 0; k < 100; ++k)
  {
    EXPECT_EQ(copy[k], k % 3);
    EXPECT_EQ(numbers[k], k < 50 ? k % 3 : 0) << k;
  }
  numbers = copy;
  EXPECT_TRUE(std::equal(numbers.begin(), numbers.end(), copy.begin(), copy.end()));
}

TEST(ZeroedVector, KeepsTheBitsOfMinusZero)
{
  ZeroedVector<double> numbers;
  numbers.resize(2, -0.0);
  numbers.push_back(-0.0);
  for (const double number : numbers) EXPECT_TRUE(std::signbit(number));
}

TEST(SparseVector, ReadingTakesNoMemory)
{
  constexpr std::size_t kNumbers = 16U << 20U;  // 128 MiB
  const std::size_t before = ResidentBytes();
  SparseVector<double> numbers;
  numbers.resize(kNumbers);
  numbers.Set(kNumbers / 2, 3);
  for (std::size_t k = 0; k < kNumbers; k += 100) numbers.Set(k, 0);
  double sum = 0;
  for (std::size_t k = 0; k < kNumbers; ++k) sum += numbers[k];
  for (std::size_t k = 0; k + 100 <= kNumbers; k += 100)
  {
    const std::span<const double> part = numbers.Part(k, 100);
    sum = std::accumulate(part.begin(), part.end(), sum);
  }
  numbers.VisitRuns(kNumbers, [&](std::span<const double> run) { sum = std::accumulate(run.begin(), run.end(), sum); });
  EXPECT_EQ(sum, 9);
  EXPECT_LT(ResidentBytes(), before + (16U << 20U));
}

TEST(SparseVector, ShowsTheSameInEachWay)
{
  constexpr std::size_t kNumbers = 5000;
  SparseVector<double> numbers;
  std::vector<double> expected(kNumbers);
  numbers.resize(kNumbers - 1);
  numbers.push_back(expected.back() = 7);
  // At borders of pages, in some pages only, and a zero over what was written.
  for (const std::size_t place : {std::size_t{0}, std::size_t{511}, std::size_t{1024}, std::size_t{3001}})
    numbers.Set(place, expected[place] = static_cast<double>(place) + 0.5);
  numbers.Set(1024, expected[1024] = 0);
  numbers.Set(2048, expected[2048] = -0.0);
  EXPECT_TRUE(std::signbit(numbers[2048]));
  EXPECT_EQ(std::vector<double>(numbers.Values().begin(), numbers.Values().end()), expected);
  for (const std::size_t count : {kNumbers, std::size_t{4096}, std::size_t{513}, std::size_t{1}, std::size_t{0}})
  {
    std::vector<double> visited;
    numbers.VisitRuns(count,
                      [&](std::span<const double> run) { visited.insert(visited.end(), run.begin(), run.end()); });
    EXPECT_EQ(visited, std::vector<double>(expected.begin(), expected.begin() + static_cast<long>(count)));
  }
  for (std::size_t first = 0; first + 60 <= kNumbers; ++first)
  {
    const std::span<const double> part = numbers.Part(first, 60);
    ASSERT_TRUE(std::equal(part.begin(), part.end(), expected.begin() + static_cast<long>(first))) << first;
    ASSERT_EQ(numbers[first], expected[first]);
  }
}

// The slots of a kind may be this long.
TEST(SparseVector, APartMayBeLongerThanAPage)
{
  constexpr std::size_t kLong = 1000;
  SparseVector<double> numbers;
  numbers.resize(3000);
  const auto sum = [&]
  {
    const std::span<const double> part = numbers.Part(300, kLong);
    return std::accumulate(part.begin(), part.end(), 0.0);
  };
  EXPECT_EQ(sum(), 0);
  numbers.Set(600, 2);  // neither on the first page nor on the last one
  EXPECT_EQ(sum(), 2);
}

}  // namespace
}  // namespace swarmanoid
