// Processes that die, hang, are of another version or are asked for what is not there.
#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include <fmt/format.h>

#include "common/bus/bus.h"
#include "common/bus/membership/control_client.h"
#include "idl/messages.h"
#include "tests/cluster/cluster_fixture.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using testing::AllOf;
using testing::HasSubstr;

TEST_F(ClusterTest, AKilledWorkerEndsTheRunAfterTheLeaseAndIsNamed)
{
  options_ = {"--lease", "1"};
  ChildProcess server = StartServer(WriteExperiment("deadly", 2, 0), {"--hash-log", folder_ + "/hashes.txt"});
  std::vector<ChildProcess> workers = StartWorkers("deadly", 2, 1);
  ASSERT_TRUE(Reaches(100)) << server.Output();
  ASSERT_TRUE(Ask("deadly", "pause")) << server.Output();
  // Asleep it holds no lock of the memory that it shares with the others, which end in another way then.
  ASSERT_TRUE(workers[1].StopAsleep());
  workers[1].Signal(SIGKILL);
  EXPECT_EQ(server.Wait(), 6);
  EXPECT_THAT(server.Output(), HasSubstr(fmt::format("engine 'e1' does not answer any more (process {}:{}",
                                                     MachineName(), workers[1].Id())));
  EXPECT_EQ(workers[0].Wait(), 6);
  EXPECT_EQ(workers[2].Wait(), 6);
  ExpectNothingLeft();
}

TEST_F(ClusterTest, WorkersEndWhenTheServerIsKilled)
{
  std::vector<ChildProcess> workers = StartWorkers("orphaned", 1, 1);
  {
    ChildProcess server = StartServer(WriteExperiment("orphaned", 1, 0));
    ASSERT_TRUE(server.WaitForOutput("running")) << server.Output();
    server.Signal(SIGKILL);
    server.Wait();
  }
  for (ChildProcess& worker : workers)
  {
    EXPECT_EQ(worker.Wait(), 8);
    EXPECT_THAT(worker.Output(), HasSubstr("the space server has gone"));
  }
  ExpectNothingLeft();
}

TEST_F(ClusterTest, TheServerSaysWhomItWaitsForAndWorkersTooInAnyOrder)
{
  ChildProcess engine = StartEngine("patient", 0);
  EXPECT_TRUE(engine.WaitForOutput("waiting for the space server of 'patient' in domain " + DomainText()));
  ChildProcess server = StartServer(WriteExperiment("patient", 1, 20), {"--controller-hosts", "2"});
  EXPECT_TRUE(server.WaitForOutput("waiting for controller host 0, controller host 1 ")) << server.Output();
  ChildProcess first = StartHost("patient", 0);
  EXPECT_TRUE(engine.WaitForOutput("waiting for 1 of 2 controller hosts")) << engine.Output();
  ChildProcess second = StartHost("patient", 1);
  EXPECT_EQ(server.Wait(), 0) << server.Output();
}

TEST_F(ClusterTest, AStoppedWorkerIsNamedAfterTwoSecondsAndTheRunGoesOnWhenItDoes)
{
  // Paused, it holds no lock of the memory that it shares with the others when it is stopped.
  ChildProcess server = StartServer(WriteExperiment("stalled", 1, 300), {"--paused", "--lease", "30"});
  ChildProcess engine = Start("engine_worker", {"--experiment", "stalled", "--engine", "e0", "--lease", "30"});
  ChildProcess host = Start("controller_host", {"--experiment", "stalled", "--lease", "30"});
  ASSERT_TRUE(server.WaitForOutput("paused at tick 0")) << server.Output();
  ASSERT_TRUE(host.StopAsleep());
  ASSERT_TRUE(Ask("stalled", "resume")) << server.Output();
  EXPECT_TRUE(server.WaitForOutput("waiting for controller host 0 since 2 s")) << server.Output();
  host.Signal(SIGCONT);
  EXPECT_EQ(server.Wait(), 0) << server.Output();
}

