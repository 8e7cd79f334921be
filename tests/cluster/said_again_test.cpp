// Who has not heard what was said once at the start hears it again.
#include <atomic>

#include "common/bus/bus.h"
#include "common/bus/topics/session_messages.h"
#include "tests/cluster/cluster_fixture.h"

namespace swarmanoid
{
namespace
{

TEST_F(ClusterTest, WhatIsSaidAtTheStartIsSaidAgainUntilTheRunBegins)
{
  options_ = {"--insecure"};
  const std::string file = WriteExperiment(
      "again", 1, 20, "<text_render id='table'><file>table.txt</file><precision>4</precision></text_render>");
  BusOptions options;
  options.domain = domain_.Id();
  options.insecure = true;
  Bus bus(options, "a listener");
  std::atomic<int> worlds = 0, of_engine = 0, of_host = 0;
  const Subscription<WorldMessage> world(bus, "again", [&](const WorldMessage&) { ++worlds; });
  const Subscription<JoinMessage> joins(bus, "again",
                                        [&](const JoinMessage& join)
                                        {
                                          if (join.ready) ++(join.name == "controller host 0" ? of_host : of_engine);
                                        });
  ChildProcess server = StartServer(file);
  // The visualiser is missing: engine and host are ready, and wait.
  std::vector<ChildProcess> workers = StartWorkers("again", 1, 1);
  EXPECT_TRUE(Eventually([&] { return worlds >= 2 && of_engine >= 3 && of_host >= 3; }));
  ChildProcess visualiser = Start("visualiser", {"--render", "table", "--output", folder_});
  EXPECT_EQ(server.Wait(), 0) << server.Output();
  EXPECT_EQ(visualiser.Wait(), 0) << visualiser.Output();
}

}  // namespace
}  // namespace swarmanoid
