// The answers of a running cluster to visualisers beyond its state: the status of the run, and the inside of robots.
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <map>
#include <mutex>
#include <optional>
#include <thread>

#include "common/bus/membership/control_client.h"
#include "common/experiment/load_experiment.h"
#include "simulation/playback/recorded_robot_states.h"
#include "simulation/register_all.h"
#include "tests/cluster/cluster_fixture.h"
#include "tests/cluster/latest_message.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using testing::HasSubstr;

class InspectionTest : public ClusterTest
{
protected:
  void Begin(int ticks, int hosts, const std::vector<std::string>& options)
  {
    file_ = WriteExperiment("inspected", 1, ticks);
    std::vector<std::string> all = options;
    all.insert(all.end(), {"--hash-log", folder_ + "/hashes.txt", "--controller-hosts", std::to_string(hosts)});
    // Processes that are stopped, or get no core, are to be late, not dead.
    options_ = {"--lease", "60"};
    server_.emplace(StartServer(file_, all));
    workers_ = StartWorkers("inspected", 1, hosts);
    BusOptions bus;
    bus.lease_s = 60;
    bus.domain = domain_.Id();
    bus_.emplace(bus, "test");
    client_.emplace(*bus_, "inspected");
    world_.emplace(*bus_, "inspected");
    ASSERT_TRUE(Eventually([&] { return world_->Get().has_value(); }));
  }

  ControlReplyMessage Ask(const std::string& words)
  {
    const auto reply = client_->Ask(OrderOf(words), kGenerous_s);
    EXPECT_TRUE(reply.has_value()) << words << "\n" << server_->Output();
    return reply.value_or(ControlReplyMessage{});
  }

  ViewRequestMessage Request(const std::vector<std::string>& robots)
  {
    ViewRequestMessage request;
    request.client = ProcessId();
    request.run = world_->Get()->run;
    const std::vector<WorldEntity> entities = world_->Get()->entities;
    for (std::uint32_t i = 0; i < entities.size(); ++i)
      if (std::ranges::find(robots, entities[i].id) != robots.end()) request.robots.push_back(i);
    return request;
  }

  void ExpectEnd()
  {
    EXPECT_EQ(server_->Wait(), 0) << server_->Output();
    for (ChildProcess& worker : workers_) EXPECT_EQ(worker.Wait(), 0) << worker.Output();
    world_.reset();
    client_.reset();
    bus_.reset();
    ExpectNothingLeft();
  }

  std::string file_;
  std::optional<ChildProcess> server_;
  std::vector<ChildProcess> workers_;
  std::optional<Bus> bus_;
  std::optional<ControlClient> client_;
  std::optional<LatestMessage<WorldMessage>> world_;
};

TEST_F(InspectionTest, TheRunTellsItsPhasePaceAndProcesses)
{
  Begin(0, 2, {"--paused", "--real-time", "3"});
  LatestMessage<RunStatusMessage> status(*bus_, "inspected");
  const auto phase = [&] { return status.Get() ? status.Get()->status.phase : RunStatus::Phase::kUnknown; };
  ASSERT_TRUE(Eventually([&] { return phase() == RunStatus::Phase::kPaused; }));
  const RunStatus paused = status.Get()->status;
  EXPECT_EQ(paused.speed_wanted, 3);
  EXPECT_EQ(paused.ticks_per_second, 0);
  ASSERT_EQ(paused.processes.size(), 4U);
  EXPECT_EQ(paused.processes[0].name, "space server");
  EXPECT_EQ(paused.processes[1].name, "engine 'e0'");
  EXPECT_EQ(paused.processes[2].name, "controller host 0");
  EXPECT_EQ(paused.processes[3].name, "controller host 1");
  for (const ProcessStatus& process : paused.processes)
    EXPECT_THAT(process.process, testing::ContainsRegex(":[0-9]+$"));

  Ask("resume");
  // The pace is measured: a machine that stands still meanwhile reports another pace for a while.
  const auto is_told = [&]
  {
    const RunStatus running = status.Get()->status;
    return running.phase == RunStatus::Phase::kRunning && running.tick > 60 &&
           std::abs(running.real_time_factor - 3) < 1 && std::abs(running.ticks_per_second - 30) < 10;
  };
  ASSERT_TRUE(Eventually(is_told));
  Ask("stop");
  ASSERT_TRUE(Eventually([&] { return phase() == RunStatus::Phase::kFinished; }));
  EXPECT_EQ(status.Get()->status.ended, "stopped by " + UserName() + "@" + ProcessId());
  ExpectEnd();
}

