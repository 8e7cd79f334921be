// How a worker leaves the run over a real bus: the server never reports a process that has left as dead.
// WorkerMembership and the simulated cluster have what a worker says until it is answered.
#include <fcntl.h>

#include <atomic>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "common/bus/dds/for_tests.h"
#include "common/bus/membership/worker_session.h"
#include "common/errors/exit_codes.h"
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

  // A worker without work, in a thread of its own.
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

TEST_F(Leaving, IsReadBeforeTheProcessIsMissed)
{
  // The thread that reads messages is blocked for longer than any wait lasts. The thread that hears of departures is
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

// A region may replace one that was killed after its engine had done its work.
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

// It waits for a lock of a dead process, and no other process could report that.
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
