// The inside of robots at past ticks, from a program that replaces `swarmanoid`.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <mutex>

#include "tests/eventually.h"
#include "tests/unit/visualiser/small_world.h"
#include "tests/world/temporary_folder.h"
#include "visualiser/robot_playback.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;
using test::Eventually;
using testing::HasSubstr;

class RobotPlaybackTest : public testing::Test
{
protected:
  RobotPlaybackTest() : world_({4, 4, 2})
  {
    for (const char* id : {"fb_0", "fb_1"}) world_.Add(EntityKind::kFootbot, id, {1, 1, 0}).controller = "driver";
    world_.Add(EntityKind::kFootbot, "parked", {2, 1, 0});
    setenv(kCommandVariable, (folder_ / "program").c_str(), 1);
  }
  ~RobotPlaybackTest() override { unsetenv(kCommandVariable); }

  // The program gets "inspect RUN@TICK --json -- ID...", and writes its arguments to the file `asked`.
  void Write(const std::string& commands) const
  {
    const std::string asked = folder_ / "asked";
    const fs::path program = folder_.Write("program", "#!/bin/sh\necho \"$*\" >> '" + asked + "'\n" + commands + "\n");
    fs::permissions(program, fs::perms::owner_all);
  }
  std::string Asked() const { return folder_.Read("asked"); }
  std::unique_ptr<RobotPlayback> Make(const std::string& run_folder)
  {
    return std::make_unique<RobotPlayback>(world_.GetExperiment(), run_folder,
                                           [this](std::uint64_t client, const RobotPlaybackAnswer& answer)
                                           {
                                             const std::lock_guard lock(mutex_);
                                             answers_.emplace_back(client, answer);
                                           });
  }
  std::size_t Count()
  {
    const std::lock_guard lock(mutex_);
    return answers_.size();
  }

  const test::TemporaryFolder folder_{"with spaces in"};
  SmallWorld world_;
  // Guards answers_.
  std::mutex mutex_;
  std::vector<std::pair<std::uint64_t, RobotPlaybackAnswer>> answers_;
};

constexpr const char* kRobot =
    R"({"id": "fb_1", "controller": "driver", "state": "TURN", "text": "turns",)"
    R"( "sensors": [{"type": "battery", "readings": [{"name": "left", "unit": "s", "value": null}]}],)"
    R"( "actuators": [{"type": "wheels", "readings": [{"name": "0", "unit": "m/s", "value": 0.25}]}]})";

TEST_F(RobotPlaybackTest, RobotsWithControllersAreAskedForAtTheirTick)
{
  Write(fmt::format("echo '{{\"robots\": [{}]}}'", kRobot));
  const auto inside = Make(folder_.Path());
  ASSERT_TRUE(inside->IsPossible());
  inside->Ask(7, {42, {1, 2, 99}});
  ASSERT_TRUE(Eventually([&] { return Count() == 1; }));
  EXPECT_EQ(Asked(), fmt::format("inspect {}@42 --json -- fb_1\n", folder_.Path()));
  EXPECT_EQ(answers_[0].first, 7u);
  const RobotPlaybackAnswer& answer = answers_[0].second;
  EXPECT_EQ(answer.error, "");
  EXPECT_EQ(answer.tick, 42u);
  ASSERT_EQ(answer.robots.size(), 1u);
  const RobotStatus& robot = answer.robots[0];
  EXPECT_EQ(robot.entity, 1u);
  EXPECT_EQ(robot.tick, 42u);
  EXPECT_EQ(robot.controller + robot.state + robot.text, "driverTURNturns");
  EXPECT_TRUE(std::isnan(robot.sensors.at(0).readings.at(0).value)) << "JSON has no infinity";
  EXPECT_EQ(robot.actuators.at(0).type, "wheels");
  EXPECT_EQ(robot.actuators.at(0).readings.at(0).value, 0.25);
  EXPECT_EQ(robot.actuators.at(0).readings.at(0).unit, "m/s");
}

// The first request is computed for ever. Once another tick is asked for, no client waits for it.
TEST_F(RobotPlaybackTest, OnlyTheNewestTickIsAnswered)
{
  Write(fmt::format("case \"$2\" in *@5) exec sleep 1000;; esac\necho '{{\"robots\": [{}]}}'", kRobot));
  const auto inside = Make(folder_.Path());
  inside->Ask(1, {5, {1}});
  ASSERT_TRUE(Eventually([&] { return Asked().find("@5 ") != std::string::npos; }));
  for (std::uint64_t tick = 6; tick <= 60; ++tick) inside->Ask(1, {tick, {1}});
  ASSERT_TRUE(Eventually([&] { return Count() == 1; }));
  EXPECT_EQ(answers_[0].second.tick, 60u);
  // Nothing is computed for clients that have left, nor for robots without controllers.
  inside->Ask(2, {5, {1}});
  inside->Forget(2);
  inside->Ask(3, {5, {2}});
  inside->Ask(4, {61, {0}});
  ASSERT_TRUE(Eventually([&] { return Count() == 2; }));
  EXPECT_EQ(answers_[1].first, 4u);
}

TEST_F(RobotPlaybackTest, ItsEndIsTheEndOfWhatItComputes)
{
  Write("exec sleep 1000");
  auto inside = Make(folder_.Path());
  inside->Ask(1, {5, {0}});
  ASSERT_TRUE(Eventually([&] { return !Asked().empty(); }));
  inside.reset();
  EXPECT_EQ(Count(), 0u);
}

TEST_F(RobotPlaybackTest, WhyNothingCanBeComputedIsTold)
{
  Write(
      "case \"$2\" in *@1) echo 'robot says hello' >&2; echo 'inspect: made by another build' >&2; exit 4;; esac\n"
      "echo '{\"robots\": [{\"id\": \"nobody\"}]}'");
  const auto inside = Make(folder_.Path());
  inside->Ask(1, {1, {0}});
  ASSERT_TRUE(Eventually([&] { return Count() == 1; }));
  EXPECT_EQ(answers_[0].second.error, "inspect: made by another build");
  inside->Ask(1, {2, {0}});
  ASSERT_TRUE(Eventually([&] { return Count() == 2; }));
  EXPECT_THAT(answers_[1].second.error, HasSubstr("cannot be read"));
  EXPECT_TRUE(answers_[1].second.robots.empty());
}

TEST_F(RobotPlaybackTest, NothingIsComputedOfRunsOfOthers)
{
  Write("echo '{\"robots\": []}'");
  EXPECT_FALSE(Make("/nowhere")->IsPossible());
  if (geteuid() != 0)
  {
    EXPECT_FALSE(Make("/")->IsPossible());
  }
  unsetenv(kCommandVariable);
  EXPECT_FALSE(Make(folder_.Path())->IsPossible());
}

}  // namespace
}  // namespace swarmanoid