TEST_F(InspectionTest, AProcessThatIsLateIsNamed)
{
  // Paused, it holds no lock of the memory that it shares with the others when it is stopped.
  Begin(0, 2, {"--paused", "--real-time", "5"});
  LatestMessage<RunStatusMessage> status(*bus_, "inspected");
  ChildProcess& host = workers_.back();
  const auto late = [&]
  {
    std::vector<std::string> names;
    const RunStatusMessage now = *status.Get();
    for (const ProcessStatus& process : now.status.processes)
      if (process.late_s > 1.5) names.push_back(process.name);
    return names;
  };
  const auto is_on_time = [&]
  {
    const RunStatusMessage now = *status.Get();
    return std::ranges::none_of(now.status.processes, [](const ProcessStatus& process) { return process.late_s > 0; });
  };
  // The engine says twice in the same words that it waits for the host.
  for (int time = 0; time < 2; ++time)
  {
    Ask("step 20");
    ASSERT_TRUE(host.StopAsleep());
    Ask("resume");
    ASSERT_TRUE(Eventually([&] { return status.Get().has_value(); }));
    EXPECT_TRUE(Eventually([&] { return late() == std::vector<std::string>{"controller host 1"}; }))
        << testing::PrintToString(late());
    host.Signal(SIGCONT);
    EXPECT_TRUE(Eventually(is_on_time));
    Ask("pause");
  }
  Ask("stop");
  ExpectEnd();
}

TEST_F(InspectionTest, WatchedRobotsOfAllHostsTellTheirInside)
{
  Begin(0, 2, {"--paused"});
  LatestMessage<RobotStatusMessage> status(*bus_, "inspected");
  Publisher<ViewRequestMessage> request(*bus_, "inspected");
  // These are the robots of one host; while the run is paused the answer comes too.
  ASSERT_EQ(Ask("step 4").tick, 4U);
  request.Write(Request({"robots0_2"}));
  ASSERT_TRUE(Eventually([&] { return status.Get().has_value(); }));
  const RobotStatusMessage message = *status.Get();
  EXPECT_EQ(message.tick, 3U);
  ASSERT_EQ(message.robots.size(), 1U);
  const RobotStatus& robot = message.robots[0];
  EXPECT_EQ(world_->Get()->entities[robot.entity].id, "robots0_2");
  EXPECT_EQ(robot.controller, "diffusion");
  ASSERT_EQ(robot.sensors.size(), 2U);
  EXPECT_EQ(robot.sensors[0].readings.size(), 24U);
  EXPECT_EQ(robot.sensors[1].type, "footbot_encoders");
  EXPECT_EQ(robot.sensors[1].readings[1].unit, "rad/s");
  ASSERT_EQ(robot.actuators.size(), 2U);
  EXPECT_EQ(robot.actuators[1].type, "footbot_leds");
  EXPECT_EQ(robot.actuators[1].readings.at(0).unit, "colour");

  std::mutex mutex;
  std::map<std::uint32_t, std::string> robot_of_host;
  const std::vector<WorldEntity> entities = world_->Get()->entities;
  Subscription<RobotStatusMessage> both(*bus_, "inspected",
                                        [&](const RobotStatusMessage& heard)
                                        {
                                          const std::lock_guard lock(mutex);
                                          robot_of_host[heard.source] = entities[heard.robots.at(0).entity].id;
                                        });
  request.Write(Request({"robots0_2", "robots0_11"}));
  EXPECT_TRUE(Eventually(
      [&]
      {
        const std::lock_guard lock(mutex);
        return robot_of_host ==
               std::map<std::uint32_t, std::string>{{message.source, "robots0_2"}, {1 - message.source, "robots0_11"}};
      }));
  Ask("stop");
  ExpectEnd();
}

// Returns the bits of all numbers, and all texts.
std::string InsideOf(const RobotStatus& robot)
{
  std::string text =
      fmt::format("{} {} {} {} {}\n", robot.entity, robot.tick, robot.controller, robot.state, robot.text);
  for (const auto* devices : {&robot.sensors, &robot.actuators})
    for (const DeviceStatus& device : *devices)
    {
      text += device.type;
      for (const CCI_Reading& reading : device.readings)
        text += fmt::format(" {}={:a} {}", reading.name, reading.value, reading.unit);
      text += "\n";
    }
  return text;
}

TEST_F(InspectionTest, ThePastOfRobotsIsWhatWasToldOfThemThen)
{
  Begin(0, 2, {"--paused", "--output", folder_ + "/run"});
  constexpr std::uint64_t kTicks = 150;
  std::mutex mutex;
  std::map<std::pair<std::uint64_t, std::uint32_t>, std::string> told;  // by tick and robot
  ViewRequestMessage request = Request({"robots0_2", "robots0_11"});
  request.every_tick = true;
  {
    Subscription<RobotStatusMessage> statuses(*bus_, "inspected",
                                              [&](const RobotStatusMessage& heard)
                                              {
                                                const std::lock_guard lock(mutex);
                                                for (RobotStatus robot : heard.robots)
                                                {
                                                  robot.tick = heard.tick;
                                                  told[{robot.tick, robot.entity}] = InsideOf(robot);
                                                }
                                              });
    Publisher<ViewRequestMessage> requests(*bus_, "inspected");
    for (std::uint64_t tick = 1; tick <= kTicks; ++tick)
    {
      ASSERT_EQ(Ask("step").tick, tick);
      ASSERT_TRUE(Eventually(
          [&]
          {
            const std::lock_guard lock(mutex);
            if (told.contains({tick - 1, request.robots[0]}) && told.contains({tick - 1, request.robots[1]}))
              return true;
            requests.Write(request);
            return false;
          }));
    }
  }
  Ask("stop");
  ExpectEnd();

  RegisterBuiltins();
  const auto experiment = LoadExperimentFile(file_).experiment;
  ASSERT_TRUE(experiment);
  for (const std::uint64_t tick : {0, 1, 99, 100, 101, 149})
  {
    const RecordedRobotStates past(*experiment, folder_ + "/run", tick, request.robots);
    ASSERT_EQ(past.Robots().size(), 2U);
    for (const RobotStatus& robot : past.Robots())
      EXPECT_EQ(InsideOf(robot), (told[{tick, robot.entity}])) << "tick " << tick;
  }
  EXPECT_NE((told[{149, request.robots[0]}]), (told[{100, request.robots[0]}]));
  const std::string lacks = test::MessageOf<std::runtime_error>(
      [&] { RecordedRobotStates(*experiment, folder_ + "/run", kTicks + 1, request.robots); });
  EXPECT_EQ(lacks.rfind("the journal has ticks 0 to ", 0), 0U) << lacks;
}

