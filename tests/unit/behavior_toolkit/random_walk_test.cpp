// A random walk that is saved and loaded continues on the same way.
#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include "common/control_interface/ci_robot.h"
#include "footbot/bt_footbot_random_walk.h"
#include "tests/world/fake_devices.h"

namespace swarmanoid
{
namespace
{

using Wheels = std::array<double, 2>;

class RandomWalk : public testing::Test
{
protected:
  RandomWalk() { robot_.AddActuator("footbot_wheels", &wheels_); }

  // Returns the wheel commands at each of some ticks.
  std::vector<Wheels> Walk(CBTFootbotRandomWalk& walk, std::uint64_t from, std::uint64_t to)
  {
    std::vector<Wheels> told;
    for (std::uint64_t tick = from; tick < to; ++tick)
    {
      robot_.BeginStep(tick, 0.1, RandomStream(1, 2, 3, tick));
      CCI_FootBotState state(&robot_);
      state.Init();
      walk.Step(state);
      state.WriteActuators();
      told.push_back(wheels_.Speeds());
    }
    return told;
  }

  CCI_Robot robot_{"fb", "footbot"};
  test::FakeWheels wheels_;
};

TEST_F(RandomWalk, GoesOnAsBeforeFromEachTickThatItIsSavedAt)
{
  constexpr std::uint64_t kTicks = 200;
  CBTFootbotRandomWalk whole;
  const std::vector<Wheels> expected = Walk(whole, 0, kTicks);
  std::size_t turns = 0;
  for (const Wheels& told : expected) turns += told[0] != told[1] ? 1 : 0;
  ASSERT_GT(turns, 10U);
  ASSERT_LT(turns, kTicks - 10);

  for (std::uint64_t saved_at = 1; saved_at < 60; ++saved_at)
  {
    CBTFootbotRandomWalk first;
    Walk(first, 0, saved_at);
    std::stringstream state;
    first.SaveState(state);
    CBTFootbotRandomWalk restored;
    restored.LoadState(state);
    const std::vector<Wheels> rest(expected.begin() + static_cast<std::ptrdiff_t>(saved_at), expected.end());
    EXPECT_EQ(Walk(restored, saved_at, kTicks), rest) << saved_at;
  }
}

}  // namespace
}  // namespace swarmanoid
