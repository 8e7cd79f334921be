// The requests of users to a running experiment.
#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include <fmt/format.h>

#include "common/bus/membership/control_client.h"
#include "tests/cluster/cluster_fixture.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using testing::HasSubstr;

class ControlTest : public ClusterTest
{
protected:
  // A run without end, paused at tick 0 or running, with a client that asks.
  void Begin(const std::vector<std::string>& options)
  {
    const std::string file = WriteExperiment("controlled", 1, 0);
    std::vector<std::string> all = options;
    all.insert(all.end(), {"--hash-log", folder_ + "/hashes.txt"});
    server_.emplace(StartServer(file, all));
    workers_ = StartWorkers("controlled", 1, 1);
    BusOptions bus;
    bus.domain = domain_.Id();
    bus_.emplace(bus, "test");
    client_.emplace(*bus_, "controlled");
  }

  ControlReplyMessage Ask(const ControlOrder& order)
  {
    const auto reply = client_->Ask(order, 20);
    EXPECT_TRUE(reply.has_value()) << order.verb << "\n" << server_->Output();
    return reply.value_or(ControlReplyMessage{});
  }
  ControlReplyMessage Ask(const std::string& words) { return Ask(OrderOf(words)); }

  void ExpectEnd()
  {
    EXPECT_TRUE(Ask("stop").ok);
    EXPECT_EQ(server_->Wait(), 0) << server_->Output();
    for (ChildProcess& worker : workers_) EXPECT_EQ(worker.Wait(), 0) << worker.Output();
    ExpectNothingLeft();
  }

  std::optional<ChildProcess> server_;
  std::vector<ChildProcess> workers_;
  std::optional<Bus> bus_;
  std::optional<ControlClient> client_;
};

TEST_F(ControlTest, StepsPausesAndResumes)
{
  Begin({"--paused"});
  const ControlReplyMessage step = Ask("step 7");
  EXPECT_TRUE(step.ok) << step.text;
  EXPECT_EQ(step.tick, 7U);
  EXPECT_EQ(Ask("step").tick, 8U);
  ControlReplyMessage pause = step;
  for (int k = 0; k < 1000 && pause.tick <= 8; ++k)
  {
    EXPECT_TRUE(Ask("resume").ok);
    pause = Ask("pause");
  }
  EXPECT_GT(pause.tick, 8U);
  EXPECT_EQ(Ask("pause").tick, pause.tick);
  ExpectEnd();
}

TEST_F(ControlTest, AStepIsWaitedForAsLongAsTheRunGetsOn)
{
  Begin({"--paused", "--real-time", "1"});
  const auto step = client_->Ask(OrderOf("step 25"), 1);
  ASSERT_TRUE(step.has_value());
  EXPECT_EQ(step->tick, 25U);
  ExpectEnd();
}

TEST_F(ControlTest, KeepsTheAskedPace)
{
  Begin({"--paused", "--real-time", "2"});
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(Ask("step 20").tick, 20U);
  // At twice real time, 19 or 20 intervals of 100 ms pass.
  EXPECT_GT(std::chrono::steady_clock::now() - start, 900ms);
  EXPECT_TRUE(Ask("speed 0").ok);
  EXPECT_EQ(Ask("step 20").tick, 40U);
  EXPECT_FALSE(Ask({"speed", {{"factor", -1.0}}}).ok);
  ExpectEnd();
}

