// The tables of a batch: readings where they are or copied, commands that are written or not, and the mistakes of
// users.
#include <gmock/gmock.h>

#include <cmath>
#include <deque>
#include <limits>

#include "common/control_interface/ci_batch_controller.h"
#include "common/control_interface/ci_positioning_sensor.h"
#include "common/control_interface/ci_proximity_sensor.h"
#include "common/control_interface/ci_range_and_bearing.h"
#include "tests/world/fake_devices.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::ElementsAreArray;

struct FakePositioning : CCI_PositioningSensor
{
  Vector3 GetPosition() const override { return position; }
  Quaternion GetOrientation() const override { return Quaternion::Identity(); }
  Vector3 position = Vector3::Zero();
};

struct FakeHearing : CCI_RangeAndBearingSensor
{
  std::span<const Packet> GetAllPackets() const override { return {}; }
};

// A ring of the robot's own size, which may change.
struct SizedRing : CCI_ProximitySensor
{
  std::span<const double> GetAllSensorReadings() const override { return readings; }
  double GetAngle(unsigned) const override { return 0; }
  std::vector<double> readings{0.1, 0.2};
};

struct Stepper : CCI_BatchController
{
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlSteps(CCI_Batch& robots) override
  {
    for (std::size_t k = 0; k < robots.Size(); ++k)
    {
      ++robots.Of<Stepper>(k).steps;
      robots.Commands("wheels")[k][0] = robots.Readings("ring")[k][0];
      robots.Commands("wheels")[k][1] = 2;
    }
  }
  int steps = 0;
};

// Robots r0, r1 … with the same devices, and a batch of all.
struct Robots
{
  struct Robot
  {
    explicit Robot(const std::string& id) : robot(id, "footbot")
    {
      controller.SetRobot(&robot);
      robot.AddSensor("ring", &ring);
      robot.AddSensor("at", &at);
      robot.AddSensor("heard", &heard);
      robot.AddSensor("sized", &sized);
      robot.AddActuator("wheels", &wheels);
      robot.AddActuator("gripper", &gripper);
    }
    CCI_Robot robot;
    Stepper controller;
    test::FakeProximity ring;
    FakePositioning at;
    FakeHearing heard;
    SizedRing sized;
    test::FakeWheels wheels;
    test::FakeGripper gripper;
  };

  explicit Robots(int count)
  {
    for (int k = 0; k < count; ++k) all.emplace_back("r" + std::to_string(k));
    for (int k = 0; k < count; ++k) all[static_cast<std::size_t>(k)].ring.readings[3] = 0.1 * k;
    Begin();
  }
  void Begin()
  {
    batch.Clear();
    for (Robot& one : all) batch.Add(one.controller);
    batch.Begin();
  }
  template <class Call>
  static std::string Mistake(const Call& call)
  {
    return test::MessageOf<CCI_DeviceError>(call);
  }

  std::deque<Robot> all;
  CCI_Batch batch;
};

TEST(Batch, OfNoRobotHasNoTables)
{
  Robots none(0);
  EXPECT_EQ(none.batch.Size(), 0U);
  none.batch.SetCommands();
}

TEST(Batch, HandsOutReadingsWhereTheDevicesHaveThem)
{
  for (const int count : {1, 3})
  {
    Robots robots(count);
    const CCI_Readings ring = robots.batch.Readings("ring");
    EXPECT_EQ(ring.Columns(), 24U);
    for (std::size_t k = 0; k < robots.all.size(); ++k) EXPECT_EQ(ring[k].data(), robots.all[k].ring.readings.data());
  }
}

TEST(Batch, CopiesReadingsThatDevicesCompute)
{
  Robots robots(3);
  robots.all[1].at.position = {1, 2, 3};
  const CCI_Readings at = robots.batch.Readings("at");
  EXPECT_EQ(at.Columns(), 7U);
  EXPECT_THAT(at[0], ElementsAre(0, 0, 0, 0, 0, 0, 1));
  EXPECT_THAT(at[1], ElementsAre(1, 2, 3, 0, 0, 0, 1));
  for (std::size_t k = 0; k < 3; ++k)
  {
    std::vector<double> alone;
    robots.all[k].at.ReadColumns(alone);
    EXPECT_THAT(at[k], ElementsAreArray(alone)) << k;
  }
}

TEST(Batch, ReadsASensorOnceAStep)
{
  Robots robots(2);
  for (int again = 0; again < 3; ++again) robots.batch.Readings("ring");
  EXPECT_EQ(robots.all[1].ring.reads, 1);
  robots.all[1].at.position.x() = 5;
  EXPECT_EQ(robots.batch.Readings("at")[1][0], 5);
  robots.all[1].at.position.x() = 6;
  EXPECT_EQ(robots.batch.Readings("at")[1][0], 5);
  robots.Begin();
  EXPECT_EQ(robots.batch.Readings("at")[1][0], 6);
}

