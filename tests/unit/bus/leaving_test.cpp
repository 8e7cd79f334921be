// How a worker leaves the run: it stays until the server has answered its Leave, however long that takes, and the
// server never reports a process that has left as dead.
#include <fcntl.h>

#include <atomic>
#include <mutex>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/activity/exit_codes.h"
#include "common/bus/dds/for_tests.h"
#include "common/bus/membership/worker_session.h"
#include "tests/eventually.h"
#include "tests/unit/bus/server_fixture.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using test::Eventually;

class Leaving : public test::ServerFixture
{
protected:
  Leaving() : ServerFixture("leaving") {}

  // A worker that has nothing to do, in a thread of its own.
  std::jthread Worker(
      std::atomic<int>& exit_code, const std::function<void()>& work = [] {})
  {
    return std::jthread(
        [this, &exit_code, work]
        {
          WorkerSession session(options_, "leaving", "engine 'ground'");
          session.ReportReady();
          exit_code = session.Work(work);
        });
  }

  const test::SeparateProcesses separate_;
};

TEST_F(Leaving, TakesAsLongAsTheServerDoesToAnswer)
{
  Bus server(options_, "space server");
  std::mutex mutex;
  int heard = 0;
  std::string leaver;
  std::atomic<bool> gone = false;
  server.OnProcessGone([&](const std::string&, const std::string& name, bool) { gone = name == "engine 'ground'"; });
  Publisher<LeaveMessage> answers(server, "leaving");
  const Subscription<LeaveMessage> leaves(server, "leaving",
                                          [&](const LeaveMessage& leave)
                                          {
                                            const std::lock_guard lock(mutex);
                                            if (leave.name != "engine 'ground'") return;
                                            ++heard;
                                            leaver = leave.process;
                                            EXPECT_EQ(leave.run, world_.run);
                                            EXPECT_EQ(leave.error, "");
                                          });
  Publisher<WorldMessage> worlds(server, "leaving");
  worlds.Write(world_);
  std::atomic<int> exit_code = -1;
  const std::jthread worker = Worker(exit_code);
  // It says it again while nobody answers, and does not go. Neither do answers to others let it go.
  ASSERT_TRUE(Eventually(
      [&]
      {
        answers.Write({world_.run, 0, "space server", "another:1", ""});
        answers.Write({world_.run + 1, 0, "space server", ProcessId(), ""});
        const std::lock_guard lock(mutex);
        return heard >= 5 || gone;
      }));
  EXPECT_FALSE(gone);
  EXPECT_EQ(exit_code, -1);
  EXPECT_EQ(leaver, ProcessId());
  answers.Write({world_.run, 0, "space server", ProcessId(), ""});
  EXPECT_TRUE(Eventually([&] { return exit_code == kExitDone && gone; }));
}

TEST_F(Leaving, EndsWithTheServer)
{
  std::atomic<int> exit_code = -1;
  std::jthread worker;
  {
    Bus server(options_, "space server");
    std::atomic<bool> heard = false;
    const Subscription<LeaveMessage> leaves(server, "leaving", [&](const LeaveMessage&) { heard = true; });
    Publisher<WorldMessage> worlds(server, "leaving");
    worlds.Write(world_);
    worker = Worker(exit_code);
    ASSERT_TRUE(Eventually([&] { return heard.load(); }));
    EXPECT_EQ(exit_code, -1);
  }
  EXPECT_TRUE(Eventually([&] { return exit_code == kExitDone; }));
}

TEST_F(Leaving, IsReadBeforeTheProcessIsMissed)
{
  // The thread that reads messages is held up, longer than it ever was waited for; the one that hears of departures is
  // not.
  options_.lease_s = 100;
  std::atomic<int> exit_code = -1;
  std::atomic<bool> holds = false;
  ServerSession* opened = nullptr;
  ServerSession session(options_, world_, {"engine 'ground'"},
                        {[](const auto&) {},
                         [&]
                         {
                           if (!opened->Missing().empty() || holds.exchange(true)) return;
                           Eventually([&] { return opened->Failure().has_value(); }, 2s);
                         },
                         [](const auto&) {}});
  opened = &session;
  session.Open();
  // A process has one folder of a run; these are two.
  setenv("SWARMANOID_SHARED_FOLDER", of_worker_.c_str(), 1);
  const std::jthread worker = Worker(exit_code, [&] { EXPECT_TRUE(Eventually([&] { return holds.load(); })); });
  EXPECT_TRUE(Eventually([&] { return session.FirstLeft() || session.Failure(); }));
  EXPECT_EQ(session.TakeLeft(), std::vector<std::string>{"engine 'ground'"}) << session.Failure().value_or("");
  EXPECT_EQ(exit_code, -1);
  EXPECT_TRUE(Eventually(
      [&]
      {
        session.AnswerLeaves();
        return exit_code == kExitDone;
      }));
  EXPECT_EQ(session.Failure().value_or("none"), "none");
  EXPECT_EQ(session.FirstLeft(), "engine 'ground'");
}

