// Processes that die and are replaced, and clusters that start again.
#include "launcher/supervision/supervisor.h"

#include "tests/unit/launcher/supervisor_fixture.h"

namespace swarmanoid
{
namespace
{

TEST_F(SupervisorTest, AnotherProcessTakesThePlaceOfOneThatWasKilled)
{
  retries_ = 1;
  AddServer("echo state running; echo tick 7 100 2.5; " + Tell("running") + Await("second") + kFinishing);
  Add("engine_worker ground", Await("running") + "echo the first; kill -9 $$");
  ReplaceBy("echo incarnation $1; " + Tell("second"));
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFinished) << outcome.reason;
  EXPECT_EQ(LogText("engine_worker ground"), "the first\nincarnation 1\n");
}

TEST_F(SupervisorTest, OneThatDiesAgainAndAgainWithoutATickBetweenEndsTheRun)
{
  retries_ = 3;
  AddServer(Running());
  Add("engine_worker ground", Await("running") + "sleep 0.1; kill -9 $$");
  ReplaceBy("echo incarnation $1; kill -9 $$");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(outcome.reason.starts_with("engine_worker ground was killed by signal 9 (Killed) at tick 7; its log is "))
      << outcome.reason;
  EXPECT_EQ(LogText("engine_worker ground"), "incarnation 1\nincarnation 2\nincarnation 3\n");
}

TEST_F(SupervisorTest, AllStartAgainIfTheServerWasKilled)
{
  retries_ = 1;
  AddServer("echo state running; echo tick 7 100 2.5; " + Await("running") + "kill -9 $$");
  ReplaceBy("echo incarnation $1 >&2; " + std::string(kFinishing));
  Add("engine_worker ground", "echo the first; " + Tell("running") + "exec sleep 600");
  ReplaceBy("echo incarnation $1");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFinished) << outcome.reason;
  EXPECT_EQ(outcome.finished->hash, 0xffU);
  EXPECT_EQ(LogText("space_server"), "incarnation 1\n");
  EXPECT_EQ(LogText("engine_worker ground"), "the first\nincarnation 1\n");
}

TEST_F(SupervisorTest, AllStartAgainIfTheServerWasKilledOnItsWayOut)
{
  retries_ = 1;
  AddServer(std::string(kFinishing) + "; kill -9 $$");
  ReplaceBy(std::string(kFinishing) + "; exit 1");
  Add("engine_worker ground", "exit 0");
  ReplaceBy("exit 0");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kUnsuccessful) << outcome.reason;
  EXPECT_TRUE(outcome.finished);
}

TEST_F(SupervisorTest, AllStartAgainIfOneIsStuckWithWhatADeadOneHeld)
{
  retries_ = 1;
  AddServer("echo state running; echo error held by the dead; exit 7");
  ReplaceBy(kFinishing);
  Add("engine_worker ground", "exec sleep 600");
  ReplaceBy("exit 0");
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
}

TEST_F(SupervisorTest, AllStartAgainIfTheServerIsStopped)
{
  retries_ = 1;
  times_.stopped = milliseconds(60);
  AddServer("echo state running; kill -STOP $$; " + Tell("came back"));
  ReplaceBy(kFinishing);
  Add("engine_worker ground", "exec sleep 600");
  ReplaceBy("exit 0");
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
  EXPECT_FALSE(IsTold("came back"));
}

// Ticks that were done already come again: they are no progress.
TEST_F(SupervisorTest, AServerThatDiesAgainAndAgainEndsTheRun)
{
  retries_ = 2;
  AddServer("echo state running; echo tick 7 100 2.5; sleep 0.1; kill -9 $$");
  ReplaceBy(
      "echo incarnation $1 >&2; echo state running; echo tick 3 100 2.5; echo tick 7 100 2.5; sleep 0.1; kill -9 $$");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(outcome.reason.starts_with("space_server was killed by signal 9 (Killed) at tick 7; its log is "))
      << outcome.reason;
  EXPECT_EQ(LogText("space_server"), "incarnation 1\nincarnation 2\n");
}

TEST_F(SupervisorTest, ControlCWhileAllStartAgainEndsTheRun)
{
  retries_ = 1;
  AddServer("echo state running; " + Tell("running") + "sleep 0.1; kill -9 $$");
  ReplaceBy(Tell("again") + "exec sleep 600");
  Add("engine_worker ground", "exec sleep 600");
  ReplaceBy("exec sleep 600");
  const std::jthread presses = PressAt({{"again", SIGINT}, {"again", SIGINT}});
  EXPECT_EQ(Run().kind, ClusterOutcome::kInterrupted);
}

TEST_F(SupervisorTest, OneThatIsLostIsKilledAndReplaced)
{
  retries_ = 1;
  AddServer("echo state running; " + Await("stopped") + "echo lost engine_worker ground; " + Await("second") +
            kFinishing);
  Add("engine_worker ground", Tell("stopped") + "kill -STOP $$; " + Tell("came back"));
  ReplaceBy(Tell("second"));
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
  EXPECT_FALSE(IsTold("came back"));
}

