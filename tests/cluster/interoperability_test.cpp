// A program of another DDS vendor, built from the same IDL, follows a running experiment.
#include <atomic>
#include <map>
#include <sstream>

#include "common/bus/membership/control_client.h"
#include "common/run/access/access_grant.h"
#include "test_folders.h"
#include "tests/cluster/cluster_fixture.h"

namespace swarmanoid
{
namespace
{

// Compares the table's values of the first robot at each tick with those that the subscriber received.
void ExpectSeenAsDrawn(const std::string& table, const std::string& seen, int count)
{
  std::map<std::uint64_t, std::pair<double, double>> drawn;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);)
  {
    std::istringstream words(line);
    std::uint64_t tick = 0;
    std::string kind;
    std::string id;
    double x = 0;
    double y = 0;
    if (words >> tick >> kind >> id >> x >> y && id == "robots0_0") drawn[tick] = {x, y};
  }
  std::istringstream samples(seen);
  std::string ready;
  samples >> ready;
  int compared = 0;
  std::uint64_t tick = 0;
  double x = 0;
  double y = 0;
  while (samples >> tick >> x >> y)
  {
    ASSERT_TRUE(drawn.contains(tick)) << tick;
    EXPECT_NEAR(x, drawn[tick].first, 2e-4) << tick;
    EXPECT_NEAR(y, drawn[tick].second, 2e-4) << tick;
    ++compared;
  }
  EXPECT_EQ(compared, count);
}

constexpr const char* kTable = "<text_render id='table'><file>table.txt</file><precision>4</precision></text_render>";

TEST_F(ClusterTest, CycloneSubscriberReadsThePosesThatWereDrawn)
{
  options_ = {"--insecure"};
  const std::string file = WriteExperiment("open", 1, 150, kTable);
  ChildProcess subscriber({SWARMANOID_BUILD_FOLDER "/bin/tests/cyclone_subscriber", DomainText(), "open", "10"},
                          folder_ + "/cyclone.log");
  ASSERT_TRUE(subscriber.WaitForOutput("ready")) << subscriber.Output();
  ChildProcess server = StartServer(file, {"--real-time", "3"});
  std::vector<ChildProcess> workers = StartWorkers("open", 1, 1);
  ChildProcess visualiser = Start("visualiser", {"--render", "table", "--output", folder_});
  EXPECT_EQ(server.Wait(), 0) << server.Output();
  EXPECT_EQ(subscriber.Wait(), 0) << subscriber.Output();
  ExpectSeenAsDrawn(Read("table.txt"), subscriber.Output(), 10);
}

// The run has a key. An open view lets every program read it, and none write to it.
TEST_F(ClusterTest, CycloneSubscriberReadsAnOpenView)
{
  const std::string file = WriteExperiment("looked_at", 1, 100000, kTable);
  ChildProcess server = StartServer(file, {"--real-time", "3"});
  std::vector<ChildProcess> workers = StartWorkers("looked_at", 1, 1);
  ChildProcess visualiser = Start("visualiser", {"--render", "table", "--output", folder_});
  ASSERT_TRUE(server.WaitForOutput("running")) << server.Output();
  BusOptions of_stranger;
  of_stranger.domain = domain_.Id();
  Bus bus(of_stranger, "test");
  ControlClient member(bus, "looked_at");
  of_stranger.insecure = true;
  Bus stranger(of_stranger, "stranger");
  const GrantChannel channel{kOpenChannel, std::nullopt};
  const Publisher<ControlRequestMessage> requests(stranger, "looked_at", channel);
  const Publisher<ViewRequestMessage> view_requests(stranger, "looked_at", channel);
  std::atomic<std::uint64_t> seen = 0;
  Subscription<ViewMessage> views(
      stranger, "looked_at", [&](const ViewMessage& view) { seen = view.snapshot.tick; }, channel);
  const Subscription<ViewMessage> of_members(stranger, "looked_at", [](const ViewMessage&) { ADD_FAILURE(); });

  const auto made = member.Ask(OrderOf("share 0000000a open 0"), kGenerous_s);
  ASSERT_TRUE(made && made->ok) << server.Output();
  ChildProcess subscriber(
      {SWARMANOID_BUILD_FOLDER "/bin/tests/cyclone_subscriber", DomainText(), "looked_at", "10", "open"},
      folder_ + "/cyclone.log");
  EXPECT_EQ(subscriber.Wait(), 0) << subscriber.Output() << server.Output();
  ASSERT_TRUE(Eventually([&] { return seen > 0; }));
  EXPECT_EQ(requests.Readers(), 0u);
  EXPECT_EQ(view_requests.Readers(), 0u);
  const auto second = member.Ask(OrderOf("share 0000000b open 0"), kGenerous_s);
  ASSERT_TRUE(second.has_value());
  EXPECT_EQ(std::pair(second->ok, second->text),
            std::pair(false, std::string("the run has an open view already: 0000000a")));

  const auto revoked = member.Ask(OrderOf("revoke 0000000a"), kGenerous_s);
  ASSERT_TRUE(revoked && revoked->ok);
  ASSERT_TRUE(Eventually([&] { return views.Writers() == 0; }));
  const auto stopped = member.Ask({"stop"}, kGenerous_s);
  ASSERT_TRUE(stopped && stopped->ok);
  EXPECT_EQ(server.Wait(), 0) << server.Output();
  for (ChildProcess& worker : workers) EXPECT_EQ(worker.Wait(), 0) << worker.Output();
  EXPECT_EQ(visualiser.Wait(), 0) << visualiser.Output();
  ExpectSeenAsDrawn(Read("table.txt"), subscriber.Output(), 10);
}

}  // namespace
}  // namespace swarmanoid
