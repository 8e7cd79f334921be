// The limits of users' code go to the processes of a cluster by the environment.
#include "common/limits/limits.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace swarmanoid
{
namespace
{

struct LimitsByTheEnvironment : testing::Test
{
  ~LimitsByTheEnvironment() override
  {
    for (const auto& [name, value] : EnvironmentOf({1, 1})) unsetenv(name.c_str());
  }

  static Limits Passed(const Limits& limits)
  {
    for (const auto& [name, value] : EnvironmentOf(limits)) setenv(name.c_str(), value.c_str(), 1);
    return LimitsOfEnvironment();
  }
};

TEST_F(LimitsByTheEnvironment, ComeAsTheyWere)
{
  const Limits limits = Passed({(std::uint64_t{1} << 40U) + 1, 0.1});
  EXPECT_EQ(limits.memory_bytes, (std::uint64_t{1} << 40U) + 1);
  EXPECT_EQ(limits.step_s, 0.1);
}

TEST_F(LimitsByTheEnvironment, AreNoneWithoutAText)
{
  EXPECT_TRUE(EnvironmentOf({}).empty());
  const Limits limits = LimitsOfEnvironment();
  EXPECT_EQ(limits.memory_bytes, 0U);
  EXPECT_EQ(limits.step_s, 0);
}

TEST_F(LimitsByTheEnvironment, AreNoneByATextThatIsNoNumber)
{
  for (const auto& [name, value] : EnvironmentOf({1, 1}))
    for (const char* text : {"", "12 GiB", "much", "-1x"})
    {
      setenv(name.c_str(), text, 1);
      const Limits limits = LimitsOfEnvironment();
      EXPECT_EQ(limits.memory_bytes, 0U) << name << "=" << text;
      EXPECT_EQ(limits.step_s, 0) << name << "=" << text;
    }
}

}  // namespace
}  // namespace swarmanoid