// As a region that takes the place of one that was killed when its engine had done its work.
TEST_F(Leaving, IsToldToThoseWhoComeLater)
{
  const std::string late = "region 0 of engine 'ground'";
  ServerSession session(options_, world_, {"engine 'ground'", "controller host 0", late},
                        {[](const auto&) {}, [] {}, [](const auto&) {}});
  session.AwaitReplacements();
  session.Open();
  {
    Bus engine(options_, "engine 'ground'");
    Publisher<JoinMessage> join(engine, "leaving");
    join.Write({ProcessId(), kProtocolVersion, world_.run, "engine 'ground'", true});
    ASSERT_TRUE(Eventually([&] { return session.ProcessOf("engine 'ground'") == ProcessId(); }));
    Publisher<LeaveMessage> leave(engine, "leaving");
    leave.Write({world_.run, 9, "engine 'ground'", ProcessId(), ""});
    ASSERT_TRUE(Eventually([&] { return session.FirstLeft().has_value(); }));
  }
  setenv("SWARMANOID_SHARED_FOLDER", of_worker_.c_str(), 1);
  const WorkerSession worker(options_, "leaving", late, {}, 1);
  EXPECT_TRUE(Eventually(
      [&]
      {
        session.AnswerLeaves();
        return worker.HasLeft("engine 'ground'", 9);
      }));
  EXPECT_FALSE(worker.HasLeft("engine 'ground'", 10));
  EXPECT_FALSE(worker.HasLeft("controller host 0", 0));
}

// On another machine, after the connection by ssh has broken. An exception would take endpoints down that may wait for
// a dead process for ever.
TEST_F(Leaving, GivesUpInOrderIfNobodyReadsItsErrors)
{
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto give_up = [this]
  {
    Bus server(options_, "space server");
    Publisher<WorldMessage> worlds(server, "leaving");
    worlds.Write(world_);
    WorkerSession session(options_, "leaving", "engine 'ground'");
    const std::jthread answering(
        [&](const std::stop_token& stop)
        {
          Publisher<LeaveMessage> answers(server, "leaving");
          while (!stop.stop_requested())
          {
            answers.Write({world_.run, 0, "space server", ProcessId(), ""});
            std::this_thread::sleep_for(10ms);
          }
        });
    dup2(open("/dev/full", O_WRONLY), STDERR_FILENO);
    session.Fail(3, "out of paper");
    session.Work([&] { session.Wait(10ms, [] { return std::nullopt; }); });
  };
  EXPECT_EXIT(give_up(), testing::ExitedWithCode(kExitProcessFailed), "");
}

// It waits for a lock of a dead process, and nobody else is there who could tell of it.
TEST_F(Leaving, EndsIfTheMainThreadIsStuck)
{
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto stuck = [this]() noexcept
  {
    const Bus bus(options_, "engine 'ground'");
    std::rethrow_exception(std::make_exception_ptr(std::runtime_error("Interprocess lock")));
  };
  EXPECT_EXIT(stuck(), testing::ExitedWithCode(kExitStuck), "");
}

TEST_F(Leaving, WithoutAWordIsAFailure)
{
  ServerSession session(options_, world_, {"engine 'ground'"}, {[](const auto&) {}, [] {}, [](const auto&) {}});
  session.Open();
  {
    Bus engine(options_, "engine 'ground'");
    Publisher<JoinMessage> join(engine, "leaving");
    join.Write({ProcessId(), kProtocolVersion, world_.run, "engine 'ground'", true});
    ASSERT_TRUE(Eventually([&] { return session.Missing().empty(); }));
    // A Leave of another process with the same name is not its own.
    Publisher<LeaveMessage> leave(engine, "leaving");
    leave.Write({world_.run, 3, "engine 'ground'", "another:1", ""});
    leave.WaitUntilRead(20);
    EXPECT_THAT(session.NotLeft(), testing::ElementsAre("engine 'ground'"));
  }
  ASSERT_TRUE(Eventually([&] { return session.Failure().has_value(); }));
  EXPECT_EQ(*session.Failure(), fmt::format("engine 'ground' has left (process {})", ProcessId()));
}

}  // namespace
}  // namespace swarmanoid
