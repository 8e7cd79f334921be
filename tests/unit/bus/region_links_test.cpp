// The links between a split engine and the processes of its regions: which messages they get, and when they leave.
#include <array>
#include <atomic>
#include <mutex>
#include <thread>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/dds/for_tests.h"
#include "common/bus/membership/region_links.h"
#include "common/bus/membership/worker_session.h"
#include "tests/eventually.h"
#include "tests/unit/bus/server_fixture.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using test::Eventually;

class RegionLinks : public test::ServerFixture
{
protected:
  RegionLinks() : ServerFixture("region_links") {}

  const test::SeparateProcesses separate_;
};

// An engine that is split into two regions, which have done a task of tick 7.
class TwoRegions
{
public:
  TwoRegions(const BusOptions& options, const std::string& folder, WorldMessage world)
      : run_(world.run),
        server_(options, "space server"),
        worlds_(server_, "region_links"),
        leaves_(server_, "region_links"),
        experiment_(SplitInTwo())
  {
    // A process has one folder of a run; these are three.
    world.spread = true;
    worlds_.Write(world);
    listened_.emplace(
        server_, HotScope{"region_links", "", true, limits_.TaskBytes(), 1, "region 1"},
        HotSubscription<RegionTaskMessage>::Handler{[this](const MessageHeader&) { return &arriving_; },
                                                    [this](const MessageHeader&, const RegionTaskMessage& task)
                                                    {
                                                      const std::lock_guard lock(mutex_);
                                                      if (task.number == 0) heard_.push_back(task.bytes);
                                                    },
                                                    {}});
    for (const std::string& name :
         {RegionName(experiment_, 0, 0), RegionName(experiment_, 0, 1), std::string("engine 'ground'")})
    {
      const std::string of_worker = fmt::format("{}/{}", folder, sessions_.size());
      std::filesystem::create_directories(of_worker);
      setenv("SWARMANOID_SHARED_FOLDER", of_worker.c_str(), 1);
      sessions_.push_back(std::make_unique<WorkerSession>(options, "region_links", name));
    }
    for (const unsigned k : {0U, 1U})
      regions_.emplace_back(
          [this, k]
          {
            RegionLink link(*sessions_[k], experiment_, 0, k, limits_);
            Remembers region(tasks_[k]);
            link.Serve(region);
            EXPECT_TRUE(link.IsOver());
            ++left_;
          });
    team_.emplace(*sessions_[2], experiment_, 0, limits_);
    EXPECT_TRUE(Eventually([&] { return team_->Missing() == 0 && listened_->Writers() == 1; }));
    team_->Begin(role_);
    team_->SetTick(7);
    const std::lock_guard lock(role_);
    std::vector<std::vector<char>> results(2);
    const auto work = [&]
    {
      ++works_;
      team_->Work(
          true,
          [](bool, std::span<ByteWriter> tasks)
          {
            for (std::uint32_t k = 0; k < tasks.size(); ++k) tasks[k].Put(k);
          },
          results, [this] { ++meanwhile_; });
    };
    // The engine does not wait until it knows the listener.
    for (work(); works_ < 100 && !test::Eventually([this] { return !Heard().empty(); }, 300ms);) work();
  }

  RegionTeamLink& Team() { return *team_; }
  int Left() const { return left_; }
  // How many tasks all regions have done, and how often the engine did its own work while they had one.
  int Works() const { return works_; }
  int Meanwhile() const { return meanwhile_; }
  // After all regions have left: the last one but that of the end.
  std::uint32_t TaskOf(unsigned region) const { return ByteReader(tasks_[region]).Get<std::uint32_t>(); }
  std::string Name(unsigned region) const { return RegionName(experiment_, 0, region); }
  void SayLeft(std::uint64_t tick, const std::string& name, const std::string& process = ProcessId())
  {
    leaves_.Write({run_, tick, name, process, ""});
  }

