// Variables that Fast DDS reads for other programs change nothing of a run.
#include "common/bus/dds_environment.h"

#include <gmock/gmock.h>

#include <cstdlib>

#include "tests/eventually.h"
#include "tests/unit/bus/server_fixture.h"

namespace swarmanoid
{
namespace
{

using test::Eventually;
using testing::ElementsAre;

class DdsEnvironmentTest : public test::ServerFixture
{
protected:
  DdsEnvironmentTest() : ServerFixture("dds_environment") {}
  ~DdsEnvironmentTest() override
  {
    for (const std::string& name : DdsVariablesThatAreSet()) unsetenv(name.c_str());
    unsetenv(kKeepDdsVariables);
  }
};

TEST_F(DdsEnvironmentTest, TwoProcessesMeetThoughADiscoveryServerIsNamed)
{
  setenv("ROS_DISCOVERY_SERVER", "127.0.0.1:11811", 1);
  setenv("FASTRTPS_DEFAULT_PROFILES_FILE", "/nonexistent/profiles.xml", 1);
  Bus first(options_, "first");
  Bus second(options_, "second");
  Publisher<StatusMessage> out(first, "dds_environment");
  const Subscription<StatusMessage> in(second, "dds_environment", [](const StatusMessage&) {});
  EXPECT_TRUE(Eventually([&] { return out.Readers() == 1; }));
  // Participants of others in this process find them as they were.
  EXPECT_STREQ(std::getenv("ROS_DISCOVERY_SERVER"), "127.0.0.1:11811");
}

TEST_F(DdsEnvironmentTest, VariablesAreHiddenForAWhileUnlessTheUserKeepsThem)
{
  setenv("ROS_DISCOVERY_SERVER", "127.0.0.1:11811", 1);
  setenv("FASTDDS_STATISTICS", "NETWORK_LATENCY_TOPIC", 1);
  unsetenv("SKIP_DEFAULT_XML");
  EXPECT_THAT(DdsVariablesThatAreSet(), ElementsAre("ROS_DISCOVERY_SERVER", "FASTDDS_STATISTICS"));
  {
    const HiddenDdsVariables hidden;
    EXPECT_THAT(DdsVariablesThatAreSet(), ElementsAre());
  }
  EXPECT_STREQ(std::getenv("FASTDDS_STATISTICS"), "NETWORK_LATENCY_TOPIC");
  setenv(kKeepDdsVariables, "1", 1);
  const HiddenDdsVariables hidden;
  EXPECT_STREQ(std::getenv("ROS_DISCOVERY_SERVER"), "127.0.0.1:11811");
}

}  // namespace
}  // namespace swarmanoid
