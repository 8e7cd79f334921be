// A run in one process that others watch and steer over the bus, as they do a cluster.
#include <atomic>
#include <thread>

#include "common/bus/membership/control_client.h"
#include "common/experiment/load_experiment.h"
#include "launcher/bus/run_on_bus.h"
#include "simulation/register_all.h"
#include "simulation/single_process.h"
#include "tests/cluster/cluster_fixture.h"
#include "tests/cluster/latest_message.h"

namespace swarmanoid
{
namespace
{

using testing::HasSubstr;

class RunOnBusTest : public ClusterTest
{
protected:
  void Begin(int ticks, bool paused, const std::optional<RunKey>& key = NewRunKey())
  {
    RegisterBuiltins();
    const std::string file = WriteExperiment("watched", 1, ticks);
    RunSettings settings;
    settings.file = file;
    settings.single_process = true;
    settings.paused = paused;
    settings.quiet = true;
    settings.domain.reset();
    LoadedExperiment loaded = LoadExperimentFile(file);
    for (const Diagnostic& error : loaded.errors) ADD_FAILURE() << error.Text();
    const RunFolder folder(folder_ + "/run", "watched");
    const RunRequest request = RunRequest(settings).With(
        [&](RunSettings& changed)
        {
          changed.domain = domain_.Id();
          changed.output_folder = folder.Path();
        });
    run_.emplace(PreparedRun{request, std::move(loaded.experiment), folder, {}});
    link_.emplace(*run_, key);
    thread_ = std::thread(
        [this]
        {
          SingleProcessOptions options;
          static_cast<SimulatorOptions&>(options) = run_->request.Settings();
          options.event_log = folder_ + "/events.csv";
          options.companions.link = &*link_;
          summary_ = RunSingleProcess(*run_->experiment, options);
        });
    BusOptions bus;
    bus.domain = domain_.Id();
    bus.key = key;
    bus.insecure = !key;
    bus_.emplace(bus, "test");
    client_.emplace(*bus_, "watched");
    world_.emplace(*bus_, "watched");
    ASSERT_TRUE(Eventually([&] { return world_->Get().has_value(); }));
  }

  ControlReplyMessage Ask(const std::string& words)
  {
    const auto reply = client_->Ask(OrderOf(words), kGenerous_s);
    EXPECT_TRUE(reply.has_value()) << words;
    return reply.value_or(ControlReplyMessage{});
  }

  ViewRequestMessage Request(double views, const std::vector<std::string>& robots)
  {
    ViewRequestMessage request;
    request.client = ProcessId();
    request.run = world_->Get()->run;
    request.views = views;
    const std::vector<WorldEntity> entities = world_->Get()->entities;
    for (std::uint32_t i = 0; i < entities.size(); ++i)
      if (std::ranges::find(robots, entities[i].id) != robots.end()) request.robots.push_back(i);
    return request;
  }

  void End()
  {
    thread_.join();
    world_.reset();
    client_.reset();
    bus_.reset();
    link_.reset();
  }

