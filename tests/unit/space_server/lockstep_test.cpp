// The server tells a process that replaces another one about the tick that the run waits at.
#include "space_server/cluster/lockstep.h"

#include "space_server/space_server.h"
#include "tests/unit/bus/server_fixture.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

class LockstepTest : public test::ServerFixture
{
protected:
  LockstepTest()
      : ServerFixture("lockstep"), session_(options_, world_, {}, {[](const auto&) {}, [] {}, [](const auto&) {}})
  {
  }

  // Returns whether the replacement of a process computes the present tick before it joins. The server hears host 1
  // alone.
  bool ComputesPresentTick(const std::string& name, unsigned ahead, bool sent)
  {
    Experiment experiment = test::RobotsOf("", {"a", "b"});
    experiment.ahead = ahead;
    experiment.max_clock = 10;
    Assignment assignment = MakeAssignment(experiment, 2);
    assignment.hosts[0].reports_to_server = false;
    assignment.hosts[1].reports_to_server = true;
    SpaceServer server(experiment, assignment, ".");
    CheckpointWriter checkpoints(session_, experiment, {}, 0, {}, folder_, nullptr, [] {});
    Lockstep lockstep(session_, server, assignment, false, "", {}, checkpoints, nullptr, nullptr, [] {});
    if (sent) lockstep.Go(0);
    EXPECT_EQ(lockstep.Held(), !sent);
    return lockstep.Withdraw(name, 1).is_done;
  }

  ServerSession session_;
};

TEST_F(LockstepTest, AHostWhoseAnswerIsUsedWithoutTheServerComputesThePresentTick)
{
  EXPECT_TRUE(ComputesPresentTick("controller host 0", 0, true));
  EXPECT_FALSE(ComputesPresentTick("controller host 1", 0, true));
  EXPECT_FALSE(ComputesPresentTick("controller host 0", 0, false)) << "nobody has answered";
}

// The engine can go two ticks on with commands that the dead host sent a tick early. Its second frame would be too
// early for a host that begins with the present tick.
TEST_F(LockstepTest, AnyHostDoesIfCommandsActATickLater)
{
  EXPECT_TRUE(ComputesPresentTick("controller host 0", 1, true));
  EXPECT_TRUE(ComputesPresentTick("controller host 1", 1, true));
  EXPECT_FALSE(ComputesPresentTick("engine ''", 1, true));
  EXPECT_FALSE(ComputesPresentTick("controller host 1", 1, false)) << "nobody has answered";
}

}  // namespace
}  // namespace swarmanoid