// The server was stopped while the worker said its good-bye, so the worker took it for dead, and it the worker.
TEST_F(SupervisorTest, OneThatIsLostAfterItsEndIsReplaced)
{
  retries_ = 1;
  AddServer("echo state running; " + Await("ended") + "sleep 0.1; echo lost engine_worker ground; " + Await("second") +
            kFinishing);
  Add("engine_worker ground", Tell("ended") + "exit 0");
  ReplaceBy(Tell("second"));
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
}

TEST_F(SupervisorTest, OneThatIsStoppedBeforeAnybodyKnowsItIsKilledAndReplaced)
{
  retries_ = 1;
  times_.stopped = milliseconds(60);
  AddServer("echo state running; " + Await("second") + kFinishing);
  Add("engine_worker ground", "kill -STOP $$; " + Tell("came back"));
  ReplaceBy(Tell("second"));
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
  EXPECT_FALSE(IsTold("came back"));
}

TEST_F(SupervisorTest, OneThatSaysWhatIsWrongIsNotReplaced)
{
  retries_ = 3;
  times_.settle = milliseconds(60);
  AddServer(Running());
  Add("engine_worker ground", Await("running") + "exit 4");
  ReplaceBy(Tell("second"));
  EXPECT_EQ(Run().kind, ClusterOutcome::kFailed);
  EXPECT_FALSE(IsTold("second"));
}

// The server waits for all to leave.
TEST_F(SupervisorTest, OneThatDiesWhileTheRunStopsIsReplaced)
{
  retries_ = 1;
  AddServer("trap '" + Tell("asked") + "' INT; echo state running; " + Tell("running") + Await("second") +
            "echo finished 8 2 00000000000000aa 0.3 1.5");
  Add("controller_host 0", Await("asked") + "kill -ABRT $$");
  ReplaceBy(Tell("second"));
  const std::jthread press = PressAt({{"running", SIGINT}});
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kInterrupted) << outcome.reason;
  ASSERT_TRUE(outcome.finished);
}

TEST_F(SupervisorTest, OneThatDiesWhileTheRunStopsAndIsNotReplacedIsNamed)
{
  AddServer("trap '" + Tell("asked") + "' INT; echo state running; " + Tell("running") +
            "while true; do sleep 0.05; done");
  Add("controller_host 0", Await("asked") + "kill -ABRT $$");
  const std::jthread press = PressAt({{"running", SIGINT}});
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(outcome.reason.starts_with("controller_host 0 was killed by signal 6")) << outcome.reason;
}

TEST_F(SupervisorTest, StartsAllAgainWithAsManyControllerHostsAsAUserAsksFor)
{
  retries_ = 3;
  AddServer("echo state running; echo hosts beta here; exec sleep 600");
  ReplaceBy(Await("second host of incarnation 1") + kFinishing);
  Add("controller host 0", "exec sleep 600");
  ReplaceBy("exit 0");
  plan_.processes.back().machine = "alpha";
  plan_.settings.output_folder = folder_.Path();
  scripts_["controller host 1"].second = "touch '" + (folder_ / "second host of incarnation ").string() + "'$1";
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFinished) << outcome.reason;
  ASSERT_EQ(last_plan_.processes.size(), 3U);
  EXPECT_EQ(last_plan_.processes[1].machine, "beta");
  EXPECT_EQ(last_plan_.processes[2].machine, "here");
  // The logs of controller host 0 before and after have different names here, but not in a plan that MakePlan made.
  EXPECT_EQ(outcome.processes.size(), 4U);
}

TEST_F(SupervisorTest, AWorkerIsMovedToTheMachineThatAUserNames)
{
  AddServer("echo state running; echo move beta engine_worker ground; " + Await("moved") + kFinishing);
  Add("engine_worker ground", "exec sleep 600");
  ReplaceBy(Tell("moved"));
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
  EXPECT_EQ(last_plan_.processes[1].machine, "beta");
}

TEST_F(SupervisorTest, OneThatIsKilledOnceItHasLeftChangesNothing)
{
  retries_ = 1;
  AddServer("echo state running; echo left engine_worker ground; " + Tell("left") + Await("killed") + kFinishing);
  Add("engine_worker ground", Await("left") + "sleep 0.1; " + Tell("killed") + "kill -9 $$");
  ReplaceBy(Tell("replaced"));
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFinished) << outcome.reason;
  EXPECT_FALSE(IsTold("replaced"));
}

// The word that it has left was on its way: the other one finds no place any more.
TEST_F(SupervisorTest, OneThatIsReplacedAfterItHasLeftChangesNothing)
{
  retries_ = 1;
  AddServer("echo state running; " + Await("replaced") + "echo left engine_worker ground; " + Tell("left") +
            Await("refused") + kFinishing);
  Add("engine_worker ground", "kill -9 $$");
  ReplaceBy(Tell("replaced") + Await("left") + "sleep 0.1; " + Tell("refused") + "exit 4");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFinished) << outcome.reason;
}

}  // namespace
}  // namespace swarmanoid
