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

TEST(ZeroedVector, TakesMemoryForWhatIsWrittenAlone)
{
  constexpr std::size_t kNumbers = 16U << 20U;  // 128 MiB
  const std::size_t before = ResidentBytes();
  ZeroedVector<double> numbers;
  numbers.resize(kNumbers);
  EXPECT_EQ(std::accumulate(numbers.begin(), numbers.end(), 0.0), 0);
  EXPECT_LT(ResidentBytes(), before + (16U << 20U)) << "reading takes none";
  std::fill_n(numbers.begin() + kNumbers / 2, kNumbers / 2, 1.0);
  EXPECT_GT(ResidentBytes(), before + (48U << 20U));
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

TEST(ZeroedVector, KeepsTheBitsOfMinusZero)
{
  ZeroedVector<double> numbers;
  numbers.resize(2, -0.0);
  numbers.push_back(-0.0);
  for (const double number : numbers) EXPECT_TRUE(std::signbit(number));
}

}  // namespace
}  // namespace swarmanoid
