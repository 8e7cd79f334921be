// Tests the supervisor's verdict about a cluster: how it ended, and which process failed first.
#include "launcher/supervision/supervisor.h"

#include "tests/unit/launcher/supervisor_fixture.h"

namespace swarmanoid
{
namespace
{

TEST_F(SupervisorTest, ReportsTheServersLastWordWhenAllEndCleanly)
{
  AddServer(kFinishing);
  Add("engine_worker ground", "sleep 0.05");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFinished) << outcome.reason;
  ASSERT_TRUE(outcome.finished);
  EXPECT_EQ(outcome.finished->ticks, 5U);
  EXPECT_EQ(outcome.finished->hash, 0xffU);
}

TEST_F(SupervisorTest, NamesTheKilledProcessItsTickAndItsLog)
{
  AddServer(Running());
  Add("engine_worker ground", Await("running") + "echo about to die >&2; kill -9 $$");
  Add("controller_host 0", "exec sleep 600");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_EQ(outcome.reason, "engine_worker ground was killed by signal 9 (Killed) at tick 7; its log is " +
                                (folder_ / "engine_worker ground.log").string());
  EXPECT_EQ(outcome.log_lines, std::vector<std::string>{"about to die"});
}

TEST_F(SupervisorTest, AServerThatEndsWithoutAResultFailed)
{
  times_.settle = milliseconds(60);
  AddServer("echo state running; echo error the arena is empty");
  Add("engine_worker ground", "exec sleep 600");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(
      outcome.reason.starts_with("space_server ended before the last tick at tick 0 (the arena is empty); its log is "))
      << outcome.reason;
}

TEST_F(SupervisorTest, AWorkerThatEndsEarlyFailed)
{
  times_.early_end = milliseconds(200);
  AddServer(Running());
  Add("engine_worker ground", Await("running") + "exit 0");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(outcome.reason.starts_with("engine_worker ground ended before the last tick at tick 7"))
      << outcome.reason;
}

TEST_F(SupervisorTest, AResultThatComesAfterAProcessWasKilledIsNone)
{
  AddServer(std::string("trap 'echo finished 7 2 00000000000000ff 0.2 2.5; exit 0' TERM; echo state running; ") +
            Tell("running") + "while true; do sleep 0.01; done");
  Add("visualiser", Await("running") + "kill -KILL $$");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(outcome.reason.starts_with("visualiser was killed by signal 9")) << outcome.reason;
  EXPECT_FALSE(outcome.finished.has_value());
}

TEST_F(SupervisorTest, AWorkerMayEndLongBeforeTheServersLastWordOnceItHasLeft)
{
  AddServer("echo state running; echo left engine_worker ground; " + Tell("left") + Await("ended") + LetAnHourPass() +
            kFinishing);
  Add("engine_worker ground", Await("left") + Tell("ended") + "exit 0");
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
}

TEST_F(SupervisorTest, TheWordThatAWorkerHasLeftMayComeAfterItsEnd)
{
  // The process may be on another machine.
  AddServer("echo state running; " + Await("ended") + "echo left engine_worker ground; " + kFinishing);
  Add("engine_worker ground", Tell("ended") + "exit 0");
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
}

TEST_F(SupervisorTest, BlamesTheOneThatTheServerAccuses)
{
  AddServer("echo state running; echo \"error engine 'ground': division by zero\"; " + Tell("accused") + "exit 4");
  Add("controller host 0", Await("accused") + Tell("host ends") + "exit 4");
  Add("engine 'ground'", Await("host ends") + "sleep 0.05; echo division by zero; exit 4");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(outcome.reason.starts_with(
      "engine 'ground' ended with exit code 4 at tick 0 (engine 'ground': division by zero)"))
      << outcome.reason;
}

TEST_F(SupervisorTest, ThoseThatEndForAnotherAreNotItsHeadline)
{
  AddServer("echo state running; " + Await("engine ends") + "echo \"error controller host 0 failed\"; " +
            Tell("accused") + "exit 6");
  Add("engine 'ground'", Tell("engine ends") + "exit 6");
  Add("controller host 0", Await("accused") + "sleep 0.05; exit 4");
  const ClusterOutcome outcome = Run();
  EXPECT_TRUE(outcome.reason.starts_with("controller host 0 ended with exit code 4")) << outcome.reason;
}

TEST_F(SupervisorTest, IfNobodyFailedTheServerSaysWhy)
{
  AddServer("echo state running; " + Await("engine ends") +
            "echo \"error engine 'far' does not answer any more\"; exit 6");
  Add("engine 'ground'", Tell("engine ends") + "exit 6");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(outcome.reason.starts_with("engine 'far' does not answer any more; the log of space_server is "))
      << outcome.reason;
}

TEST_F(SupervisorTest, AWorkerMayEndJustBeforeTheServersLastWord)
{
  AddServer(Await("worker ends") + kFinishing);
  Add("engine_worker ground", Tell("worker ends") + "exit 0");
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
}

TEST_F(SupervisorTest, AnInvalidExperimentIsToldApart)
{
  times_.settle = milliseconds(60);
  AddServer(Running());
  Add("engine_worker ground", "echo 'x.xml:3:4: no such thing' >&2; exit 3");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kInvalid);
  EXPECT_EQ(outcome.log_lines, std::vector<std::string>{"x.xml:3:4: no such thing"});
}

TEST_F(SupervisorTest, AnExperimentMayFailByItsOwnMeasure)
{
  AddServer(std::string(kFinishing) + "; exit 1");
  Add("engine_worker ground", "sleep 0.1");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kUnsuccessful) << outcome.reason;
  EXPECT_TRUE(outcome.finished);
}

TEST_F(SupervisorTest, AKilledVisualiserSpoilsAFinishedRun)
{
  AddServer(kFinishing);
  Add("visualiser", "sleep 0.1; kill -9 $$");
  EXPECT_EQ(Run().kind, ClusterOutcome::kFailed);
}

TEST_F(SupervisorTest, WaitsLongerForVisualisersThanForWorkers)
{
  times_.finish_visualiser = std::chrono::hours(2);
  AddServer(std::string(kFinishing) + "; " + Tell("finished"));
  Add("visualiser", Await("finished") + AwaitEndOfServer() + LetAnHourPass());
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
}

TEST_F(SupervisorTest, AWorkerThatNeverEndsFailed)
{
  AddServer(std::string(kFinishing) + "; " + Tell("finished"));
  Add("engine_worker ground", Await("finished") + AwaitEndOfServer() + LetAnHourPass() + "exec sleep 600");
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_TRUE(outcome.reason.starts_with("engine_worker ground did not end within 1 min 40 s of the last tick"))
      << outcome.reason;
}

TEST_F(SupervisorTest, AMissingProgramIsNamedAndNothingIsLeft)
{
  AddServer(Running());
  Add("engine_worker ground", "");
  program_ = "/nowhere/engine_worker";
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kFailed);
  EXPECT_EQ(outcome.reason, "cannot start engine_worker ground: '/nowhere/engine_worker': No such file or directory");
}

}  // namespace
}  // namespace swarmanoid
