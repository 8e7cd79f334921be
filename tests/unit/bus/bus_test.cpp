// Two participants, one in a child process: what is written arrives, in every combination of network and data sharing.
#include "common/bus/bus.h"

#include <arpa/inet.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <list>
#include <sstream>
#include <thread>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "common/bus/dds/fast_dds.h"
#include "common/logging/log.h"
#include "common/run/access/free_domain.h"
#include "common/run/access/run_directory.h"
#include "idl/messages.h"
#include "tests/eventually.h"
#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using test::Eventually;

constexpr std::uint64_t kRounds = 200;

// All processes of the tests hold one key.
BusOptions Options()
{
  BusOptions options;
  options.key.emplace().fill(7);
  return options;
}

// Answers each state with an update whose poses are those of the state plus one, in a child process.
int Echo(const BusOptions& options, bool share)
{
  Bus bus(options, "echo");
  std::optional<RunDirectory> directory;
  if (share) directory.emplace("echo_test", 5);
  const HotScope scope{"echo_test", share ? directory->Path() : "", options.Spread(), 100000, 1};
  HotPublisher<EngineUpdate> updates(bus, scope);
  std::atomic<bool> last = false;
  SpaceState state;
  EngineUpdate update;
  HotSubscription<SpaceState> states(bus, scope,
                                     {[&](const MessageHeader&) { return &state; },
                                      [&](const MessageHeader& header, SpaceState& message)
                                      {
                                        update.poses = message.poses;
                                        for (double& value : update.poses) value += 1;
                                        updates.Write({header.run, header.tick + 1, 3, false}, update);
                                        if (message.last) last = true;
                                      }});
  // The asking process leaves when it has read the last answer.
  const bool done = Eventually([&] { return last.load() && updates.Readers() == 0; });
  return done ? 0 : 1;
}

// Threads of DDS do not survive a fork. So the other process is this program again, and a variable tells it what to do.
constexpr const char* kChildVariable = "SWARMANOID_BUS_TEST_CHILD";

int Victim(const BusOptions& options)
{
  Bus bus(options, "engine 'ground'");
  Publisher<StatusMessage> out(bus, "x");
  for (int k = 0; k < 6000; ++k)
  {
    out.Write({});
    std::this_thread::sleep_for(100ms);
  }
  return 0;
}

struct Child
{
  Child()
  {
    const char* command = std::getenv(kChildVariable);
    if (command == nullptr) return;
    std::istringstream words(command);
    std::string role;
    BusOptions options = Options();
    std::string peer;
    bool share = false;
    std::string deaf;
    words >> role >> options.domain >> options.network_interface >> peer >> options.discovery_server >>
        std::boolalpha >> share >> deaf;
    options.hears_announcements = deaf.empty();
    if (peer != "-") options.peers = {peer};
    if (options.discovery_server == "-") options.discovery_server.clear();
    int code = 2;
    try
    {
      code = role == "echo" ? Echo(options, share) : Victim(options);
    }
    catch (const std::exception& error)
    {
      fmt::print(stderr, "{}: {}\n", role, error.what());
    }
    std::fflush(nullptr);
    _exit(code);
  }
};
const Child child_of_a_test;

pid_t StartChild(const std::string& command)
{
  setenv(kChildVariable, command.c_str(), 1);
  char program[] = "/proc/self/exe";
  char* const arguments[] = {program, nullptr};
  pid_t child = -1;
  const int error = posix_spawn(&child, program, nullptr, nullptr, arguments, environ);
  unsetenv(kChildVariable);
  EXPECT_EQ(error, 0);
  return child;
}

