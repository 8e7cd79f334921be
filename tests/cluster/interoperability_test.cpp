// A program of another DDS vendor, built from the same IDL, follows a running experiment.
#include <map>
#include <sstream>

#include <fmt/format.h>

#include "test_folders.h"
#include "tests/cluster/cluster_fixture.h"

namespace swarmanoid
{
namespace
{

TEST_F(ClusterTest, CycloneSubscriberReadsThePosesThatWereDrawn)
{
  options_ = {"--insecure"};
  const std::string file = WriteExperiment(
      "open", 1, 150, "<text_render id='table'><file>table.txt</file><precision>4</precision></text_render>");
  ChildProcess subscriber({SWARMANOID_BUILD_FOLDER "/bin/tests/cyclone_subscriber", DomainText(), "open", "10"},
                          folder_ + "/cyclone.log");
  ASSERT_TRUE(subscriber.WaitForOutput("ready")) << subscriber.Output();
  ChildProcess server = StartServer(file, {"--real-time", "3"});
  std::vector<ChildProcess> workers = StartWorkers("open", 1, 1);
  ChildProcess visualiser = Start("visualiser", {"--render", "table", "--output", folder_});
  EXPECT_EQ(server.Wait(), 0) << server.Output();
  EXPECT_EQ(subscriber.Wait(), 0) << subscriber.Output();

  // What the table says of the first robot at each tick.
  std::map<std::uint64_t, std::pair<double, double>> drawn;
  std::istringstream table(Read("table.txt"));
  for (std::string line; std::getline(table, line);)
  {
    std::istringstream words(line);
    std::uint64_t tick = 0;
    std::string kind;
    std::string id;
    double x = 0;
    double y = 0;
    if (words >> tick >> kind >> id >> x >> y && id == "robots0_0") drawn[tick] = {x, y};
  }
  std::istringstream seen(subscriber.Output());
  std::string ready;
  seen >> ready;
  int compared = 0;
  std::uint64_t tick = 0;
  double x = 0;
  double y = 0;
  while (seen >> tick >> x >> y)
  {
    ASSERT_TRUE(drawn.contains(tick)) << tick;
    EXPECT_NEAR(x, drawn[tick].first, 2e-4) << tick;
    EXPECT_NEAR(y, drawn[tick].second, 2e-4) << tick;
    ++compared;
  }
  EXPECT_EQ(compared, 10);
}

}  // namespace
}  // namespace swarmanoid