  // Returns the messages to region 1.
  std::vector<std::vector<char>> Heard() const
  {
    const std::lock_guard lock(mutex_);
    return heard_;
  }

private:
  struct Remembers : EngineRegion
  {
    explicit Remembers(std::vector<char>& its_task) : last(its_task) {}
    void Work(std::span<const char> task, ByteWriter&) override { last.assign(task.begin(), task.end()); }
    std::vector<char>& last;
  };

  static Experiment SplitInTwo()
  {
    Experiment experiment;
    experiment.arena_size = {10, 10, 1};
    experiment.engines.resize(1);
    experiment.engines[0].id = "ground";
    experiment.engines[0].split.regions = 2;
    return experiment;
  }

  const std::uint64_t run_;
  Bus server_;
  Publisher<WorldMessage> worlds_;
  Publisher<LeaveMessage> leaves_;
  const Experiment experiment_;
  const RegionLimits limits_;
  // Guards heard_.
  mutable std::mutex mutex_;
  std::vector<std::vector<char>> heard_;
  RegionTaskMessage arriving_;
  std::optional<HotSubscription<RegionTaskMessage>> listened_;
  std::vector<std::unique_ptr<WorkerSession>> sessions_;
  std::atomic<int> left_ = 0;
  int works_ = 0, meanwhile_ = 0;
  // RegionTeamLink unlocks it while it waits, as it does with the mutex of an engine worker.
  std::mutex role_;
  std::optional<RegionTeamLink> team_;
  std::array<std::vector<char>, 2> tasks_;
  std::vector<std::jthread> regions_;
};

// A region does not get the tasks of others: over a network each task would take as much as the whole swarm.
TEST_F(RegionLinks, RegionsHearTheirOwnTasksAlone)
{
  TwoRegions two(options_, of_worker_, world_);
  EXPECT_FALSE(two.Heard().empty());
  for (const std::vector<char>& task : two.Heard()) EXPECT_EQ(task, (std::vector<char>{1, 0, 0, 0}));
  EXPECT_EQ(two.Meanwhile(), two.Works());
  EXPECT_EQ(two.Team().Awaited(), "");
  two.Team().End();
  two.SayLeft(8, "engine 'ground'");
  ASSERT_TRUE(Eventually([&] { return two.Left() == 2; }));
  for (const unsigned k : {0U, 1U}) EXPECT_EQ(two.TaskOf(k), k);
}

// The last answer of a region may be lost, and would be lost for good if its process ended.
TEST_F(RegionLinks, RegionsStayUntilTheirEngineHasLeft)
{
  TwoRegions two(options_, of_worker_, world_);
  // The regions stay, however often the engine asks.
  for (int k = 0; k < 3; ++k)
  {
    two.Team().End();
    EXPECT_EQ(two.Team().Awaited(), "") << k;
  }
  // The Leave comes from an earlier process of the engine, which was moved to another machine and replaced.
  two.SayLeft(6, "engine 'ground'", "another:1");
  std::this_thread::sleep_for(200ms);
  EXPECT_EQ(two.Left(), 0);
  two.SayLeft(8, "engine 'ground'");
  EXPECT_TRUE(Eventually([&] { return two.Left() == 2; }));
}

// The engine's Leave may not reach a region that has just matched, and a killed engine seems to be there.
TEST_F(RegionLinks, RegionsDoNotStayForEverForAnEngineThatIsSilent)
{
  TwoRegions two(options_, of_worker_, world_);
  two.Team().End();
  EXPECT_TRUE(Eventually([&] { return two.Left() == 2; }));
}

TEST_F(RegionLinks, AnEngineDoesNotWaitForRegionsThatHaveLeft)
{
  TwoRegions two(options_, of_worker_, world_);
  two.Team().End();
  ASSERT_TRUE(Eventually([&] { return two.Left() == 2; }));
  for (const unsigned k : {0U, 1U}) two.SayLeft(8, two.Name(k));
  two.Team().End();
}

}  // namespace
}  // namespace swarmanoid
