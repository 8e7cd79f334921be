// A program writes to all topics of a run that lets every process in. Malformed messages, and messages that do not fit
// the experiment, change nothing. Runs with a key are in attacks_test.cpp.
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <limits>
#include <mutex>
#include <random>

#include <fmt/format.h>

#include "common/bus/membership/control_client.h"
#include "tests/cluster/cluster_fixture.h"
#include "tests/unit/bus/stranger.h"
#include "visualiser/cluster/remote_monitor.h"

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
  StrangersTest() { options_ = {"--insecure"}; }

  // Payloads of no meaning, and others behind them.
  std::vector<std::string> Noise(std::uint64_t run, const std::vector<std::string>& others = {})
  {
    std::vector<std::string> payloads{std::string("\0\1\0\0", 4)};
    for (int k = 0; k < 20; ++k)
    {
      std::string payload(4 + random_() % 200, '\0');
      for (char& byte : payload) byte = static_cast<char>(random_());
      payload.replace(0, 4, std::string("\0\1\0\0", 4));
      // The payload gets the numbers of this run and tick.
      if (payload.size() > 20)
      {
        std::memcpy(payload.data() + 4, &run, 8);
        std::memset(payload.data() + 12, 0, 8);
      }
      payloads.push_back(payload);
    }
    payloads.insert(payloads.end(), others.begin(), others.end());
    return payloads;
  }

  // The world of the run on this bus, once it is heard.
  static std::optional<WorldMessage> WorldOn(Bus& bus, const std::string& experiment)
  {
    std::mutex mutex;
    std::optional<WorldMessage> world;
    const Subscription<WorldMessage> worlds(bus, experiment,
                                            [&](const WorldMessage& heard)
                                            {
                                              const std::lock_guard lock(mutex);
                                              if (!world) world = heard;
                                            });
    Eventually(
        [&]
        {
          const std::lock_guard lock(mutex);
          return world.has_value();
        });
    const std::lock_guard lock(mutex);
    return world;
  }

  static std::size_t Count(const std::string& text, const std::string& part)
  {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
  }

  // Hot topics are read at best effort. A message that arrives before a reader knows its writer is lost, so it is sent
  // again until each reader has reported it.
  static bool SendUntilTold(test::Stranger& stranger, const std::string& topic,
                            const std::vector<std::string>& payloads, const std::vector<const ChildProcess*>& readers)
  {
    const std::string told = fmt::format("dropped a bad {} message of an unknown process", topic);
    return Eventually(
        [&]
        {
          EXPECT_TRUE(stranger.Send(topic, payloads, static_cast<int>(readers.size()))) << topic;
          return std::all_of(readers.begin(), readers.end(),
                             [&](const ChildProcess* reader) { return reader->WaitForOutput(told, 0.05); });
        });
  }

  // Each message is reported, and only once for a sender.
  static void ExpectTold(const std::string& output, const std::vector<std::string>& topics)
  {
    for (const std::string& topic : topics)
      EXPECT_EQ(Count(output, fmt::format("dropped a bad {} message of an unknown process", topic)), 1U)
          << topic << "\n"
          << output;
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
  options.insecure = true;
  Bus bus(options, "test");
  ASSERT_TRUE(server.WaitForOutput("paused at tick 0")) << server.Output();
  const std::optional<WorldMessage> world = WorldOn(bus, "strangers");
  ASSERT_TRUE(world.has_value());
  const std::uint64_t run = world->run;

  test::Stranger stranger(domain_.Id(), "strangers");
  for (const char* topic : {"Join", "ControlRequest", "Status", "Leave", "ViewRequest", "World"})
    EXPECT_TRUE(stranger.Send(topic, Noise(run))) << topic;

  // These messages are well-formed, of this run and of the present tick, but do not fit the experiment.
  const MessageHeader now{run, 0, 0, false};
  const MessageHeader later{run, 1000000, 0, false};
  SpaceState short_state;
  short_state.poses = {1};
  SpaceState slot_state;
  slot_state.poses.assign(7 * 12, 0.5);
  slot_state.attributes.Add(0x7ffffff0U, 1e308);
  SpaceState moved_state;
  moved_state.poses.assign(7 * 12, 0.5);
  moved_state.moved = {0x7ffffff0U};
  EXPECT_TRUE(SendUntilTold(stranger, "SpaceState",
                            Noise(run, {PayloadOf(now, short_state), PayloadOf(now, slot_state),
                                        PayloadOf(now, moved_state), PayloadOf(later, short_state)}),
                            {&workers[0], &workers[1]}));
  ControlCommands commands;
  commands.values = {1};
  EXPECT_TRUE(SendUntilTold(stranger, "ControlCommands",
                            Noise(run, {PayloadOf(now, commands), PayloadOf(later, commands)}), {&workers[0]}));

  // While the engine sleeps the server waits for its update.
  ControlClient client(bus, "strangers");
  workers[0].Signal(SIGSTOP);
  client.Send({"resume"});
  const MessageHeader next{run, 1, 0, false};
  const MessageHeader absent{run, 1, 77, false};
  EngineUpdate update;
  update.poses = {1};
  EngineUpdate slot;
  slot.poses.assign(7 * 12, 0.5);
  slot.attributes.Add(0x7ffffff0U, 1e308);
  EXPECT_TRUE(SendUntilTold(
      stranger, "EngineUpdate",
      Noise(run, {PayloadOf(next, update), PayloadOf(next, slot), PayloadOf(absent, update), PayloadOf(later, update)}),
      {&server}));
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

// Tests checkpoints, pictures that each tick waits for, sensors of an engine, and all topics of observers.
TEST_F(StrangersTest, DoNotChangeARunThatIsWatchedByBadMessages)
{
  constexpr std::uint64_t kCheckpoint = 100;
  const std::string file = WriteExperiment("watched", 1, kCheckpoint + 20, "<text_render id='table'/>");
  const std::string output = folder_ + "/run";
  ChildProcess server = StartServer(file, {"--paused", "--hash-log", folder_ + "/hashes.txt", "--checkpoint-every",
                                           std::to_string(kCheckpoint), "--output", output});
  std::vector<ChildProcess> workers = StartWorkers("watched", 1, 1);
  workers.push_back(Start("visualiser", {"--experiment", "watched", "--render", "table", "--output", folder_}));
  ASSERT_TRUE(server.WaitForOutput("paused at tick 0")) << server.Output();
  workers.push_back(Start("visualiser", {"--experiment", "watched", "--attach", "text", "--output", folder_}));
  const std::size_t attached = workers.size() - 1;

  testing::internal::CaptureStderr();
  BusOptions options;
  options.domain = domain_.Id();
  options.insecure = true;
  Bus bus(options, "test");
  const std::optional<WorldMessage> world = WorldOn(bus, "watched");
  ASSERT_TRUE(world.has_value());
  const std::uint64_t run = world->run;
  RemoteMonitor monitor(bus, *world, false);
  monitor.Status();
  monitor.Notes();
  const std::vector<std::uint32_t> robots{static_cast<std::uint32_t>(world->entities.size() - 1)};
  monitor.Watch(robots);
  ControlClient client(bus, "watched");

  test::Stranger stranger(domain_.Id(), "watched");
  const auto send = [&](const std::string& topic, const std::vector<std::string>& out_of_place, int readers = 1)
  { EXPECT_TRUE(stranger.Send(topic, Noise(run, out_of_place), readers)) << topic; };
  const std::string engine = "engine 'e0'";
  const std::vector<char> state(10, 'x');
  send("SavedState", {PayloadOf(SavedStateMessage{run, 0, engine, state}),
                      PayloadOf(SavedStateMessage{run, kCheckpoint / 2, engine, state}),
                      PayloadOf(SavedStateMessage{run, 1000 * kCheckpoint, engine, state}),
                      PayloadOf(SavedStateMessage{run, kCheckpoint, "absent", state})});
  EXPECT_TRUE(SendUntilTold(stranger, "Drawn",
                            Noise(run, {PayloadOf(MessageHeader{run, 0, 77, false}, DrawnMessage{true})}), {&server}));
  SensorFrame frame;
  frame.values = {1};
  EXPECT_TRUE(SendUntilTold(stranger, "SensorFrame", Noise(run, {PayloadOf(MessageHeader{run, 1, 77, false}, frame)}),
                            {&workers[1]}));
  ViewMessage view{run, {}};
  view.snapshot.poses = {1};
  send("View", {PayloadOf(view)});
  RunStatusMessage status{run, {}};
  status.status.phase = static_cast<RunStatus::Phase>(77);
  RunStatusMessage fast{run, {}};
  fast.status.real_time_factor = std::numeric_limits<double>::infinity();
  send("RunStatus", {PayloadOf(status), PayloadOf(fast)});
  RobotStatus absent;
  absent.entity = 0x7fffffffU;
  absent.controller = "absent";
  send("RobotStatus", {PayloadOf(RobotStatusMessage{run, 1, 0, {absent}})});
  // Ours, and those of the visualisers.
  send("ControlReply", {PayloadOf(ControlReplyMessage{"somebody", 7, true, 5, "paused"})}, 4);

  // While the visualiser sleeps, the server waits for its answer.
  workers[2].Signal(SIGSTOP);
  const auto reply = client.Ask({"resume"}, kGenerous_s);
  ASSERT_TRUE(reply.has_value()) << server.Output();
  EXPECT_TRUE(reply->ok) << reply->text;
  std::string flags = PayloadOf(MessageHeader{run, 0, 0, false}, DrawnMessage());
  flags.back() = '\x40';
  EXPECT_TRUE(stranger.Send("Drawn", {flags}));
  workers[2].Signal(SIGCONT);

  EXPECT_EQ(server.Wait(), 0) << server.Output();
  for (ChildProcess& worker : workers) EXPECT_EQ(worker.Wait(), 0) << worker.Output();
  const std::string heard = testing::internal::GetCapturedStderr();
  EXPECT_EQ(Read("hashes.txt"), HashesOfSingleProcess(file));
  EXPECT_TRUE(std::filesystem::exists(output + "/checkpoint-00000100"));
  EXPECT_FALSE(std::filesystem::exists(output + "/checkpoint-00000000"));
  ExpectTold(server.Output(), {"SavedState", "Drawn"});
  ExpectTold(workers[1].Output(), {"SensorFrame"});
  ExpectTold(workers[attached].Output(), {"View", "ControlReply"});
  ExpectTold(heard, {"RunStatus", "RobotStatus", "ControlReply"});
  // Noise is malformed; the others are valid messages in the wrong place. Two processes of the test receive the
  // replies.
  constexpr std::uint64_t kNoise = 21;
  EXPECT_EQ(bus.Dropped(), 2 * kNoise + (kNoise + 1) + (kNoise + 2));
  EXPECT_NE(monitor.Status().phase, static_cast<RunStatus::Phase>(77));
}

}  // namespace
}  // namespace swarmanoid
