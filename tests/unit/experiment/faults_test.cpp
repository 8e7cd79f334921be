// <faults> of experiment files: the robots of a fault, and each mistake with its place and cure.
#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "tests/unit/experiment/fake_plugins.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid::test
{
namespace
{

using testing::ElementsAre;
using testing::SizeIs;

// 40 footbots with wheels and proximity sensors, a camera robot, and a footbot without a controller.
std::string With(const std::string& faults)
{
  std::string text =
      ExperimentText{
          .framework = "<seed>3</seed>",
          .controllers = Controller({.tag = "footbot_sample_controller",
                                     .id = "c",
                                     .actuators = {"dummy_footbot_wheels"},
                                     .sensors = {"generic_footbot_polynomial_proximity"}}) +
                         "<footbot_sample_controller id='d'><sensors><pie_camera implementation='generic_pie_camera'/>"
                         "</sensors></footbot_sample_controller>",
          .arena =
              "<distribute quantity='40'><footbot id='fb' controller='c'/></distribute>"
              "<footbot id='eye' position='0.5,0.5,0' controller='d'/><footbot id='idle' position='9.5,9.5,0'/>",
          .faults = "\n" + faults + "\n"}
          .Text();
  // The devices of ExperimentText are named by their implementations.
  const std::string wrong = "footbot_polynomial_proximity implementation", right = "footbot_proximity implementation";
  text.replace(text.find(wrong), wrong.size(), right);
  return text;
}

std::vector<std::uint32_t> RobotsOf(const std::string& attributes)
{
  const LoadedExperiment loaded = LoadText(With("<fault id='f' " + attributes + "/>"));
  for (const Diagnostic& error : loaded.errors) ADD_FAILURE() << error.Text();
  return loaded.experiment == nullptr ? std::vector<std::uint32_t>() : loaded.experiment->faults.at(0).entities;
}

// Returns the mistakes of a fault without its file and line.
std::string MistakesOf(const std::string& attributes)
{
  std::string all;
  for (const Diagnostic& error : LoadText(With("<fault id='f' " + attributes + "/>")).errors)
    all += std::to_string(error.location.column) + ": " + error.message + "\n";
  return all;
}

TEST(Faults, ConcernTheRobotsThatFitAndHaveTheDevice)
{
  EXPECT_THAT(RobotsOf("kind='dead'"), SizeIs(41));
  EXPECT_THAT(RobotsOf("kind='dead' entities='fb_*'"), SizeIs(40));
  EXPECT_THAT(RobotsOf("kind='dead' entities='fb_7'"), SizeIs(1));
  EXPECT_THAT(RobotsOf("kind='dead' device='footbot_wheels'"), SizeIs(40));
  EXPECT_THAT(RobotsOf("kind='dead' device='pie_camera'"), SizeIs(1));
  EXPECT_THAT(RobotsOf("kind='off'"), SizeIs(41));
}

TEST(Faults, ASharesRobotsAreThoseOfALargerShare)
{
  EXPECT_THAT(RobotsOf("kind='dead' entities='fb_*' share='0'"), SizeIs(0));
  std::vector<std::uint32_t> smaller;
  for (const char* share : {"0.1", "0.25", "0.5", "1"})
  {
    const std::vector<std::uint32_t> robots =
        RobotsOf("kind='dead' entities='fb_*' share='" + std::string(share) + "'");
    EXPECT_EQ(robots.size(), static_cast<std::size_t>(40 * std::stod(share) + 0.5));
    EXPECT_TRUE(std::ranges::is_sorted(robots));
    EXPECT_TRUE(std::ranges::includes(robots, smaller)) << share;
    smaller = robots;
  }
}

TEST(Faults, WithoutASectionThereAreNone)
{
  const LoadedExperiment loaded = LoadText(With(""));
  ASSERT_NE(loaded.experiment, nullptr);
  EXPECT_THAT(loaded.experiment->faults, SizeIs(0));
}

TEST(Faults, AreReadInTheirOrder)
{
  const LoadedExperiment loaded =
      LoadText(With("<fault id='f' kind='delay' value='5' from='3' to='9' device='footbot_proximity' side='sensor'/>"
                    "<fault id='g' kind='off'/>"));
  ASSERT_NE(loaded.experiment, nullptr);
  const FaultConfiguration& fault = loaded.experiment->faults.at(0);
  EXPECT_EQ(fault.kind, DeviceFaultKind::kDelay);
  EXPECT_EQ(fault.value, 5);
  EXPECT_FALSE(fault.IsActive(2));
  EXPECT_TRUE(fault.IsActive(3));
  EXPECT_TRUE(fault.IsActive(8));
  EXPECT_FALSE(fault.IsActive(9));
  EXPECT_FALSE(fault.of_actuators);
  EXPECT_TRUE(loaded.experiment->faults.at(1).IsActive(1'000'000));
}

TEST(Faults, MistakesHaveAPlaceAndACure)
{
  EXPECT_EQ(MistakesOf("kind='ded'"),
            "15: 'kind' of <fault> is 'ded'; it must be one of dead, stuck, scale, bias, noise, delay, drop, off; did "
            "you mean 'dead'?\n");
  EXPECT_EQ(MistakesOf("kind='dead' from='9' to='5'"),
            "36: the fault ends at tick 5, but begins at tick 9; 'to' must be greater than 'from', or 0 for the end of "
            "the run\n");
  EXPECT_EQ(MistakesOf("kind='dead' share='1.5'"), "27: 'share' of <fault> is 1.5; it must be from 0 to 1\n");
  EXPECT_EQ(MistakesOf("kind='dead' entities='fx_*'"), "27: no robot with a controller fits 'fx_*'\n");
  EXPECT_EQ(MistakesOf("kind='dead' entities='idle'"), "27: no robot with a controller fits 'idle'\n");
  EXPECT_EQ(MistakesOf("kind='dead' entities='eye' device='pie_camra'"),
            "42: no robot that fits 'eye' has the device 'pie_camra'; they have: pie_camera; did you mean "
            "'pie_camera'?\n");
  EXPECT_EQ(MistakesOf("kind='dead' device='footbot_wheels' side='sensor'"),
            "27: no robot that fits '*' has the sensor 'footbot_wheels'; they have: footbot_proximity, pie_camera\n");
  EXPECT_EQ(MistakesOf("kind='scale'"), "1: the kind 'scale' needs a 'value'\n");
  EXPECT_EQ(MistakesOf("kind='dead' value='2'"), "27: the kind 'dead' takes no value; leave 'value' out\n");
  EXPECT_EQ(MistakesOf("kind='delay' value='1.5'"),
            "28: the delay is 1.5; it must be a whole number of ticks, 1 to 10000\n");
  EXPECT_EQ(MistakesOf("kind='drop' value='1.5'"), "27: the probability is 1.5; it must be 0 to 1\n");
  EXPECT_EQ(MistakesOf("kind='noise' value='-1'"), "28: the deviation is -1; it must be at least 0\n");
  EXPECT_EQ(MistakesOf("kind='off' device='footbot_wheels'"),
            "26: the kind 'off' switches the whole robot off; leave 'device' and 'side' out, or choose the kind "
            "'dead'\n");
}

TEST(Faults, HaveDifferentIds)
{
  const LoadedExperiment loaded = LoadText(With("<fault id='f' kind='dead'/>\n<fault id='f' kind='off'/>"));
  ASSERT_THAT(loaded.errors, SizeIs(1));
  EXPECT_THAT(loaded.errors[0].Text(), testing::HasSubstr("'f'"));
}

}  // namespace
}  // namespace swarmanoid::test
