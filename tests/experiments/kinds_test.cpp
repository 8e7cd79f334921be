// Kinds of robots and objects that libraries add, in the engines of the simulator: the e-puck of user/entities, and the
// plain ones of tests/libraries.
#include <fmt/format.h>

#include "common/control_interface/ci_colour_blob_sensor.h"
#include "common/control_interface/ci_controller.h"
#include "common/control_interface/ci_ground_sensor.h"
#include "common/control_interface/ci_led_ring_actuator.h"
#include "common/control_interface/ci_proximity_sensor.h"
#include "common/control_interface/ci_wheels_actuator.h"
#include "common/control_interface/footbot/ci_footbot_proximity_sensor.h"
#include "simulation/register_all.h"
#include "tests/experiments/running_experiment.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid
{
namespace
{

constexpr double kRadius = 0.0355;
constexpr double kAxle = 0.052;
constexpr double kRange = 0.04;

// The readings of a test's robots in their last control step.
struct Sensed
{
  std::vector<double> proximity;
  std::vector<double> ground;
  std::uint32_t floor = 0;
  std::vector<double> footbot_proximity;
  std::vector<CCI_ColourBlob> blobs;
};
Sensed sensed;

// Drives by its parameters.
class Driver : public CCI_Controller
{
public:
  int Init(const TConfigurationTree tree) override
  {
    const auto& wheels = GetRobot()->Actuator<CCI_WheelsActuator>("wheels");
    EXPECT_EQ(wheels.GetInterwheelDistance(), kAxle);
    EXPECT_EQ(wheels.GetWheelRadius(), 0.0205);
    left_ = tree.GetNumber("left");
    right_ = tree.GetNumber("right");
    return RETURN_OK;
  }
  void ControlStep() override
  {
    GetRobot()->Actuator<CCI_WheelsActuator>("wheels").SetLinearVelocity(left_, right_);
    auto& leds = GetRobot()->Actuator<CCI_LedRingActuator>("led_ring");
    EXPECT_EQ(leds.GetNumLeds(), 8U);
    leds.SetColour(0, CCI_Colour::RED);
    const auto& proximity = GetRobot()->Sensor<CCI_ProximitySensor>("proximity");
    const auto& ground = GetRobot()->Sensor<CCI_GroundSensor>("ground");
    sensed.proximity.assign(proximity.GetAllSensorReadings().begin(), proximity.GetAllSensorReadings().end());
    sensed.ground.assign(ground.GetAllSensorReadings().begin(), ground.GetAllSensorReadings().end());
    sensed.floor = ground.GetFloorColour();
    EXPECT_THROW(proximity.GetAngle(8), std::out_of_range);
  }

private:
  double left_ = 0, right_ = 0;
};
REGISTER_CONTROLLER(Driver,
                    {.label = "test_driver",
                     .parameters = {{.name = "left", .default_value = "0"}, {.name = "right", .default_value = "0"}}})

class Watcher : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override
  {
    const auto readings = GetRobot()->Sensor<CCI_FootBotProximitySensor>("footbot_proximity").GetAllSensorReadings();
    sensed.footbot_proximity.assign(readings.begin(), readings.end());
    const auto blobs = GetRobot()->Sensor<CCI_ColourBlobSensor>("footbot_omnidirectional_camera").GetAllBlobs();
    sensed.blobs.assign(blobs.begin(), blobs.end());
  }
};
REGISTER_CONTROLLER(Watcher, {.label = "test_watcher"})

class Kinds : public testing::TestWithParam<const char*>
{
protected:
  // `left` and `right`: of the wheels of "ep", m/s.
  void Start(const std::string& arena, double left = 0, double right = 0)
  {
    sensed = {};
    RegisterBuiltins();
    experiment_ =
        test::ExperimentText{
            .framework = "<plugin_path>" SWARMANOID_BUILD_FOLDER "/lib/swarmanoid:" SWARMANOID_BUILD_FOLDER
                         "/tests/libraries</plugin_path>",
            .kinds =
                "<epuck library='epuck'/><pillar library='plain_kinds'/><crate library='plain_kinds'/>"
                "<plain_robot library='plain_kinds'/>",
            .controllers =
                test::Controller({.tag = "test_driver",
                                  .id = "drive",
                                  .actuators = {"generic_wheels", "generic_led_ring"},
                                  .sensors = {"generic_proximity", "generic_ground"},
                                  .parameters = fmt::format("<left>{}</left><right>{}</right>", left, right)}) +
                test::Controller({.tag = "test_watcher",
                                  .id = "watch",
                                  .sensors = {"generic_footbot_proximity", "generic_footbot_omnidirectional_camera"}}),
            .size = "3,3,1",
            .arena = arena,
            .engines = std::string("<") + GetParam() + " id='e'/>"}
            .Load();
    SimulatorOptions options;
    options.visualisations = false;
    simulator_ = std::make_unique<CSimulator>(*experiment_, options);
  }
  void Run(int ticks)
  {
    for (int k = 0; k < ticks; ++k) ASSERT_TRUE(simulator_->Step());
  }
  const CSwarmanoidSpaceEntity& Entity(const char* id) { return *simulator_->GetSpace().FindEntity(id); }
  Vector3 At(const char* id) { return Entity(id).GetPosition(); }
  bool IsKinematic() const { return std::string(GetParam()) == "kinematics2d"; }
  // Returns a distance in m: bodies of dynamics engines give way a little.
  double Softness() const { return std::string(GetParam()) == "dynamics3d" ? 0.004 : IsKinematic() ? 1e-6 : 0.002; }

private:
  std::unique_ptr<Experiment> experiment_;
  std::unique_ptr<CSimulator> simulator_;
};

TEST_P(Kinds, EPucksDriveStraightByTheirWheels)
{
  Start("<epuck id='ep' position='1, 1, 0' orientation='0, 0, 90' controller='drive'/>", 0.1, 0.1);
  Run(20);
  const double tolerance = IsKinematic() ? 1e-9 : 0.006;
  EXPECT_NEAR(At("ep").x(), 1, tolerance);
  EXPECT_NEAR(At("ep").y(), 1 + 0.2, tolerance);
  EXPECT_NEAR(At("ep").z(), 0, 0.002);
}

TEST_P(Kinds, EPucksTurnByTheirAxle)
{
  Start("<epuck id='ep' position='1, 1, 0' controller='drive'/>", -0.02, 0.02);
  Run(20);
  const double turned = 0.04 / kAxle * 2;
  EXPECT_NEAR(YawOf(Entity("ep").GetOrientation()), turned, IsKinematic() ? 1e-9 : 0.08 * turned);
  EXPECT_NEAR((At("ep") - Vector3(1, 1, 0)).norm(), 0, 0.005);
}

TEST_P(Kinds, EPucksAreNoFasterThanTheirKind)
{
  Start("<epuck id='ep' position='1, 1, 0' controller='drive'/>", 5, 5);
  Run(20);
  EXPECT_NEAR(At("ep").x(), 1 + 0.25 * 2, IsKinematic() ? 1e-9 : 0.03);
}

TEST_P(Kinds, EPucksStopAtPillarsFootbotsAndOneAnother)
{
  for (const std::string& obstacle : {std::string("<pillar id='it' position='1.3, 1, 0' radius='0.05' height='0.2'/>"),
                                      std::string("<wall id='it' position='1.3, 1, 0.1' size='0.1, 0.1, 0.2'/>")})
  {
    Start(obstacle + "<epuck id='ep' position='1, 1, 0' controller='drive'/>", 0.1, 0.1);
    Run(40);
    EXPECT_LT(At("ep").x(), 1.25 - kRadius + Softness()) << obstacle;
    EXPECT_GT(At("ep").x(), 1.1) << obstacle;
  }
  Start(
      "<epuck id='ep' position='1, 1, 0' controller='drive'/><epuck id='other' position='1.3, 1, 0'/>"
      "<footbot id='fb' position='1.6, 1, 0'/>",
      0.1, 0.1);
  Run(60);
  EXPECT_GT((At("other") - At("ep")).norm(), 2 * kRadius - Softness());
  EXPECT_GT((At("fb") - At("other")).norm(), 0.085 + kRadius - Softness());
}

TEST_P(Kinds, EPucksPushMovableObjectsOfUsers)
{
  Start(
      "<crate id='box' position='1.2, 1, 0' size='0.06, 0.06, 0.06' movable='true' mass='0.01'/>"
      "<epuck id='ep' position='1, 1, 0' controller='drive'/>",
      0.1, 0.1);
  Run(40);
  // Without masses no body gives way.
  EXPECT_GT(At("box").x(), IsKinematic() ? 1.1 : 1.25);
  EXPECT_GT((At("box") - At("ep")).norm(), 0.03 + kRadius - Softness());
}

// A wall is 2 cm ahead of the body: the two front sensors see it at 2 cm and a little, each along its own ray.
TEST_P(Kinds, EPucksSenseByTheirOwnRing)
{
  const double wall = 1 + kRadius + 0.02;
  Start("<nest id='nest' position='1.03, 1, 0' radius='0.005' colour='black'/><wall id='w' position='" +
        std::to_string(wall + 0.05) +
        ", 1, 0.1' size='0.1, 1, 0.2'/><epuck id='ep' position='1, 1, 0' controller='drive'/>");
  Run(2);
  ASSERT_EQ(sensed.proximity.size(), 8U);
  const double distance = (wall - 1 - 0.030) / std::cos(1.27 - kPi / 2);
  EXPECT_NEAR(sensed.proximity[0], 1 - distance / kRange, 0.02);
  EXPECT_NEAR(sensed.proximity[7], 1 - distance / kRange, 0.02);
  for (const int beside : {2, 3, 4, 5}) EXPECT_EQ(sensed.proximity[static_cast<std::size_t>(beside)], 0) << beside;
  ASSERT_EQ(sensed.ground.size(), 3U);
  EXPECT_EQ(sensed.ground[1], 0) << "the middle one is above the patch";
  EXPECT_EQ(sensed.ground[0], 1);
  EXPECT_EQ(sensed.floor, 0xffffffU);
}

TEST_P(Kinds, FootbotsSeeEPucksAndTheirLeds)
{
  // It stands in front of the footbot, whose sensors are 6 cm high, above an e-puck of 5 cm, which its camera sees.
  Start(
      "<footbot id='fb' position='1, 1, 0' controller='watch'/>"
      "<epuck id='ep' position='1.4, 1, 0' controller='drive'/>"
      "<crate id='tall' position='1, 1.2, 0' size='0.1, 0.1, 0.2'/>");
  Run(3);
  EXPECT_GT(*std::max_element(sensed.footbot_proximity.begin(), sensed.footbot_proximity.end()), 0.05)
      << "the crate, a kind of a user";
  ASSERT_EQ(sensed.blobs.size(), 1U);
  EXPECT_EQ(CCI_Colour::Nearest(sensed.blobs[0].colour), CCI_Colour::RED);
  // LED 0 is 22.5 degrees left of the front, on a circle of 33 mm.
  const Vector2 led(0.4 + 0.033 * std::cos(kPi / 8), 0.033 * std::sin(kPi / 8));
  EXPECT_NEAR(sensed.blobs[0].distance_m, led.norm(), 0.01);
  EXPECT_NEAR(sensed.blobs[0].angle_rad, std::atan2(led.y(), led.x()), 0.03);
}

TEST_P(Kinds, RobotsWithAllDefaultsStandWhereTheyArePut)
{
  Start("<plain_robot id='plain' position='1, 1, 0' orientation='0, 0, 30'/>");
  Run(20);
  EXPECT_LT((At("plain") - Vector3(1, 1, 0)).norm(), 0.002);
  EXPECT_NEAR(YawOf(Entity("plain").GetOrientation()), kPi / 6, 0.001);
}

INSTANTIATE_TEST_SUITE_P(Engines, Kinds, testing::Values("kinematics2d", "dynamics2d", "dynamics3d"),
                         [](const auto& parameters) { return std::string(parameters.param); });

}  // namespace
}  // namespace swarmanoid