void PingPong(BusOptions options, bool share)
{
  const FreeDomain domain;
  options.domain = domain.Id();
  const pid_t child = StartChild(fmt::format("echo {} {} {} {} {}", options.domain, options.network_interface,
                                             options.peers.empty() ? "-" : options.peers[0],
                                             options.discovery_server.empty() ? "-" : options.discovery_server, share));

  {
    options.serves_discovery = !options.discovery_server.empty();
    Bus bus(options, "ping");
    std::optional<RunDirectory> directory;
    if (share) directory.emplace("echo_test", 5);
    const HotScope scope{"echo_test", share ? directory->Path() : "", options.Spread(), 100000, 1};
    HotPublisher<SpaceState> states(bus, scope);
    std::atomic<std::uint64_t> answered = 0;
    EngineUpdate update;
    HotSubscription<EngineUpdate> updates(bus, scope,
                                          {[&](const MessageHeader&) { return &update; },
                                           [&](const MessageHeader& header, EngineUpdate& message)
                                           {
                                             EXPECT_EQ(header.source, 3U);
                                             EXPECT_EQ(message.engine, 3U);
                                             ASSERT_EQ(message.poses.size(), 700U);
                                             EXPECT_EQ(message.poses[699], static_cast<double>(header.tick));
                                             answered = header.tick;
                                           }});
    ASSERT_TRUE(Eventually([&] { return states.Readers() == 1 && updates.Writers() == 1; }));
    SpaceState state;
    for (std::uint64_t tick = 0; tick < kRounds; ++tick)
    {
      state.poses.assign(700, static_cast<double>(tick));
      state.last = tick + 1 == kRounds;
      // Best-effort readers may miss the first messages, so late answers are requested again, as in a run.
      bool repeated = false;
      const auto answered_now = [&]
      {
        states.Write({1, tick, 0, std::exchange(repeated, true)}, state);
        return Eventually([&] { return answered == tick + 1; }, 100ms);
      };
      ASSERT_TRUE(Eventually(answered_now)) << "tick " << tick;
    }
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}

TEST(Bus, TalksOverLoopback) { PingPong(Options(), false); }

TEST(Bus, TalksBySharedMemoryAndLeavesNothing)
{
  PingPong(Options(), true);
  EXPECT_FALSE(std::filesystem::exists(SharedFolder() + "/echo_test-0000000000000005"));
}

TEST(Bus, TalksOverTheNetwork)
{
  BusOptions options = Options();
  options.network_interface = "all";
  PingPong(options, false);
}

TEST(Bus, FindsPeersWithoutMulticast)
{
  BusOptions options = Options();
  options.network_interface = "all";
  options.peers = {"127.0.0.1"};
  PingPong(options, false);
}

// Returns a port that no program listens at.
std::uint16_t FreeUdpPort()
{
  const int test = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  EXPECT_EQ(bind(test, reinterpret_cast<const sockaddr*>(&address), size), 0);
  EXPECT_EQ(getsockname(test, reinterpret_cast<sockaddr*>(&address), &size), 0);
  close(test);
  return ntohs(address.sin_port);
}

TEST(Bus, FindsOthersThroughADiscoveryServer)
{
  BusOptions options = Options();
  options.discovery_server = fmt::format("127.0.0.1:{}", FreeUdpPort());
  PingPong(options, false);
}

// Holds a port of UDP on this machine, if it is free.
class HeldPort
{
public:
  explicit HeldPort(int port) : file_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0))
  {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    // A process of another test may have it.
    [[maybe_unused]] const int result = bind(file_, reinterpret_cast<const sockaddr*>(&address), sizeof address);
  }
  ~HeldPort() { close(file_); }
  HeldPort(const HeldPort&) = delete;
  HeldPort& operator=(const HeldPort&) = delete;

private:
  int file_;
};

// The ports of the first processes of a domain are taken. Those of the next domain are not touched.
TEST(Bus, HearsOthersBesideAHundredProcesses)
{
  const FreeDomain domain;
  BusOptions options = Options();
  options.domain = domain.Id();
  std::list<HeldPort> held;
  for (int port = 7410; port < 7645; ++port) held.emplace_back(port + 250 * domain.Id());
  const pid_t child = StartChild(fmt::format("victim {} lo - - 0", options.domain));
  Bus bus(options, "watcher");
  std::atomic<bool> heard = false;
  Subscription<StatusMessage> in(bus, "x", [&](const StatusMessage&) { heard = true; });
  EXPECT_TRUE(Eventually([&] { return heard.load(); }));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}

TEST(Bus, DoesNotHearOtherPartitions)
{
  const FreeDomain domain;
  BusOptions options = Options();
  options.domain = domain.Id();
  Bus one(options, "one");
  Bus two(options, "two");
  std::atomic<int> heard = 0;
  Publisher<StatusMessage> here(one, "here");
  Publisher<StatusMessage> there(one, "there");
  Subscription<StatusMessage> from_here(two, "here",
                                        [&](const StatusMessage& status) { heard += status.text == "here" ? 1 : 100; });
  ASSERT_TRUE(Eventually([&] { return here.Readers() == 1; }));
  there.Write({1, 0, "x", "there"});
  here.Write({1, 0, "x", "here"});
  EXPECT_TRUE(Eventually([&] { return heard == 1; }));
  EXPECT_EQ(there.Readers(), 0U);
}

TEST(Bus, KeepsTheWorldForThoseWhoComeLater)
{
  const FreeDomain domain;
  BusOptions options = Options();
  options.domain = domain.Id();
  Bus server(options, "server");
  Publisher<WorldMessage> worlds(server, "kept");
  WorldMessage world;
  world.run = 77;
  world.xml = std::string(300000, 'x');
  world.entities.resize(2);
  world.entities[1] = {"fb_1", "footbot", true, 12};
  worlds.Write(world);
  Bus late(options, "late");
  std::mutex mutex;
  WorldMessage seen;
  Subscription<WorldMessage> in(late, "*",
                                [&](const WorldMessage& message)
                                {
                                  const std::lock_guard lock(mutex);
                                  seen = message;
                                });
  ASSERT_TRUE(Eventually(
      [&]
      {
        const std::lock_guard lock(mutex);
        return seen.run == 77;
      }));
  EXPECT_EQ(seen.xml, world.xml);
  ASSERT_EQ(seen.entities.size(), 2U);
  EXPECT_EQ(seen.entities[1].id, "fb_1");
  EXPECT_TRUE(seen.entities[1].movable);
  EXPECT_EQ(seen.entities[1].first_slot, 12U);
}