TEST_F(ClusterTest, AWorkerOfAnotherProtocolIsRefusedByName)
{
  ChildProcess server = StartServer(WriteExperiment("strict", 1, 10));
  BusOptions options;
  options.domain = domain_.Id();
  Bus bus(options, "engine 'e0'");
  std::mutex mutex;
  std::uint64_t run = 0;
  std::string refusal;
  Publisher<JoinMessage> joins(bus, "strict");
  Subscription<LeaveMessage> leaves(bus, "strict",
                                    [&](const LeaveMessage& leave)
                                    {
                                      const std::lock_guard lock(mutex);
                                      if (leave.process == ProcessId()) refusal = leave.error;
                                    });
  Subscription<WorldMessage> worlds(bus, "strict",
                                    [&](const WorldMessage& world)
                                    {
                                      const std::lock_guard lock(mutex);
                                      run = world.run;
                                    });
  const auto refused = [&]
  {
    const std::lock_guard lock(mutex);
    return !refusal.empty();
  };
  const auto asked = [&]
  {
    std::uint64_t of = 0;
    {
      const std::lock_guard lock(mutex);
      of = run;
    }
    if (of != 0) joins.Write({ProcessId(), kProtocolVersion + 1, of, "engine 'e0'", false});
    return Eventually(refused, 500ms);
  };
  EXPECT_TRUE(Eventually(asked));
  const std::lock_guard lock(mutex);
  EXPECT_THAT(refusal, AllOf(HasSubstr("engine 'e0'"), HasSubstr(fmt::format("version {}", kProtocolVersion + 1)),
                             HasSubstr(fmt::format("version {}", kProtocolVersion))));
  EXPECT_THAT(server.Output(), HasSubstr("refused: engine 'e0'"));
}

TEST_F(ClusterTest, AWorkerThatLeavesBeforeTheLastTickEndsTheRunAndIsNamed)
{
  ChildProcess server = StartServer(WriteExperiment("deserted", 1, 0));
  BusOptions options;
  options.domain = domain_.Id();
  Bus bus(options, "engine 'e0'");
  std::atomic<std::uint64_t> run = 0;
  const Subscription<WorldMessage> worlds(bus, "deserted", [&](const WorldMessage& world) { run = world.run; });
  ASSERT_TRUE(server.WaitForOutput("waiting for")) << server.Output();
  ASSERT_TRUE(Eventually([&] { return run != 0; })) << server.Output();
  Publisher<JoinMessage> joins(bus, "deserted");
  joins.Write({ProcessId(), kProtocolVersion, run, "engine 'e0'", true});
  Publisher<LeaveMessage> leaves(bus, "deserted");
  leaves.Write({run, 0, "engine 'e0'", ProcessId(), ""});
  EXPECT_EQ(server.Wait(), 6);
  EXPECT_THAT(server.Output(), HasSubstr("engine 'e0' has left before the last tick"));
}

TEST_F(ClusterTest, AWorkerRefusesAServerOfAnotherProtocol)
{
  BusOptions options;
  options.domain = domain_.Id();
  options.insecure = true;
  options_ = {"--insecure"};
  Bus bus(options, "space server");
  for (const std::uint32_t version : {kProtocolVersion - 1, kProtocolVersion + 1})
  {
    const std::string experiment = fmt::format("of_version_{}", version);
    Publisher<WorldMessage> worlds(bus, experiment);
    WorldMessage world;
    world.protocol = version;
    world.run = 1;
    world.experiment = experiment;
    worlds.Write(world);
    ChildProcess engine = StartEngine(experiment, 0);
    EXPECT_EQ(engine.Wait(), 4);
    EXPECT_THAT(engine.Output(),
                AllOf(HasSubstr("'" + experiment + "'"), HasSubstr(fmt::format("speaks protocol version {}", version)),
                      HasSubstr(fmt::format("this program version {}", kProtocolVersion))));
  }
}

TEST_F(ClusterTest, AnEngineThatTheExperimentLacksEndsTheRunWithTheKnownOnes)
{
  ChildProcess server = StartServer(WriteExperiment("lacking", 2, 10));
  ChildProcess engine = StartEngine("lacking", 5);
  EXPECT_EQ(engine.Wait(), 3);
  EXPECT_THAT(engine.Output(), HasSubstr("has no engine 'e5'; it has 'e0', 'e1'"));
}

}  // namespace
}  // namespace swarmanoid
