// Sensors with readings on demand: the readings do not depend on which controllers ask, nor on the time.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "common/control_interface/ci_controller.h"
#include "controller_host/controller_host.h"
#include "controller_host/on_demand_sensor.h"
#include "test_world.h"

namespace swarmanoid
{
namespace
{

struct Device
{
  std::string type, implementation;
  EntityKind robots = EntityKind::kFootbot;
  TestParameters parameters{};
};
void PrintTo(const Device& device, std::ostream* out) { *out << device.implementation; }

const std::vector<Device> kDevices = {
    {"range_and_bearing",
     "generic_range_and_bearing",
     EntityKind::kFootbot,
     {{"loss_probability", "0.3"}, {"range_noise_kind", "gaussian"}, {"range_noise_deviation", "0.1"}}},
    {"footbot_light",
     "generic_footbot_light",
     EntityKind::kFootbot,
     {{"noise_kind", "uniform"}, {"noise_minimum", "-0.1"}, {"noise_maximum", "0.1"}}},
    {"eyebot_light", "argos3_eyebot_light", EntityKind::kEyebot},
    {"light", "generic_light"},
    {"light", "argos3_light", EntityKind::kFootbot, {{"noise_kind", "gaussian"}, {"noise_deviation", "0.1"}}},
    {"footbot_proximity",
     "generic_footbot_proximity",
     EntityKind::kFootbot,
     {{"noise_kind", "gaussian"}, {"noise_deviation", "0.1"}}},
    {"footbot_proximity",
     "generic_footbot_polynomial_proximity",
     EntityKind::kFootbot,
     {{"coefficients", "1 -5"}, {"range", "0.3"}}},
    {"proximity",
     "generic_proximity",
     EntityKind::kEyebot,
     {{"noise_kind", "uniform"}, {"noise_minimum", "-0.1"}, {"noise_maximum", "0.1"}}},
    {"handbot_proximity", "generic_handbot_proximity", EntityKind::kHandbot},
    {"footbot_omnidirectional_camera",
     "generic_footbot_omnidirectional_camera",
     EntityKind::kFootbot,
     {{"angle_noise_kind", "gaussian"}, {"angle_noise_deviation", "0.1"}}},
    {"footbot_omnidirectional_camera",
     "pixel_noise_footbot_omnidirectional_camera",
     EntityKind::kFootbot,
     {{"miss_probability", "0.2"}}},
    {"eyebot_camera", "generic_eyebot_camera", EntityKind::kEyebot},
    {"handbot_camera", "generic_handbot_camera", EntityKind::kHandbot},
    {"pie_camera", "generic_pie_camera"},
    {"range_scanner",
     "generic_range_scanner",
     EntityKind::kFootbot,
     {{"beams", "9"}, {"layers", "2"}, {"noise_kind", "gaussian"}, {"noise_deviation", "0.1"}}},
    {"depth_camera",
     "generic_depth_camera",
     EntityKind::kFootbot,
     {{"width", "5"}, {"height", "3"}, {"depth_noise_kind", "gaussian"}, {"depth_noise_deviation", "0.1"}}}};

class OnDemand : public testing::TestWithParam<Device>
{
protected:
  OnDemand()
  {
    for (int k = 0; k < 24; ++k) world.AddFootbot(Somewhere(), Somewhere());
    for (int k = 0; k < 6; ++k) world.AddEyebot(Somewhere(), Somewhere(), 1.5);
    for (int k = 0; k < 6; ++k) world.Add(EntityKind::kHandbot, {Somewhere(), Somewhere(), 0}, 0, {0.2, 0.2, 0.3});
    for (int k = 0; k < 3; ++k)
      world.Add(EntityKind::kLightBulb, {Somewhere(), Somewhere(), 1}, 0, {0, 0, 0}, false, -1);
    world.AddBlock({5, 5, 0.25}, {1, 0.2, 0.5});
    robots = world.RobotsOf(GetParam().robots);
  }

  double Somewhere() { return 3.5 + 3 * random.Uniform(); }

