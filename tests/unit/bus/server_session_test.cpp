// ServerSession: the server's own thread reads while threads of the bus write. The preset tsan looks for data races.
#include <atomic>
#include <thread>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/eventually.h"
#include "tests/unit/bus/server_fixture.h"

namespace swarmanoid
{
namespace
{

using test::Eventually;

class ServerSessionTest : public test::ServerFixture
{
protected:
  ServerSessionTest() : ServerFixture("session") {}
};

// A text of one letter alone: torn, it would hold two.
std::string TextOf(std::uint64_t tick) { return std::string(20 + tick % 200, static_cast<char>('a' + tick % 26)); }

bool IsWhole(const std::string& text) { return text.find_first_not_of(text.front()) == std::string::npos; }

TEST_F(ServerSessionTest, IsReadWhileProcessesComeAndTellWhatTheyDo)
{
  constexpr std::uint64_t kCount = 2000;
  ServerSession session(options_, world_, {"engine 'ground'"}, {[](const auto&) {}, [] {}, [](const auto&) {}});
  session.Open();
  Bus crowd(options_, "the crowd");
  Publisher<JoinMessage> join(crowd, "session");
  Publisher<StatusMessage> status(crowd, "session");
  Publisher<ControlRequestMessage> requests(crowd, "session");
  join.Write({"first", kProtocolVersion, world_.run, "visualiser", true});
  ASSERT_TRUE(Eventually([&] { return session.Processes().size() == 2; }));
  const auto told = [&](std::uint64_t tick)
  {
    status.Write({world_.run, tick, "engine 'ground'", TextOf(tick)});
    return session.Status("engine 'ground'", tick) == TextOf(tick);
  };
  ASSERT_TRUE(Eventually([&] { return told(0); }));

  std::atomic<bool> done = false;
  std::atomic<int> torn = 0;
  std::vector<std::jthread> readers;
  for (int k = 0; k < 2; ++k)
    readers.emplace_back(
        [&]
        {
          std::size_t most = 0;
          while (!done)
          {
            const std::vector<ProcessStatus> processes = session.Processes();
            torn += processes.size() < most;
            most = processes.size();
            for (const ProcessStatus& process : processes)
              torn += process.name != "visualiser" && process.name != "engine 'ground'";
            for (std::uint64_t tick = 0; tick < kCount; tick += 7)
              if (const std::string text = session.Status("engine 'ground'", tick); !text.empty())
                torn += !IsWhole(text);
            torn += session.Missing().size() > 1 || session.Failure().has_value() || !session.NotLeft().empty();
          }
        });
  for (std::uint64_t k = 1; k < kCount; ++k)
  {
    join.Write({fmt::format("process {}", k), kProtocolVersion, world_.run, "visualiser", true});
    status.Write({world_.run, k, "engine 'ground'", TextOf(k)});
  }
  EXPECT_TRUE(Eventually([&] { return session.Processes().size() == 1 + kCount; })) << session.Processes().size();
  done = true;
  readers.clear();
  EXPECT_EQ(torn, 0);
}

// Another process replaces a lost one. When the old process comes back, it is told to end.
TEST_F(ServerSessionTest, AReplacementIsTakenAndItsPredecessorRefused)
{
  ServerSession session(options_, world_, {"engine 'ground'"}, {[](const auto&) {}, [] {}, [](const auto&) {}});
  session.AwaitReplacements();
  session.Open();
  Bus others(options_, "others");
  Publisher<JoinMessage> join(others, "session");
  Publisher<RecoveryRequestMessage> requests(others, "session");
  std::mutex mutex;
  std::vector<std::string> refused;
  const Subscription<LeaveMessage> leaves(others, "session",
                                          [&](const LeaveMessage& leave)
                                          {
                                            const std::lock_guard lock(mutex);
                                            if (!leave.error.empty()) refused.push_back(leave.process);
                                          });
  const auto process = [&] { return session.Processes().front().process; };
  join.Write({"old", kProtocolVersion, world_.run, "engine 'ground'", true, 0});
  ASSERT_TRUE(Eventually([&] { return process() == "old"; }));
  EXPECT_TRUE(session.TakeReplaced().empty());

  join.Write({"new", kProtocolVersion, world_.run, "engine 'ground'", false, 1});
  ASSERT_TRUE(Eventually([&] { return process() == "new"; }));
  EXPECT_THAT(session.Missing(), testing::ElementsAre("engine 'ground'"));
  EXPECT_TRUE(session.TakeReplaced().empty());
  join.Write({"new", kProtocolVersion, world_.run, "engine 'ground'", true, 1});
  ASSERT_TRUE(Eventually([&] { return !session.TakeReplaced().empty(); }));

  const auto told = [&]
  {
    join.Write({"old", kProtocolVersion, world_.run, "engine 'ground'", true, 0});
    const std::lock_guard lock(mutex);
    return !refused.empty();
  };
  ASSERT_TRUE(Eventually(told));
  EXPECT_EQ(refused.front(), "old");
  EXPECT_EQ(process(), "new");

  std::vector<RecoveryRequestMessage> asked;
  const auto ask = [&]
  {
    requests.Write({world_.run, "old", "engine 'ground'", 3});
    requests.Write({world_.run, "new", "engine 'ground'", 4});
    for (RecoveryRequestMessage& request : session.TakeRecoveryRequests()) asked.push_back(request);
    return !asked.empty();
  };
  ASSERT_TRUE(Eventually(ask));
  for (const RecoveryRequestMessage& request : asked) EXPECT_EQ(request.process, "new");
  EXPECT_FALSE(session.Failure());
}

// Users ask from threads of the bus, the server answers from its own: each request is passed on once, and all are
// answered.
TEST_F(ServerSessionTest, EachRequestIsPassedOnceAndAnsweredEachTime)
{
  std::mutex mutex;
  std::map<std::uint32_t, int> asked;
  ServerSession* opened = nullptr;
  ServerSession session(options_, world_, {},
                        {[&](const ControlRequestMessage& request)
                         {
                           {
                             const std::lock_guard lock(mutex);
                             ++asked[request.number];
                           }
                           opened->Reply(request, true, request.number, "done");
                         },
                         [] {}, [](const auto&) {}});
  opened = &session;
  session.Open();
  Bus user(options_, "a user");
  std::map<std::uint32_t, int> answers;
  const Subscription<ControlReplyMessage> replies(user, "session",
                                                  [&](const ControlReplyMessage& reply)
                                                  {
                                                    const std::lock_guard lock(mutex);
                                                    answers[reply.number] += reply.ok && reply.tick == reply.number;
                                                  });
  Publisher<ControlRequestMessage> requests(user, "session");
  const auto ask = [&](std::uint32_t number)
  {
    ControlRequestMessage request;
    request.run = world_.run;
    request.client = "user";
    request.number = number;
    request.verb = "pause";
    requests.Write(request);
  };
  const auto answers_to = [&](std::uint32_t number)
  {
    const std::lock_guard lock(mutex);
    return answers[number];
  };
  // It is answered again each time that it is repeated, and done once.
  for (std::uint32_t number = 1; number <= 20; ++number)
    for (int times = 1; times <= 3; ++times)
      ASSERT_TRUE(Eventually(
          [&]
          {
            ask(number);
            return answers_to(number) >= times;
          }));
  const std::lock_guard lock(mutex);
  for (const auto& [number, times] : asked) EXPECT_EQ(times, 1) << number;
  EXPECT_EQ(asked.size(), 20U);
}

}  // namespace
}  // namespace swarmanoid