  static constexpr double kGenerous_s = 100;
  std::optional<PreparedRun> run_;
  std::optional<RunOnBus> link_;
  std::thread thread_;
  RunSummary summary_;
  std::optional<Bus> bus_;
  std::optional<ControlClient> client_;
  std::optional<LatestMessage<WorldMessage>> world_;
};

TEST_F(RunOnBusTest, ObserversSeeEachStateThatTheyStepToAndTheEnd)
{
  Begin(100, true);
  LatestMessage<ViewMessage> views(*bus_, "watched");
  LatestMessage<RunStatusMessage> status(*bus_, "watched");
  Publisher<ViewRequestMessage> request(*bus_, "watched");
  request.Write(Request(30, {}));
  const auto tick = [&] { return views.Get() ? views.Get()->snapshot.tick : ~std::uint64_t{0}; };
  ASSERT_TRUE(Eventually([&] { return tick() == 0; }));
  ASSERT_TRUE(Eventually([&] { return status.Get() && status.Get()->status.phase == RunStatus::Phase::kPaused; }));
  EXPECT_EQ(status.Get()->status.processes[0].name, "single process");
  EXPECT_EQ(Ask("step 7").tick, 7U);
  EXPECT_TRUE(Eventually([&] { return tick() == 7; }));
  EXPECT_EQ(views.Get()->snapshot.poses.size(), 7U * 12) << "the robots";
  Ask("resume");
  EXPECT_TRUE(Eventually([&] { return tick() == 100 && views.Get()->snapshot.last; }));
  EXPECT_TRUE(Eventually([&] { return status.Get()->status.phase == RunStatus::Phase::kFinished; }));
  End();
  EXPECT_EQ(summary_.ticks, 100U);
}

TEST_F(RunOnBusTest, NobodyWhoWatchesChangesTheHash)
{
  SingleProcessOptions plain;
  plain.output_folder = folder_;
  RegisterBuiltins();
  const auto experiment = std::move(LoadExperimentFile(WriteExperiment("watched", 1, 200)).experiment);
  const RunSummary expected = RunSingleProcess(*experiment, plain);
  Begin(200, true);
  LatestMessage<ViewMessage> views(*bus_, "watched");
  Publisher<ViewRequestMessage> request(*bus_, "watched");
  request.Write(Request(30, {"robots0_2"}));
  Ask("resume");
  End();
  EXPECT_EQ(summary_.hash, expected.hash);
}

TEST_F(RunOnBusTest, RobotsTellTheirInsideAlsoWhileTheRunIsPaused)
{
  Begin(0, true);
  LatestMessage<RobotStatusMessage> status(*bus_, "watched");
  Publisher<ViewRequestMessage> request(*bus_, "watched");
  ASSERT_EQ(Ask("step 4").tick, 4U);
  request.Write(Request(0, {"robots0_2"}));
  ASSERT_TRUE(Eventually([&] { return status.Get().has_value(); }));
  const RobotStatusMessage message = *status.Get();
  EXPECT_EQ(message.tick, 3U);
  ASSERT_EQ(message.robots.size(), 1U);
  EXPECT_EQ(world_->Get()->entities[message.robots[0].entity].id, "robots0_2");
  EXPECT_EQ(message.robots[0].controller, "diffusion");
  EXPECT_EQ(message.robots[0].sensors[0].readings.size(), 24U);
  Ask("stop");
  End();
  EXPECT_EQ(summary_.ticks, 4U);
}

TEST_F(RunOnBusTest, RequestsAreCarriedOutLoggedAndRefusedWithTheReason)
{
  Begin(0, true);
  EXPECT_TRUE(Ask("move robots0_1 0.4,0.5,0").ok);
  const ControlReplyMessage refused = Ask("move nobody 1,1,0");
  EXPECT_FALSE(refused.ok);
  EXPECT_THAT(refused.text, HasSubstr("nobody"));
  // One process has no other machine, and no other hosts.
  EXPECT_FALSE(Ask("hosts +1").ok);
  Ask("stop");
  End();
  EXPECT_THAT(Read("events.csv"), HasSubstr("0,move,robots0_1"));
  EXPECT_THAT(Read("events.csv"), HasSubstr(UserName() + "@"));
}

TEST_F(RunOnBusTest, ARunWithoutObserversEndsAtOnceAndLeavesNothing)
{
  Begin(0, true);
  Ask("stop");
  End();
  ExpectNothingLeft();
}

TEST_F(RunOnBusTest, AnEndInGoodOrderIsNoFailureForObservers)
{
  Begin(0, true);
  LatestMessage<LeaveMessage> leave(*bus_, "watched");
  Ask("stop");
  thread_.join();
  // The run has ended in good order, so nothing is left to fail.
  link_->Fail("too late");
  EXPECT_FALSE(link_->IsOpen());
  EXPECT_TRUE(Eventually([&] { return leave.Get() && leave.Get()->name == "space server"; }));
  EXPECT_EQ(leave.Get()->error, "");
  thread_ = std::thread([] {});
  End();
}

}  // namespace
}  // namespace swarmanoid
