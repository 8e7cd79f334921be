// Which network a command uses that looks for a run.
#include "launcher/run_choice.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "common/bus/bus.h"

namespace swarmanoid
{
namespace
{

const RunNetwork kFar{"eth0", {"alpha"}, "10.0.0.1:21900"};

RunChoice RunHere() { return {.experiment = "far", .domain = 7, .server = getpid(), .network = kFar}; }

TEST(UseNetworkOf, TakesThatOfARunOnThisMachine)
{
  BusOptions options;
  UseNetworkOf(RunHere(), options);
  EXPECT_EQ(options.network_interface, "eth0");
  EXPECT_EQ(options.peers, kFar.peers);
  EXPECT_EQ(options.discovery_server, "10.0.0.1:21900");
}

TEST(UseNetworkOf, LeavesWhatTheUserNamed)
{
  BusOptions options;
  options.network_interface = "all";
  UseNetworkOf(RunHere(), options);
  EXPECT_EQ(options.network_interface, "all");
  EXPECT_TRUE(options.peers.empty());
  options = {};
  options.peers = {"beta"};
  UseNetworkOf(RunHere(), options);
  EXPECT_EQ(options.network_interface, "lo");
}

TEST(UseNetworkOf, KnowsNothingOfARunElsewhere)
{
  RunChoice elsewhere = RunHere();
  elsewhere.server.reset();
  BusOptions options;
  UseNetworkOf(elsewhere, options);
  EXPECT_EQ(options.network_interface, "lo");
}

}  // namespace
}  // namespace swarmanoid