TEST_F(ControlTest, MovesARobotAndRefusesImpossibleRequestsWithAReason)
{
  Begin({"--paused"});
  EXPECT_TRUE(Ask("move robots0_3 1.5,1.25,0,0,0,90").ok);
  EXPECT_THAT(Ask("move absent 1,1,0").text, HasSubstr("no entity 'absent'"));
  EXPECT_THAT(Ask("move wall_0 1,1,0").text, HasSubstr("'wall_0' cannot move"));
  EXPECT_THAT(Ask("move robots0_3 1,5,0").text, HasSubstr("outside the arena"));
  EXPECT_THAT(Ask({"move", {{"entity", "robots0_3"}, {"pose", std::vector<double>{1, 1}}}}).text, HasSubstr("X,Y,Z"));
  EXPECT_THAT(Ask({"step", {{"ticks", 0.5}}}).text, HasSubstr("no number of ticks"));
  EXPECT_THAT(Ask(ControlOrder{"jump"}).text, HasSubstr("pause, resume, step"));

  ChildProcess text = Start("visualiser", {"--attach", "text", "file=moved.txt", "--output", folder_});
  Ask("step 1");
  // It moved on from where it was put, along the heading it was given.
  const std::string place = "Footbot\trobots0_3\t1.5\t1.26\t";
  EXPECT_TRUE(Eventually([&] { return Read("moved.txt").find(place) != std::string::npos; })) << Read("moved.txt");
  ExpectEnd();
  EXPECT_EQ(text.Wait(), 0) << text.Output();
}

TEST_F(ControlTest, ALateVisualiserSeesAPausedWorldAtOnce)
{
  Begin({"--paused"});
  Ask("step 5");
  ChildProcess text = Start("visualiser", {"--attach", "text", "--experiment", "controlled"});
  EXPECT_TRUE(text.WaitForOutput("robots0_11")) << text.Output();
  EXPECT_THAT(text.Output(), HasSubstr("5\t\tFootbot\trobots0_11"));
  ExpectEnd();
  EXPECT_EQ(text.Wait(), 0) << text.Output();
}

TEST_F(ControlTest, APausedRunSendsWhatItsUserChanged)
{
  Begin({"--paused"});
  Ask("step 5");
  std::atomic<int> views = 0;
  std::atomic<bool> moved = false;
  const Subscription<ViewMessage> seen(*bus_, "controlled",
                                       [&](const ViewMessage& view)
                                       {
                                         const std::vector<double>& poses = view.snapshot.poses;
                                         const std::size_t count = poses.size() / 7;  // all x, then all y
                                         for (std::size_t k = 0; k < count; ++k)
                                           moved = moved || (poses[k] == 1.5 && poses[count + k] == 1.25);
                                         ++views;
                                       });
  // Once all processes have matched, nothing is sent: nothing changes.
  int before = -1;
  ASSERT_TRUE(Eventually(
      [&]
      {
        before = views;
        std::this_thread::sleep_for(2s);
        return before > 0 && views == before;
      }));
  EXPECT_FALSE(moved);
  EXPECT_TRUE(Ask("move robots0_3 1.5,1.25,0").ok);
  EXPECT_TRUE(Eventually([&] { return views > before && moved; }));
  ExpectEnd();
}

TEST_F(ControlTest, AStoppedOrKilledVisualiserDoesNotSlowTheRun)
{
  Begin({"--paused"});
  ChildProcess stopped = Start("visualiser", {"--attach", "text", "file=stopped.txt", "--output", folder_});
  ChildProcess killed = Start("visualiser", {"--attach", "text", "file=killed.txt", "--output", folder_});
  Ask("step 5");
  const auto both_see = [this]
  {
    return Read("stopped.txt").find("robots0_11") < std::string::npos &&
           Read("killed.txt").find("robots0_11") < std::string::npos;
  };
  ASSERT_TRUE(Eventually(both_see));
  stopped.Signal(SIGSTOP);
  killed.Signal(SIGKILL);
  // A stopped process would hold it up for ever.
  EXPECT_EQ(Ask("step 3000").tick, 3005U);
  ExpectEnd();
}

TEST_F(ControlTest, AnInterruptStopsAtTheEndOfATickAndKeepsTheOutput)
{
  Begin({"--real-time", "10"});
  ASSERT_TRUE(Reaches(3)) << server_->Output();
  server_->Signal(SIGINT);
  EXPECT_EQ(server_->Wait(), 130) << server_->Output();
  EXPECT_THAT(server_->Output(), HasSubstr("finished: "));
  for (ChildProcess& worker : workers_) EXPECT_EQ(worker.Wait(), 0) << worker.Output();
  ExpectNothingLeft();
}

}  // namespace
}  // namespace swarmanoid
