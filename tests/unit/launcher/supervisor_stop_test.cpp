// How the supervisor stops a cluster, and what it shows meanwhile.
#include "launcher/supervision/supervisor.h"

#include "tests/unit/launcher/supervisor_fixture.h"

namespace swarmanoid
{
namespace
{

TEST_F(SupervisorTest, WhatIsOnTheScreenAlreadyIsNotShownAgain)
{
  retries_ = 1;
  AddServer("echo state running; " + Await("second") + kFinishing);
  Add("visualiser", "echo one; echo two; printf half; sleep 0.2; kill -9 $$");
  ReplaceBy("echo one; echo two; echo half and half; " + Tell("second"));
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
  EXPECT_EQ(ScreenText(), "one\ntwo\nhalf and half\n");
}

TEST_F(SupervisorTest, StopsProcessesThatIgnoreSigterm)
{
  times_.settle = milliseconds(60);
  AddServer(Running());
  Add("engine_worker ground", Await("deaf") + "exit 1");
  Add("controller_host 0", "trap '' TERM; " + Tell("deaf") + "while true; do sleep 1; done");
  EXPECT_EQ(Run().kind, ClusterOutcome::kFailed);
}

TEST_F(SupervisorTest, StopsProcessesThatAreStopped)
{
  times_.settle = milliseconds(60);
  AddServer(Running());
  Add("engine_worker ground", Await("stopping") + "exit 1");
  Add("controller_host 0", Tell("stopping") + "kill -STOP $$");
  EXPECT_EQ(Run().kind, ClusterOutcome::kFailed);
}

TEST_F(SupervisorTest, OneInterruptStopsAtATickAndKeepsTheResult)
{
  AddServer(Stoppable());
  Add("engine_worker ground", "sleep 0.5");
  const std::jthread press = PressAt({{"running", SIGINT}});
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kInterrupted);
  ASSERT_TRUE(outcome.finished);
  EXPECT_EQ(outcome.finished->ticks, 8U);
}

// Both the kernel and a shell report a closed terminal.
TEST_F(SupervisorTest, ALostTerminalStopsAtATickAndKeepsTheResult)
{
  AddServer(Stoppable());
  Add("engine_worker ground", "sleep 0.5");
  const std::jthread press = PressAt({{"running", SIGHUP}, {"running", SIGHUP}});
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kInterrupted);
  EXPECT_TRUE(outcome.finished);
}

TEST_F(SupervisorTest, TwoInterruptsKill)
{
  // The second one comes once the first was passed on: two signals that are pending at once are one.
  AddServer("trap '" + Tell("asked") + "' INT; echo state running; " + Tell("running") +
            "while true; do sleep 0.05; done");
  Add("controller_host 0", "trap '' TERM; while true; do sleep 1; done");
  const std::jthread press = PressAt({{"running", SIGINT}, {"asked", SIGINT}});
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kInterrupted);
  EXPECT_FALSE(outcome.finished);
}

TEST_F(SupervisorTest, SigtermEndsEvenAStuckRun)
{
  times_.forced_stop = milliseconds(200);
  AddServer("trap '' INT TERM; echo state running; " + Tell("running") + "while true; do sleep 1; done");
  const std::jthread press = PressAt({{"running", SIGTERM}});
  EXPECT_EQ(Run().kind, ClusterOutcome::kInterrupted);
}

TEST_F(SupervisorTest, ShowsWhatVisualisersWriteToTheScreen)
{
  AddServer(std::string("echo a line for the log; ") + kFinishing + "; " + Tell("finished"));
  // It ends after the server, as visualisers do; one that ends before is a failure.
  Add("visualiser", "echo one; echo two; echo aside >&2; " + Await("finished") + AwaitEndOfServer());
  EXPECT_EQ(Run().kind, ClusterOutcome::kFinished);
  EXPECT_EQ(ScreenText(), "one\ntwo\n");
  EXPECT_EQ(LogText("visualiser"), "aside\n");
  EXPECT_EQ(LogText("space_server"), "a line for the log\n");
}

TEST_F(SupervisorTest, AFullScreenDoesNotDeafenIt)
{
  AddServer("trap '" + Tell("asked") + "' INT; echo state running; " + Await("writing") + Tell("running") +
            "while true; do sleep 0.05; done");
  Add("visualiser", "trap 'exit 0' TERM; " + Tell("writing") + "yes");
  const std::jthread press = PressAt({{"running", SIGINT}, {"asked", SIGINT}});
  EXPECT_EQ(Run().kind, ClusterOutcome::kInterrupted);
}

TEST_F(SupervisorTest, StopsWhenNobodyReadsTheScreen)
{
  AddServer(Stoppable());
  Add("visualiser", Await("running") + "for i in 1 2 3; do echo line; sleep 0.05; done");
  screen_read_.Reset();
  const ClusterOutcome outcome = Run();
  EXPECT_EQ(outcome.kind, ClusterOutcome::kInterrupted);
  EXPECT_TRUE(outcome.finished);
}

}  // namespace
}  // namespace swarmanoid