  // Where robots are, what they light and what they send.
  void Change(std::uint64_t tick)
  {
    CSwarmanoidSpace& space = world.Space();
    space.SetTick(tick);
    for (const std::uint32_t e : space.Movable())
    {
      Pose pose = space.GetPose(e);
      pose.position.x() += 0.2 * random.Uniform() - 0.1;
      pose.position.y() += 0.2 * random.Uniform() - 0.1;
      pose.orientation = QuaternionFromYaw(6 * random.Uniform());
      // Some are tilted for a while.
      if (tick % 8 == 7) pose.orientation = QuaternionFromEuler({0, 0.1 * random.Uniform(), 0.1});
      space.SetPose(e, pose);
      const CSwarmanoidSpaceEntity& entity = space.GetEntity(e);
      if (AttributeOffset(entity.GetKind(), "led") >= 0)
        space.SetAttribute(entity.SlotOf("led", 2), random.Uniform() < 0.5 ? 0 : 0xff0000);
      if (AttributeOffset(entity.GetKind(), "message") < 0) continue;
      space.SetAttribute(entity.SlotOf("message"), random.Uniform() < 0.2 ? 0 : 1);
      space.SetAttribute(entity.SlotOf("message", 1), static_cast<double>(tick));
    }
  }

  using Values = std::vector<std::pair<std::string, double>>;
  static Values Readings(TestSensor& sensor, std::size_t k)
  {
    std::vector<CCI_Reading> readings;
    sensor.batch->Sensor(k)->Describe(readings);
    Values values;
    for (const CCI_Reading& reading : readings) values.emplace_back(reading.name, reading.value);
    return values;
  }
  static void EndSteps(TestSensor& sensor) { dynamic_cast<OnDemandSensor&>(*sensor.batch).EndSteps(); }

  TestSensor Make() { return {world, GetParam().type, GetParam().implementation, robots, GetParam().parameters}; }

  RandomStream random{11, 0, 0, 0};
  TestWorld world;
  std::vector<std::uint32_t> robots;
};

// Robot 0 always, robot 1 never, the others some ticks long and then not.
TEST_P(OnDemand, GivesWhatIsGivenToThoseWhoAlwaysAsk)
{
  TestSensor always = Make(), sometimes = Make();
  std::size_t compared = 0, something = 0;
  for (std::uint64_t tick = 0; tick < 40; ++tick)
  {
    Change(tick);
    always.Update();
    sometimes.Update();
    for (std::size_t k = 0; k < robots.size(); ++k)
    {
      const auto expected = Readings(always, k);
      if (k == 1 || (k > 1 && tick / (1 + k % 4) % 3 != 0)) continue;
      EXPECT_EQ(Readings(sometimes, k), expected) << "robot " << k << ", tick " << tick;
      ++compared;
      something += std::any_of(expected.begin(), expected.end(), [](const auto& of) { return of.second != 0; });
    }
    EndSteps(always);
    EndSteps(sometimes);
  }
  EXPECT_GT(compared, 50U);
  EXPECT_GT(something, 10U);
}

// After the step, a request gets the readings of the controller's step, or those of the present space. Requests of
// other robots make no difference.
TEST_P(OnDemand, BetweenStepsDependsOnTheRobotAlone)
{
  TestSensor asked = Make(), unasked = Make(), later = Make();
  for (std::uint64_t tick = 0; tick < 6; ++tick)
  {
    Change(tick);
    // Readings of robot 0 are computed ahead, those of robot 1 with others, and those of robot 2 never.
    for (TestSensor* sensor : {&asked, &unasked})
    {
      sensor->Update();
      if (tick < 5)
      {
        Readings(*sensor, 0);
        Readings(*sensor, 3);
      }
    }
    std::vector<Values> in_step;
    for (std::size_t k = 0; k < 3; ++k) in_step.push_back(Readings(asked, k));
    EndSteps(asked);
    EndSteps(unasked);
    Change(tick);
    later.Update();
    for (std::size_t k = 0; k < 3; ++k)
    {
      EXPECT_EQ(Readings(asked, k), in_step[k]) << k << ", tick " << tick;
      if (k == 0 && tick < 5)
        EXPECT_EQ(Readings(unasked, k), in_step[k]) << tick;
      else
        EXPECT_EQ(Readings(unasked, k), Readings(later, k)) << k << ", tick " << tick;
    }
  }
}

// Control steps in several threads, and two threads for each robot.
TEST_P(OnDemand, ManyMayAskAtTheSameTime)
{
  TestSensor always = Make(), sometimes = Make();
  for (std::uint64_t tick = 0; tick < 12; ++tick)
  {
    Change(tick);
    always.Update();
    sometimes.Update();
    constexpr std::size_t kThreads = 4;
    std::vector<Values> found(2 * robots.size());
    std::vector<std::thread> threads;
    for (std::size_t thread = 0; thread < kThreads; ++thread)
      threads.emplace_back(
          [&, thread]
          {
            for (std::size_t k = thread / 2; k < robots.size(); k += kThreads / 2)
              if (tick % 4 == 3) found[2 * k + thread % 2] = Readings(sometimes, k);
          });
    for (std::thread& thread : threads) thread.join();
    for (std::size_t k = 0; k < robots.size(); ++k)
    {
      const auto expected = Readings(always, k);
      for (const Values& values : {found[2 * k], found[2 * k + 1]})
        EXPECT_EQ(values, tick % 4 == 3 ? expected : Values()) << k << ", tick " << tick;
    }
    EndSteps(always);
    EndSteps(sometimes);
  }
}

INSTANTIATE_TEST_SUITE_P(Devices, OnDemand, testing::ValuesIn(kDevices),
                         [](const auto& device)
                         {
                           return device.param.implementation.substr(device.param.implementation.find('_') + 1) +
                                  std::to_string(device.index);
                         });

// Records which readings were made, and when.
class Counting : public OnDemandSensor
{
public:
  explicit Counting(bool alone) : makes_alone_(alone) { InitDemand(4); }
  void RefreshShared(WorkerPool*) override {}
  // Returns the readings that a tick computes if these controllers ask.
  std::string Tick(const std::vector<std::size_t>& asks)
  {
    made_.clear();
    MakeAhead();
    made_ += "|";
    for (const std::size_t k : asks) Want(k);
    EndSteps();
    return made_;
  }

private:
  void MakeDue() override
  {
    for (std::size_t k = 0; k < 4; ++k)
      if (IsDue(k)) made_ += std::to_string(k);
  }
  bool MakeAlone(std::size_t k) override
  {
    if (makes_alone_) made_ += std::to_string(k);
    return makes_alone_;
  }

