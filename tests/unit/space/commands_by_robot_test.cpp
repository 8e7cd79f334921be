// Tests that recorded commands and faults go to the controller hosts that step the robots now.
#include "common/journal/commands_by_robot.h"

#include <gmock/gmock.h>

#include "common/plugin_descriptions/describe_builtins.h"
#include "common/space/space.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::IsEmpty;

TEST(CommandsByRobot, AreDealtOutToTheHostsThatStepTheRobotsNow)
{
  DescribeBuiltins();
  const Experiment experiment = test::RobotsOf("", {"a", "b", "c", "d"}, {"dummy_footbot_wheels"});
  const CSwarmanoidSpace space(experiment);
  const HostTable before{2, {0, 1, 0, 1}}, now{2, {0, 0, 1, 1}};
  const Assignment assignment = MakeAssignment(experiment, now);
  std::vector<ControlCommands> sent(2);
  for (std::uint32_t host = 0; host < 2; ++host)
  {
    sent[host].tick = 7;
    sent[host].host = host;
    // Two wheels of each of its robots, whose numbers are host and host + 2.
    for (const double robot : {0., 2.})
      for (const double wheel : {0.1, 0.2}) sent[host].values.push_back(host + robot + wheel);
  }
  sent[0].faults.robots = {0, 2};
  sent[0].faults.kinds = {FaultKind::kThrew, FaultKind::kTooSlow};
  sent[1].faults.robots = {1};
  sent[1].faults.kinds = {FaultKind::kThrew};
  CommandsByRobot converted(space, assignment);
  const std::vector<ControlCommands> shared = converted.Of(before, sent);
  ASSERT_EQ(shared.size(), 2U);
  EXPECT_EQ(shared[1].tick, 7U);
  EXPECT_EQ(shared[1].host, 1U);
  EXPECT_THAT(shared[0].values, ElementsAre(0.1, 0.2, 1.1, 1.2));
  EXPECT_THAT(shared[1].values, ElementsAre(2.1, 2.2, 3.1, 3.2));
  EXPECT_THAT(shared[0].faults.robots, ElementsAre(0, 1));
  EXPECT_THAT(shared[0].faults.kinds, ElementsAre(FaultKind::kThrew, FaultKind::kThrew));
  EXPECT_THAT(shared[1].faults.robots, ElementsAre(2));
  EXPECT_THAT(shared[1].faults.kinds, ElementsAre(FaultKind::kTooSlow));
  EXPECT_THAT(converted.Of(before, std::vector<ControlCommands>()), IsEmpty()) << "the last tick has no commands";
}

}  // namespace
}  // namespace swarmanoid
