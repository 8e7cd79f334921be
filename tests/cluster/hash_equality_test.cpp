// The same experiment gives the same state at every tick, in one process and in every cluster.
#include <fmt/format.h>

#include "tests/cluster/cluster_fixture.h"

namespace swarmanoid
{
namespace
{

class HashEquality : public ClusterTest, public testing::WithParamInterface<std::pair<int, int>>
{
};

TEST_P(HashEquality, ClusterHasTheHashesOfASingleProcess)
{
  const auto [engines, hosts] = GetParam();
  const std::string file = WriteExperiment("equal", engines, 150);
  const std::string expected = HashesOfSingleProcess(file);
  ASSERT_EQ(std::count(expected.begin(), expected.end(), '\n'), 151);
  {
    // Workers first: the order of starting does not matter.
    std::vector<ChildProcess> workers = StartWorkers("equal", engines, hosts);
    ChildProcess server =
        StartServer(file, {"--controller-hosts", std::to_string(hosts), "--hash-log", folder_ + "/cluster.txt"});
    EXPECT_EQ(server.Wait(), 0) << server.Output();
    for (ChildProcess& worker : workers) EXPECT_EQ(worker.Wait(), 0) << worker.Output();
    EXPECT_THAT(server.Output(), testing::HasSubstr("finished: 150 ticks, 16 entities, hash "));
  }
  EXPECT_EQ(Read("cluster.txt"), expected);
  ExpectNothingLeft();
}

INSTANTIATE_TEST_SUITE_P(Clusters, HashEquality, testing::Values(std::pair(1, 1), std::pair(2, 4), std::pair(3, 2)),
                         [](const auto& parameters)
                         { return fmt::format("Engines{}Hosts{}", parameters.param.first, parameters.param.second); });

TEST_F(ClusterTest, TwoExperimentsSideBySideDoNotHearEachOther)
{
  const std::string one = WriteExperiment("one", 1, 200);
  const std::string two = WriteExperiment("two", 2, 200);
  const std::string expected_one = HashesOfSingleProcess(one);
  const std::string expected_two = HashesOfSingleProcess(two);
  EXPECT_NE(expected_one, expected_two);
  ChildProcess server_one = StartServer(one, {"--hash-log", folder_ + "/one.txt"});
  ChildProcess server_two = StartServer(two, {"--hash-log", folder_ + "/two.txt"});
  std::vector<ChildProcess> workers_one = StartWorkers("one", 1, 1);
  std::vector<ChildProcess> workers_two = StartWorkers("two", 2, 1);
  EXPECT_EQ(server_one.Wait(), 0) << server_one.Output();
  EXPECT_EQ(server_two.Wait(), 0) << server_two.Output();
  EXPECT_EQ(Read("one.txt"), expected_one);
  EXPECT_EQ(Read("two.txt"), expected_two);
}

TEST_F(ClusterTest, ASecondExperimentOfTheSameNameInTheDomainIsRefused)
{
  const std::string file = WriteExperiment("same", 1, 10);
  ChildProcess first = StartServer(file);
  ASSERT_TRUE(first.WaitForOutput("waiting for"));
  ChildProcess second = StartServer(file);
  EXPECT_EQ(second.Wait(), 4);
  EXPECT_THAT(second.Output(), testing::HasSubstr("experiment 'same' runs already in domain " + DomainText()));
}

TEST_F(ClusterTest, SynchronousVisualiserDrawsEveryTickAndTheHashStaysTheSame)
{
  const std::string file =
      WriteExperiment("drawn", 1, 50, "<text_render id='table'><file>table.txt</file></text_render>");
  const std::string expected = HashesOfSingleProcess(file);
  ChildProcess visualiser = Start("visualiser", {"--render", "table", "--output", folder_});
  std::vector<ChildProcess> workers = StartWorkers("drawn", 1, 1);
  ChildProcess server = StartServer(file, {"--hash-log", folder_ + "/cluster.txt"});
  EXPECT_EQ(server.Wait(), 0) << server.Output();
  EXPECT_EQ(visualiser.Wait(), 0) << visualiser.Output();
  EXPECT_EQ(Read("cluster.txt"), expected);
  const std::string table = Read("table.txt");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 1 + 51 * 16);
}

}  // namespace
}  // namespace swarmanoid