TEST(Batch, SetsTheActuatorsWhoseRowsAreWritten)
{
  Robots robots(3);
  const CCI_Commands wheels = robots.batch.Commands("wheels");
  EXPECT_EQ(wheels.Columns(), 2U);
  for (const std::size_t k : {0U, 2U})
  {
    wheels[k][0] = 1.0 + static_cast<double>(k);
    wheels[k][1] = -1;
  }
  robots.batch.SetCommands();
  EXPECT_EQ(robots.all[0].wheels.left, 1);
  EXPECT_EQ(robots.all[2].wheels.left, 3);
  EXPECT_EQ(robots.all[2].wheels.right, -1);
  EXPECT_EQ(robots.all[1].wheels.writes, 0);
}

TEST(Batch, SetsEachActuatorOnceAStep)
{
  Robots robots(2);
  for (const double speed : {1.0, 2.0})
    for (std::size_t k = 0; k < 2; ++k) std::ranges::fill(robots.batch.Commands("wheels")[k], speed);
  robots.batch.SetCommands();
  robots.batch.SetCommands();
  robots.Begin();
  robots.batch.SetCommands();
  EXPECT_EQ(robots.all[0].wheels.writes, 1);
  EXPECT_EQ(robots.all[1].wheels.left, 2);
}

TEST(Batch, FollowsTheRobotsThatAreThere)
{
  Robots robots(4);
  robots.batch.Readings("ring");
  for (const std::vector<std::size_t>& there : std::vector<std::vector<std::size_t>>{{0, 1}, {1, 2, 3}, {3}, {}, {2}})
  {
    robots.batch.Clear();
    for (const std::size_t k : there) robots.batch.Add(robots.all[k].controller);
    robots.batch.Begin();
    ASSERT_EQ(robots.batch.Size(), there.size());
    for (std::size_t k = 0; k < there.size(); ++k)
    {
      EXPECT_EQ(&robots.batch.Robot(k), &robots.all[there[k]].robot);
      EXPECT_EQ(robots.batch.Readings("ring")[k][3], robots.all[there[k]].ring.readings[3]);
      EXPECT_EQ(robots.batch.Readings("at")[k][0], 0);
    }
  }
}

TEST(Batch, OfOneRobotIsTheStepOfAControllerAlone)
{
  Robots robots(1);
  robots.all[0].ring.readings[0] = 0.25;
  for (int step = 1; step <= 2; ++step)
  {
    static_cast<CCI_Controller&>(robots.all[0].controller).ControlStep();
    EXPECT_EQ(robots.all[0].controller.steps, step);
    EXPECT_EQ(robots.all[0].wheels.left, 0.25);
    EXPECT_EQ(robots.all[0].wheels.writes, step);
  }
}

TEST(Batch, NamesTheDevicesThatThereAre)
{
  Robots robots(2);
  EXPECT_EQ(
      Robots::Mistake([&] { robots.batch.Readings("rings"); }),
      "robot 'r0' has no sensor 'rings'; its controller lists at, heard, ring, sized. Add <rings> to <sensors> of "
      "the controller in the experiment file; did you mean 'ring'?");
  EXPECT_EQ(
      Robots::Mistake([&] { robots.batch.Commands("ring"); }),
      "robot 'r0' has no actuator 'ring'; its controller lists gripper, wheels. It lists the sensor of that name");
  EXPECT_EQ(Robots::Mistake([&] { robots.batch.Readings("heard"); }),
            "the sensor 'heard' of the robot 'r0' has no columns that exist at every tick; use Robot(k).GetSensor");
}

TEST(Batch, RefusesRobotsWithOtherColumns)
{
  Robots robots(3);
  robots.all[2].sized.readings.push_back(0.3);
  EXPECT_EQ(
      Robots::Mistake([&] { robots.batch.Readings("sized"); }),
      "the sensor 'sized' of the robot 'r2' has 3 columns, and that of the robot 'r0' 2; give each kind of robot a "
      "controller of its own");
  EXPECT_EQ(robots.batch.FailedRobot(), 2U);
}

TEST(Batch, RefusesASensorThatChangesItsSize)
{
  Robots robots(2);
  robots.batch.Readings("sized");
  robots.Begin();
  robots.all[1].sized.readings.pop_back();
  EXPECT_EQ(Robots::Mistake([&] { robots.batch.Readings("sized"); }),
            "the sensor 'sized' of the robot 'r1' has another number of readings than columns");
}

TEST(Batch, RefusesCommandsThatAreNotFinite)
{
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const double wrong : {kNan, -kNan, HUGE_VAL, -HUGE_VAL})
  {
    Robots robots(3);
    for (std::size_t k = 0; k < 3; ++k) std::ranges::fill(robots.batch.Commands("wheels")[k], k == 1 ? wrong : 5.0);
    EXPECT_EQ(Robots::Mistake([&] { robots.batch.SetCommands(); }),
              "column 0 ('left [rad/s]') of the actuator 'wheels' is not a finite number");
    EXPECT_EQ(robots.batch.FailedRobot(), 1U);
    EXPECT_EQ(robots.all[1].wheels.writes, 0);
  }
}

TEST(Batch, RefusesRowsThatAreWrittenInPart)
{
  Robots robots(2);
  robots.batch.Commands("wheels")[1][0] = 5;
  EXPECT_EQ(Robots::Mistake([&] { robots.batch.SetCommands(); }),
            "column 1 ('right [rad/s]') of the actuator 'wheels' was not set, but others of its row were");
}

}  // namespace
}  // namespace swarmanoid