  bool makes_alone_;
  std::string made_;
};

TEST(OnDemandSensor, MakesAheadWhatWasAskedForTwice)
{
  Counting each(true);
  EXPECT_EQ(each.Tick({0, 1}), "0123|") << "all, the first time";
  EXPECT_EQ(each.Tick({0, 2}), "01|2");
  EXPECT_EQ(each.Tick({0, 2, 2}), "0|2") << "once";
  EXPECT_EQ(each.Tick({}), "02|");
  EXPECT_EQ(each.Tick({}), "|");
  EXPECT_EQ(each.Tick({3}), "|3");
  EXPECT_EQ(each.Tick({3}), "|3");
  EXPECT_EQ(each.Tick({3}), "3|");
}

TEST(OnDemandSensor, MakesTheRestTogetherWhereThatIsQuicker)
{
  Counting together(false);
  EXPECT_EQ(together.Tick({0}), "0123|");
  EXPECT_EQ(together.Tick({0}), "0|");
  EXPECT_EQ(together.Tick({0, 3, 2}), "0|123");
  EXPECT_EQ(together.Tick({}), "0|");
  EXPECT_EQ(together.Tick({}), "|");
  EXPECT_EQ(together.Tick({2, 1}), "|0123");
}

class Blind : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override {}
};
REGISTER_CONTROLLER(Blind, "on_demand_test_blind")

TEST(OnDemandSensor, WhoWatchesARobotThatReadsNothingSeesWhatIsThereNow)
{
  TestWorld world;
  const auto robot = world.AddFootbot(5, 5);
  const auto other = world.AddFootbot(8, 5);
  Experiment& experiment = world.Configuration();
  ControllerConfiguration& controller = experiment.controllers.emplace_back();
  controller.tag = "on_demand_test_blind";
  controller.id = experiment.entities[robot].controller = "c";
  DeviceConfiguration& device = controller.sensors.emplace_back();
  device.type = "footbot_proximity";
  device.implementation = "generic_footbot_proximity";
  const Assignment assignment = MakeAssignment(experiment, 1);
  ControllerHost host(world.Space(), assignment, 0);
  const auto seen = [&]
  {
    RobotStatus status;
    EXPECT_TRUE(host.Describe(robot, status));
    double sum = 0;
    for (const CCI_Reading& reading : status.sensors.at(0).readings) sum += reading.value;
    return sum;
  };
  for (std::uint64_t tick = 0; tick < 4; ++tick)
  {
    world.Space().SetTick(tick);
    world.Space().SetPose(other, {{8, 5, 0}, Quaternion::Identity()});
    host.Tick({});
    world.Space().SetPose(other, {{5.2, 5, 0}, Quaternion::Identity()});
    EXPECT_GT(seen(), 0) << tick;
  }
}

}  // namespace
}  // namespace swarmanoid
