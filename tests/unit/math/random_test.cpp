#include "common/math/random.h"

#include <cmath>
#include <set>

namespace swarmanoid
{
namespace
{

using Block = std::array<std::uint32_t, 4>;

// The known answers that the authors of Philox publish with it.
TEST(Random, PhiloxGivesItsKnownAnswers)
{
  EXPECT_EQ(Philox4x32({0, 0, 0, 0}, {0, 0}), (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(Philox4x32({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
            (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(Philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Random, EveryPartOfTheNameMakesAnotherStream)
{
  std::set<std::uint32_t> firsts;
  for (const auto& [seed, entity, device, tick] :
       {std::array<std::uint32_t, 4>{1, 2, 3, 4}, {2, 2, 3, 4}, {1, 3, 3, 4}, {1, 2, 4, 4}, {1, 2, 3, 5}})
  {
    firsts.insert(RandomStream(seed, entity, device, tick).Bits());
  }
  EXPECT_EQ(firsts.size(), 5u);
  EXPECT_NE(RandomStream(1, 0, 0, 0).Bits(), RandomStream(1 + (std::uint64_t{1} << 32), 0, 0, 0).Bits());
}

TEST(Random, AStreamStartsAgainWhenItIsMadeAgain)
{
  RandomStream first(7, 8, 9, 10);
  RandomStream second(7, 8, 9, 10);
  for (int k = 0; k < 100; ++k) EXPECT_EQ(first.Uniform(), second.Uniform());
}

TEST(Random, MomentsAreThoseOfTheDistribution)
{
  constexpr int kCount = 200000;
  RandomStream stream(42, 0, StreamName("moments"), 0);
  double sum = 0;
  double normal_sum = 0;
  double normal_squares = 0;
  std::array<int, 7> counts{};
  for (int k = 0; k < kCount; ++k)
  {
    const double uniform = stream.Uniform();
    ASSERT_GE(uniform, 0);
    ASSERT_LT(uniform, 1);
    sum += uniform;
    const double normal = stream.Gaussian(3, 2);
    normal_sum += normal;
    normal_squares += (normal - 3) * (normal - 3);
    ++counts[stream.Below(7)];
  }
  // Five standard errors each.
  EXPECT_NEAR(sum / kCount, 0.5, 5 * std::sqrt(1.0 / 12 / kCount));
  EXPECT_NEAR(normal_sum / kCount, 3, 5 * 2 / std::sqrt(kCount));
  EXPECT_NEAR(normal_squares / kCount, 4, 5 * 4 * std::sqrt(2.0 / kCount));
  for (const int count : counts) EXPECT_NEAR(count, kCount / 7.0, 5 * std::sqrt(kCount * 6.0 / 49));
}

}  // namespace
}  // namespace swarmanoid
