// Workers on a machine that is offered: which are started, what is told of them, and when they are killed.
#include "common/bus/offered_workers.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <csignal>

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// Processes that do what a test says.
class ScriptedSpawner : public ProcessSpawner
{
public:
  struct Process
  {
    ProcessCommand command;
    FileDescriptor output, errors, lives;  // the ends that it writes, and one that closes with it
    ProcessEnd end{};
    std::vector<int> signals{};
  };

  SpawnedProcess Start(const ProcessCommand& command) override
  {
    Pipe output = MakePipe(), errors = MakePipe(), lives = MakePipe();
    processes.push_back({command, std::move(output.write), std::move(errors.write), std::move(lives.write)});
    return {static_cast<pid_t>(processes.size()), std::move(output.read), std::move(errors.read), std::move(lives.read),
            nullptr};
  }
  ProcessEnd Collect(const SpawnedProcess& process) override { return Of(process).end; }
  void Signal(const SpawnedProcess& process, int signal) override
  {
    Of(process).signals.push_back(signal);
    if (signal == SIGKILL) End(static_cast<std::size_t>(process.pid) - 1, {0, SIGKILL});
  }
  void End(std::size_t number, const ProcessEnd& end)
  {
    processes[number].end = end;
    for (FileDescriptor* open : {&processes[number].output, &processes[number].errors, &processes[number].lives})
      open->Reset();
  }
  void Write(std::size_t number, const std::string& text)
  {
    EXPECT_EQ(write(processes[number].output.Get(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }

  std::vector<Process> processes;

private:
  Process& Of(const SpawnedProcess& process) { return processes[static_cast<std::size_t>(process.pid) - 1]; }
};

class OfferedWorkersTest : public testing::Test
{
protected:
  OfferedWorkersTest()
  {
    BusOptions bus;
    bus.domain = 7;
    bus.key_file = "/x/run.key";
    workers_ = std::make_unique<OfferedWorkers>(
        OfferedWorkers::Setup{"beta", "e", "host:1", "/programs", bus,
                              [this](const WorkerReportMessage& report) { reports_.push_back(report); },
                              [this](const std::string& text) { said_ += text + "\n"; }},
        spawner_);
    workers_->FollowRun(5);
  }

  static WorkerRequestMessage Request(const std::string& client = "host:2", unsigned incarnation = 1)
  {
    WorkerRequestMessage request;
    request.client = client;
    request.run = 5;
    request.machine = "beta";
    request.program = "controller_host";
    request.words = {"--host",    "1",   "--experiment", "e", "--incarnation", std::to_string(incarnation),
                     "--machine", "beta"};
    request.step_timeout_s = 2.5;
    return request;
  }
  void ExpectRefused(const WorkerRequestMessage& request, const std::string& why)
  {
    workers_->Take(request);
    ASSERT_FALSE(reports_.empty());
    EXPECT_THAT(reports_.back().refusal, HasSubstr(why));
    EXPECT_TRUE(reports_.back().ended);
    EXPECT_THAT(spawner_.processes, IsEmpty());
    EXPECT_FALSE(workers_->Any());
  }
  static std::string TextOf(const std::vector<char>& bytes) { return {bytes.begin(), bytes.end()}; }
  // Somebody looks all the time, for so long.
  void Pass(std::chrono::milliseconds time)
  {
    for (const auto until = now_ + time; now_ < until; now_ += 50ms) workers_->Work(now_);
  }

  ScriptedSpawner spawner_;
  std::vector<WorkerReportMessage> reports_;
  std::string said_;
  OfferedWorkers::Clock::time_point now_;
  std::unique_ptr<OfferedWorkers> workers_;
};

TEST_F(OfferedWorkersTest, StartTheProgramOfThisMachineWithItsNetworkAndKey)
{
  workers_->Take(Request());
  ASSERT_EQ(spawner_.processes.size(), 1U);
  const ProcessCommand& command = spawner_.processes[0].command;
  EXPECT_THAT(command.arguments,
              ElementsAre("/programs/controller_host", "--host", "1", "--experiment", "e", "--incarnation", "1",
                          "--machine", "beta", "--domain", "7", "--key", "/x/run.key"));
  EXPECT_THAT(command.environment, ElementsAre(std::pair<std::string, std::string>("SWARMANOID_STEP_TIMEOUT", "2.5")));
  EXPECT_THAT(said_, HasSubstr("controller host 1 is process 1 here"));
  // Said again, it is started once.
  workers_->Take(Request());
  EXPECT_EQ(spawner_.processes.size(), 1U);
}

TEST_F(OfferedWorkersTest, StartNothingElse)
{
  WorkerRequestMessage request = Request();
  request.program = "/bin/sh";
  ExpectRefused(request, "'/bin/sh' is not started there; engine_worker and controller_host are");
  request = Request("host:3");
  request.words.insert(request.words.end(), {"--key", "/etc/passwd"});
  ExpectRefused(request, "--key");
  request = Request("host:4");
  request.words.insert(request.words.end(), {"--offer", "gamma"});
  ExpectRefused(request, "--offer");
  request = Request("host:5");
  request.words[3] = "another";
  ExpectRefused(request, "it must take a place in the run of 'e' on 'beta'");
  // One that does not take a place, and one whose worker was somewhere else of that name.
  ExpectRefused(Request("host:6", 0), "it must take a place");
  request = Request("host:7");
  request.taken = 3;
  ExpectRefused(request, "the one who offered it before has gone");

  const std::size_t before = reports_.size();
  request = Request("host:8");
  request.run = 4;
  workers_->Take(request);
  request = Request("host:8");
  request.machine = "gamma";
  workers_->Take(request);
  EXPECT_EQ(reports_.size(), before);
  EXPECT_THAT(spawner_.processes, IsEmpty());
}

TEST_F(OfferedWorkersTest, TellWhatIsWrittenOnceItWasTakenAndHowItEnded)
{
  WorkerRequestMessage request = Request();
  workers_->Take(request);
  spawner_.Write(0, "one\n");
  workers_->Work(now_);
  EXPECT_EQ(reports_.back().number, 1U);
  EXPECT_EQ(TextOf(reports_.back().output), "one\n");
  spawner_.Write(0, "two\n");
  workers_->Work(now_);
  workers_->Take(request);  // it may not have come
  EXPECT_EQ(TextOf(reports_.back().output), "one\n");
  request.taken = 1;
  workers_->Take(request);
  EXPECT_EQ(TextOf(reports_.back().output), "two\n");

  spawner_.Write(0, std::string(20'000, 'x'));
  spawner_.End(0, {3, 0});
  request.taken = 2;
  workers_->Take(request);
  EXPECT_EQ(reports_.back().output.size(), 16'384U);
  EXPECT_FALSE(reports_.back().ended);
  request.taken = 3;
  workers_->Take(request);
  EXPECT_EQ(reports_.back().output.size(), 20'000U - 16'384U);
  EXPECT_TRUE(reports_.back().ended);
  EXPECT_EQ(reports_.back().exit_code, 3U);
  EXPECT_TRUE(workers_->Any());
  request.taken = 4;
  workers_->Take(request);
  EXPECT_FALSE(workers_->Any());
  // Once more on its way: nobody begins anew.
  workers_->Take(request);
  request.taken = 0;
  workers_->Take(request);
  EXPECT_EQ(spawner_.processes.size(), 1U);
}

TEST_F(OfferedWorkersTest, HandSignalsOnOnce)
{
  WorkerRequestMessage request = Request();
  workers_->Take(request);
  request.signal = SIGTERM;
  workers_->Take(request);
  workers_->Take(request);
  EXPECT_THAT(spawner_.processes[0].signals, ElementsAre(SIGTERM));
}

TEST_F(OfferedWorkersTest, KillThoseWhomNobodyWantsAnyMore)
{
  workers_->Take(Request());
  Pass(kSilence - 200ms);
  EXPECT_TRUE(workers_->Any());
  workers_->Take(Request());
  Pass(kSilence - 500ms);
  EXPECT_TRUE(workers_->Any());
  // A computer that stood still is not silent.
  now_ += 1h;
  workers_->Work(now_);
  EXPECT_TRUE(workers_->Any());
  Pass(1s);
  EXPECT_FALSE(workers_->Any());
  EXPECT_THAT(spawner_.processes[0].signals, Contains(SIGKILL));
  // Who comes back gets no other one.
  workers_->Take(Request());
  EXPECT_EQ(spawner_.processes.size(), 1U);
}

TEST_F(OfferedWorkersTest, ASuccessorEndsTheOneBefore)
{
  workers_->Take(Request());
  WorkerRequestMessage other = Request("host:9");
  other.words[1] = "2";
  workers_->Take(other);
  workers_->Take(Request("host:3", 2));
  ASSERT_EQ(spawner_.processes.size(), 3U);
  EXPECT_THAT(spawner_.processes[0].signals, ElementsAre(SIGKILL));
  EXPECT_THAT(spawner_.processes[1].signals, IsEmpty());
  EXPECT_THAT(said_, HasSubstr("is killed: another one takes its place"));
  workers_->EndAll();
  EXPECT_THAT(spawner_.processes[2].signals, ElementsAre(SIGKILL));
}

// What a worker of another machine said of itself, for those who read the page of the process that stands for it.
TEST(ActivityPageOfOther, IsTakenIfItIsOne)
{
  ActivityPage page{};
  page.magic = ActivityPage::kMagic;
  page.taken = 1;
  page.tick = 17;
  page.kind = Actor::kRobot;
  page.number = 3;
  page.step = static_cast<std::uint32_t>(ActivityStep::kControlStep);
  std::vector<char> bytes = BytesOfPage(page);
  EXPECT_TRUE(TakePageOfOther(bytes));
  EXPECT_EQ(OwnActivityPage().tick, 17U);
  EXPECT_EQ(OwnActivityPage().number, 3U);
  page.tick = 18;
  page.step = 77;
  EXPECT_FALSE(TakePageOfOther(BytesOfPage(page)));
  bytes.pop_back();
  EXPECT_FALSE(TakePageOfOther(bytes));
  EXPECT_FALSE(TakePageOfOther({}));
  EXPECT_EQ(OwnActivityPage().tick, 17U);
}

}  // namespace
}  // namespace swarmanoid
