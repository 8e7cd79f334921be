// Variables that Fast DDS reads for other programs change nothing of a run.
#include "common/run/access/dds_environment.h"

#include <gmock/gmock.h>

#include <atomic>
#include <cstdlib>
#include <optional>
#include <thread>

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
  setenv("SKIP_DEFAULT_XML", "0", 1);
  EXPECT_THAT(DdsVariablesThatAreSet(), ElementsAre("ROS_DISCOVERY_SERVER", "FASTDDS_STATISTICS"));
  {
    const HiddenDdsVariables hidden;
    EXPECT_THAT(DdsVariablesThatAreSet(), ElementsAre());
    EXPECT_STREQ(std::getenv("SKIP_DEFAULT_XML"), "1");
  }
  EXPECT_STREQ(std::getenv("SKIP_DEFAULT_XML"), "0");
  unsetenv("SKIP_DEFAULT_XML");
  EXPECT_STREQ(std::getenv("FASTDDS_STATISTICS"), "NETWORK_LATENCY_TOPIC");
  setenv(kKeepDdsVariables, "1", 1);
  const HiddenDdsVariables hidden;
  EXPECT_STREQ(std::getenv("ROS_DISCOVERY_SERVER"), "127.0.0.1:11811");
}

// Fast DDS makes one participant at a time. Other threads may read variables meanwhile.
TEST_F(DdsEnvironmentTest, OneThreadAtATimeHidesThemAndChangesNothingWithoutNeed)
{
  std::optional<HiddenDdsVariables> hidden(std::in_place);
  const char* const value = std::getenv("SKIP_DEFAULT_XML");
  std::atomic<bool> other_hides = false;
  std::thread other(
      [&]
      {
        const HiddenDdsVariables theirs;
        other_hides = true;
      });
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_FALSE(other_hides);
  hidden.reset();
  other.join();
  EXPECT_TRUE(other_hides);
  EXPECT_EQ(std::getenv("SKIP_DEFAULT_XML"), value) << "the same place in memory";
}

}  // namespace
}  // namespace swarmanoid
