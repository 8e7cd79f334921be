// A program that does not belong to the run writes to all of its topics: what is malformed, or is not what the
// experiment makes of a message, changes nothing.
#include <csignal>
#include <mutex>
#include <random>

#include <fmt/format.h>

#include "common/bus/control_client.h"
#include "tests/cluster/cluster_fixture.h"
#include "tests/unit/bus/stranger.h"

namespace swarmanoid
{
namespace
{

using test::PayloadOf;
using testing::AllOf;
using testing::HasSubstr;

constexpr std::uint64_t kTicks = 40;

class StrangersTest : public ClusterTest
{
protected:
  std::vector<std::string> Noise(std::uint64_t run)
  {
    std::vector<std::string> payloads{std::string("\0\1\0\0", 4)};
    for (int k = 0; k < 20; ++k)
    {
      std::string payload(4 + random_() % 200, '\0');
      for (char& byte : payload) byte = static_cast<char>(random_());
      payload.replace(0, 4, std::string("\0\1\0\0", 4));
      // As if it were of this run and tick.
      if (payload.size() > 20)
      {
        std::memcpy(payload.data() + 4, &run, 8);
        std::memset(payload.data() + 12, 0, 8);
      }
      payloads.push_back(payload);
    }
    return payloads;
  }

  std::mt19937 random_{1};
};

TEST_F(StrangersTest, DoNotChangeARunByBadMessages)
{
  const std::string file = WriteExperiment("strangers", 1, kTicks);
  ChildProcess server = StartServer(file, {"--paused", "--hash-log", folder_ + "/hashes.txt"});
  std::vector<ChildProcess> workers = StartWorkers("strangers", 1, 1);
  BusOptions options;
  options.domain = domain_.Id();
  Bus bus(options, "test");
  std::mutex mutex;
  std::optional<WorldMessage> world;
  Subscription<WorldMessage> worlds(bus, "strangers",
                                    [&](const WorldMessage& heard)
                                    {
                                      const std::lock_guard lock(mutex);
                                      if (!world) world = heard;
                                    });
  ASSERT_TRUE(server.WaitForOutput("paused at tick 0")) << server.Output();
  const auto run = [&]
  {
    const std::lock_guard lock(mutex);
    return world ? world->run : 0;
  };
  for (int k = 0; k < 20000 && run() == 0; ++k) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ASSERT_NE(run(), 0U);

  test::Stranger stranger(domain_.Id(), "strangers");
  for (const char* topic : {"SpaceState", "ControlCommands", "EngineUpdate", "Join", "ControlRequest", "Status",
                            "Leave", "ViewRequest", "World"})
    EXPECT_TRUE(stranger.Send(topic, Noise(run()))) << topic;

  // Well-formed, of this run and of the tick that is waited for, but not what the experiment makes of them.
  const MessageHeader now{run(), 0, 0, false};
  const MessageHeader later{run(), 1000000, 0, false};
  SpaceState short_state;
  short_state.poses = {1};
  SpaceState slot_state;
  slot_state.poses.assign(7 * 12, 0.5);
  slot_state.attributes.Add(0x7ffffff0U, 1e308);
  SpaceState moved_state;
  moved_state.poses.assign(7 * 12, 0.5);
  moved_state.moved = {0x7ffffff0U};
  EXPECT_TRUE(stranger.Send("SpaceState",
                            {PayloadOf(now, short_state), PayloadOf(now, slot_state), PayloadOf(now, moved_state),
                             PayloadOf(later, short_state)},
                            2));
  ControlCommands commands;
  commands.values = {1};
  EXPECT_TRUE(stranger.Send("ControlCommands", {PayloadOf(now, commands), PayloadOf(later, commands)}));

  // While the engine sleeps the server waits for its update.
  ControlClient client(bus, "strangers");
  workers[0].Signal(SIGSTOP);
  client.Tell("resume", "", {});
  const MessageHeader next{run(), 1, 0, false};
  const MessageHeader nobody{run(), 1, 77, false};
  EngineUpdate update;
  update.poses = {1};
  EngineUpdate slot;
  slot.poses.assign(7 * 12, 0.5);
  slot.attributes.Add(0x7ffffff0U, 1e308);
  bool dropped = false;
  for (int k = 0; k < 200 && !dropped; ++k)
  {
    EXPECT_TRUE(stranger.Send("EngineUpdate", {PayloadOf(next, update), PayloadOf(next, slot),
                                               PayloadOf(nobody, update), PayloadOf(later, update)}));
    dropped = server.WaitForOutput("bad EngineUpdate", 0.05);
  }
  EXPECT_TRUE(dropped);
  workers[0].Signal(SIGCONT);

  EXPECT_EQ(server.Wait(), 0) << server.Output();
  for (ChildProcess& worker : workers) EXPECT_EQ(worker.Wait(), 0) << worker.Output();
  EXPECT_EQ(Read("hashes.txt"), HashesOfSingleProcess(file));
  EXPECT_THAT(server.Output(), AllOf(HasSubstr("dropped a bad Status message of an unknown process"),
                                     HasSubstr("dropped a bad Leave message of an unknown process")));
  EXPECT_THAT(workers[0].Output(), AllOf(HasSubstr("dropped a bad SpaceState message of an unknown process"),
                                         HasSubstr("dropped a bad ControlCommands message of an unknown process"),
                                         HasSubstr("dropped a bad World message of an unknown process")));
  EXPECT_THAT(workers[1].Output(), HasSubstr("dropped a bad SpaceState message of an unknown process"));
}

}  // namespace
}  // namespace swarmanoid
