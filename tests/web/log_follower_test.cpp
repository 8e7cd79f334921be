#include "visualiser/web/log_follower.h"

#include <gmock/gmock.h>

#include <fstream>
#include <vector>

#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::IsEmpty;

class LogFollowerTest : public testing::Test
{
protected:
  void Append(const std::string& name, const std::string& text)
  {
    std::ofstream(folder_ / name, std::ios::app | std::ios::binary) << text;
  }
  std::vector<std::string> Lines(LogFollower& follower)
  {
    std::vector<std::string> lines;
    follower.Read([&](const std::string& process, const std::string& line) { lines.push_back(process + ": " + line); });
    return lines;
  }

  test::TemporaryFolder folder_;
};

TEST_F(LogFollowerTest, WholeLinesComeOnceAndOnlyFromLogs)
{
  Append("manifest.json", "{}\n");
  LogFollower follower(folder_);
  Append("engine_ground.log", "one\ntwo\nthr");
  Append("positions.txt", "1 2 3\n");
  EXPECT_THAT(Lines(follower), ElementsAre("engine_ground: one", "engine_ground: two"));
  EXPECT_THAT(Lines(follower), IsEmpty());
  Append("engine_ground.log", "ee\n");
  EXPECT_THAT(Lines(follower), ElementsAre("engine_ground: three"));
}

TEST_F(LogFollowerTest, OfALogThatGrowsFastTheMiddleIsLeftOut)
{
  Append("manifest.json", "{}\n");
  LogFollower follower(folder_);
  Append("host.log", "first\n" + std::string(100000, '.') + "\nlast\n");
  const std::vector<std::string> lines = Lines(follower);
  ASSERT_THAT(lines, testing::SizeIs(2));
  EXPECT_THAT(lines[0], testing::HasSubstr("left out"));
  EXPECT_EQ(lines[1], "host: last");
}

TEST_F(LogFollowerTest, FoldersThatAreNoRunsAreLeftAlone)
{
  LogFollower follower(folder_);
  Append("private.log", "secret\n");
  EXPECT_THAT(Lines(follower), IsEmpty());
}

}  // namespace
}  // namespace swarmanoid