TEST_F(InspectionTest, WatchingIsForgottenWithoutRepetitionAndLeavesTheHashesAlone)
{
  Begin(0, 1, {"--paused"});
  std::uint64_t ticks = 0;
  {
    LatestMessage<RobotStatusMessage> status(*bus_, "inspected");
    Publisher<ViewRequestMessage> request(*bus_, "inspected");
    ViewRequestMessage all = Request({"robots0_0", "robots0_1", "robots0_5"});
    all.every_tick = true;
    request.Write(all);
    ASSERT_TRUE(Eventually([&] { return status.Count() > 0; }));
    ASSERT_EQ(Ask("step 200").tick, 200U);
    EXPECT_TRUE(Eventually([&] { return status.Get()->tick == 199; }));
    // A second passes without a report of a step.
    const auto forgotten = [&]
    {
      const int before = status.Count();
      ticks = Ask("step").tick;
      return !Eventually([&] { return status.Count() > before; }, 1s);
    };
    EXPECT_TRUE(Eventually(forgotten));
    const int before = status.Count();
    ticks = Ask("step 200").tick;
    // Reports of the earlier request come before those of the present one. One of them may come before the host
    // notices.
    request.Write(all);
    EXPECT_TRUE(Eventually([&] { return status.Get()->tick + 1 == ticks; }));
    EXPECT_LE(status.Count(), before + 2);
  }
  Ask("stop");
  ExpectEnd();
  // The same number of ticks in one process.
  file_ = WriteExperiment("inspected", 1, static_cast<int>(ticks));
  EXPECT_EQ(Read("hashes.txt"), HashesOfSingleProcess(file_));
}

TEST_F(InspectionTest, ViewsComeAtThePaceThatIsWishedFor)
{
  Begin(0, 1, {});
  Publisher<ViewRequestMessage> request(*bus_, "inspected");
  ViewRequestMessage slow = Request({});
  slow.views = 2;
  request.Write(slow);
  LatestMessage<ViewMessage> views(*bus_, "inspected");
  // Until the server has received the request, views come more often.
  int seen = 0;
  auto start = std::chrono::steady_clock::now();
  ASSERT_TRUE(Eventually(
      [&]
      {
        request.Write(slow);
        const auto now = std::chrono::steady_clock::now();
        if (views.Count() == seen) return seen > 0 && now - start >= 400ms;
        seen = views.Count();
        start = now;
        return false;
      }));
  const int before = views.Count();
  start = std::chrono::steady_clock::now();
  EXPECT_TRUE(Eventually(
      [&]
      {
        request.Write(slow);
        return views.Count() >= before + 5;
      }));
  // Two views each second come, and never more, however busy the machine is.
  EXPECT_GE(std::chrono::steady_clock::now() - start, 1500ms);
  Ask("stop");
  ExpectEnd();
}

// An answer goes to all processes, so an answer for each of many would cost the square of their number.
TEST_F(InspectionTest, TheEndOfARunAnswersAllThatLeave)
{
  Begin(20, 4, {"--paused"});
  std::mutex mutex;
  std::vector<std::string> answered;
  const Subscription<LeaveMessage> leaves(*bus_, "inspected",
                                          [&](const LeaveMessage& leave)
                                          {
                                            const std::lock_guard lock(mutex);
                                            if (leave.name == "space server") answered.push_back(leave.process);
                                          });
  Ask("resume");
  EXPECT_EQ(server_->Wait(), 0) << server_->Output();
  for (ChildProcess& worker : workers_) EXPECT_EQ(worker.Wait(), 0) << worker.Output();
  EXPECT_TRUE(Eventually(
      [&]
      {
        const std::lock_guard lock(mutex);
        return !answered.empty();
      }));
  const std::lock_guard lock(mutex);
  EXPECT_EQ(answered, std::vector<std::string>{""});
}

}  // namespace
}  // namespace swarmanoid
