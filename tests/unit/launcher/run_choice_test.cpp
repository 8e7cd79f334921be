// Which network a command uses that looks for a run.
#include "launcher/command/run_choice.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "common/bus/bus.h"
#include "common/program/usage_error.h"
#include "common/run/access/access_grant.h"
#include "tests/world/message_of.h"

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

TEST(ChooseRun, ARunOnAnotherMachineIsTheNameAndTheDomainTogether)
{
  const RunChoice there = ChooseRun("no_run_here_has_this_name", 231);
  EXPECT_EQ(there.experiment, "no_run_here_has_this_name");
  EXPECT_EQ(there.domain, 231);
  EXPECT_FALSE(there.server);
  EXPECT_NE(test::MessageOf<UsageError>([] { ChooseRun("", 231); }).find("name the experiment"), std::string::npos);
  EXPECT_THROW(ChooseRun("no_run_here_has_this_name", std::nullopt), UsageError);
}

TEST(RunOf, AnAccessGrantIsForItsExperimentOnly)
{
  AccessToken token;
  token.experiment = "far";
  token.domain = 12;
  for (const char* name : {"", "far"})
  {
    const RunChoice run = RunOf(token, name);
    EXPECT_EQ(run.experiment, "far");
    EXPECT_EQ(run.domain, 12);
    EXPECT_FALSE(run.server);
  }
  EXPECT_NE(test::MessageOf<UsageError>([&] { RunOf(token, "near"); }).find("is of experiment 'far', not of 'near'"),
            std::string::npos);
}

TEST(CheckInsecure, BothSidesHaveAKeyOrNone)
{
  BusOptions secure, insecure;
  insecure.insecure = true;
  RunChoice run = RunHere();
  EXPECT_NO_THROW(CheckInsecure(run, secure));
  EXPECT_NE(test::MessageOf<UsageError>([&] { CheckInsecure(run, insecure); }).find("has a key"), std::string::npos);
  run.lets_anybody_in = true;
  EXPECT_NO_THROW(CheckInsecure(run, insecure));
  EXPECT_NE(test::MessageOf<UsageError>([&] { CheckInsecure(run, secure); }).find("lets anybody in"),
            std::string::npos);
  run.server.reset();
  EXPECT_NO_THROW(CheckInsecure(run, secure)) << "what a run elsewhere has is not known";
}

TEST(UseNetworkOf, LeavesADiscoveryServerThatTheUserNamed)
{
  BusOptions options;
  options.discovery_server = "10.0.0.2:1";
  UseNetworkOf(RunHere(), options);
  EXPECT_EQ(options.discovery_server, "10.0.0.2:1");
  EXPECT_TRUE(options.peers.empty());
}

}  // namespace
}  // namespace swarmanoid