TEST(Bus, WhoeverComesAfterAMessageWasForgottenGetsOnlyLaterOnes)
{
  const FreeDomain domain;
  BusOptions options = Options();
  options.domain = domain.Id();
  Bus server(options, "server");
  Publisher<WorldMessage> worlds(server, "forgotten");
  WorldMessage world;
  world.run = 77;
  worlds.Write(world);
  worlds.Forget();
  Bus late(options, "late");
  std::mutex mutex;
  std::vector<std::uint64_t> runs;
  Subscription<WorldMessage> in(late, "*",
                                [&](const WorldMessage& message)
                                {
                                  const std::lock_guard lock(mutex);
                                  runs.push_back(message.run);
                                });
  ASSERT_TRUE(Eventually([&] { return worlds.Readers() == 1 && in.Writers() == 1; }));
  world.run = 78;
  worlds.Write(world);
  // Messages of one writer arrive in their order.
  ASSERT_TRUE(Eventually(
      [&]
      {
        const std::lock_guard lock(mutex);
        return !runs.empty();
      }));
  EXPECT_EQ(runs, (std::vector<std::uint64_t>{78}));
}

TEST(Bus, NamesAProcessThatWasKilledWithinASecond)
{
  const FreeDomain domain;
  BusOptions options = Options();
  options.domain = domain.Id();
  const pid_t child = StartChild(fmt::format("victim {} lo - - 0", options.domain));
  Bus bus(options, "watcher");
  std::mutex mutex;
  std::string gone;
  std::chrono::steady_clock::time_point when;
  bus.OnProcessGone(
      [&](const std::string& process, const std::string& name, bool died)
      {
        const std::lock_guard lock(mutex);
        gone = fmt::format("{} {} {}", process, name, died);
        when = std::chrono::steady_clock::now();
      });
  std::atomic<bool> heard = false;
  Subscription<StatusMessage> in(bus, "x", [&](const StatusMessage&) { heard = true; });
  ASSERT_TRUE(Eventually([&] { return heard.load(); }));
  const auto killed = std::chrono::steady_clock::now();
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_TRUE(Eventually(
      [&]
      {
        const std::lock_guard lock(mutex);
        return !gone.empty();
      }));
  const std::lock_guard lock(mutex);
  EXPECT_EQ(gone, fmt::format("{}:{} engine 'ground' true", MachineName(), child));
  // Its lease is 5 s; the rest is for a busy machine.
  EXPECT_LT(when - killed, 40s);
}

TEST(Bus, ThoseThatOnlySpeakMeetThoseThatHear)
{
  const FreeDomain domain;
  BusOptions options = Options();
  options.domain = domain.Id();
  const pid_t child = StartChild(fmt::format("victim {} lo - - false deaf", options.domain));
  Bus hearing(options, "space server");
  options.hears_announcements = false;
  Bus deaf(options, "controller host 1");
  std::atomic<int> heard = 0, others = 0;
  const Subscription<StatusMessage> in(hearing, "x", [&](const StatusMessage&) { ++heard; });
  const Subscription<StatusMessage> none(deaf, "x", [&](const StatusMessage&) { ++others; });
  Publisher<StatusMessage> out(hearing, "x");
  // More announcements than a process makes before it sends.
  EXPECT_TRUE(Eventually([&] { return heard >= 10; }));
  EXPECT_EQ(others, 0);
  EXPECT_TRUE(Eventually(
      [&]
      {
        out.Write({});
        return others > 0;
      }));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
}

TEST(Bus, RefusesInterfacesThatDoNotExistByName)
{
  BusOptions options = Options();
  options.network_interface = "nonesuch0";
  EXPECT_THAT(test::MessageOf<BusError>([&] { Bus bus(options, "x"); }),
              testing::AllOf(testing::HasSubstr("nonesuch0"), testing::HasSubstr("127.0.0.1")));
}

TEST(Bus, RefusesDomainsThatWouldEndTheProgram)
{
  BusOptions options = Options();
  options.domain = 233;
  EXPECT_THROW(Bus(options, "x"), BusError);
}

TEST(FreeDomain, GivesEveryCallerAnotherOne)
{
  const FreeDomain a;
  const FreeDomain b;
  EXPECT_NE(a.Id(), b.Id());
}

// Standard output is for the results of a run.
TEST(Bus, WhatFastDdsSaysGoesToTheLog)
{
  const test::TemporaryFolder folder;
  OpenLog({.process = "bus_test", .folder = folder.Path()});
  const BusOptions options = Options();
  Bus bus(options, "x");
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  EPROSIMA_LOG_ERROR(TEST, "no room for a segment");
  dds::Log::Flush();
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_THAT(folder.Read("bus_test.log"), testing::HasSubstr("info: Fast DDS, TEST: no room for a segment"));
}

}  // namespace
}  // namespace swarmanoid
