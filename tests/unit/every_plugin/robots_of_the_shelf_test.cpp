// The kinds of user/entities that model robots which one can buy: their sizes, readings of a wall at a known distance,
// and fastest speeds are the published figures, in each engine.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "common/control_interface/ci_controller.h"
#include "common/control_interface/ci_ground_sensor.h"
#include "common/control_interface/ci_proximity_sensor.h"
#include "common/control_interface/ci_range_scanner_sensor.h"
#include "common/control_interface/ci_wheels_actuator.h"
#include "common/math/elementary.h"
#include "common/space/space.h"
#include "simulation/simulator.h"
#include "test_folders.h"
#include "tests/unit/every_plugin/small_scene.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid
{
namespace
{

constexpr double kNothing = std::numeric_limits<double>::infinity();
constexpr int kTicksOfDrive = 20;
constexpr double kSecondsOfDrive = 0.1 * kTicksOfDrive;

// The readings of the robot in its last control step.
struct SeenByProbe
{
  std::vector<double> proximity, ground, distances;
};
SeenByProbe& LastSeen()
{
  static SeenByProbe seen;
  return seen;
}

class CShelfProbe : public CCI_Controller
{
public:
  int Init(const TConfigurationTree tree) override
  {
    left_ = tree.GetNumber("left");
    right_ = tree.GetNumber("right");
    return RETURN_OK;
  }
  void ControlStep() override
  {
    GetRobot()->Actuator<CCI_WheelsActuator>("wheels").SetLinearVelocity(left_, right_);
    const auto keep = [](std::vector<double>& kept, auto readings) { kept.assign(readings.begin(), readings.end()); };
    keep(LastSeen().proximity, GetRobot()->Sensor<CCI_ProximitySensor>("proximity").GetAllSensorReadings());
    keep(LastSeen().ground, GetRobot()->Sensor<CCI_GroundSensor>("ground").GetAllSensorReadings());
    keep(LastSeen().distances, GetRobot()->Sensor<CCI_RangeScannerSensor>("range_scanner").GetAllDistances());
  }

private:
  double left_ = 0, right_ = 0;
};
REGISTER_CONTROLLER(CShelfProbe,
                    {.label = "shelf_probe",
                     .parameters = {{.name = "left", .default_value = "0", .minimum = -10, .maximum = 10},
                                    {.name = "right", .default_value = "0", .minimum = -10, .maximum = 10}}})

struct DrivenTo
{
  Vector3 position;
  double yaw = 0;
};

struct ShelfScene
{
  std::string kind, library;
  std::string scanner = "beams='1'";  // parameters of the range scanner
  std::string things{};               // beside the robot, which starts at 5, 5, 0 and looks along x
  double left = 0, right = 0;         // m/s
};

class RobotsOfTheShelf : public testing::TestWithParam<const char*>
{
protected:
  // Returns where the robot is after the last tick.
  DrivenTo Run(const ShelfScene& scene) const
  {
    RegisterEverything();
    LastSeen() = {};
    const auto experiment =
        test::ExperimentText{
            .framework = fmt::format("<maxclock>{}</maxclock><plugin_path>{}</plugin_path>", kTicksOfDrive,
                                     SWARMANOID_BUILD_FOLDER "/lib/swarmanoid"),
            .kinds = fmt::format("<{} library='{}'/>", scene.kind, scene.library),
            .controllers = test::Controller(
                {.tag = "shelf_probe",
                 .actuators = {"generic_wheels"},
                 .sensors = {"generic_proximity", "generic_ground", "generic_range_scanner " + scene.scanner},
                 .parameters = fmt::format("<left>{}</left><right>{}</right>", scene.left, scene.right)}),
            .arena = fmt::format("<{} id='it' position='5, 5, 0' controller='c'/>{}", scene.kind, scene.things),
            .engines = fmt::format("<{} id='e'/>", GetParam())}
            .Load();
    if (experiment == nullptr) return {};
    SimulatorOptions options;
    options.threads = 1;
    CSimulator simulator(*experiment, options);
    while (simulator.Step())
      ;
    const CSwarmanoidSpaceEntity& robot = *simulator.GetSpace().FindEntity("it");
    const DrivenTo place{robot.GetPosition() - Vector3(5, 5, 0), YawOf(robot.GetOrientation())};
    simulator.Finish();
    return place;
  }
  // Returns how far it drives at the greatest command.
  double FurthestDrive(const std::string& kind, const std::string& library) const
  {
    return Run({.kind = kind, .library = library, .left = 5, .right = 5}).position.x();
  }
  bool IsKinematic() const { return GetParam() == std::string("kinematics2d"); }
  // Returns the tolerance of a length (m) that wheels with masses have driven.
  double OfDrive(double length) const { return IsKinematic() ? 1e-9 : 0.06 * length; }
};

// Returns a wall across the way of the robot with its near face at x, ahead or behind.
std::string WallAcross(double x, double height = 0.5)
{
  return fmt::format("<wall id='w' position='{}, 5, {}' size='0.1, 2, {}'/>", 5 + x + std::copysign(0.05, x),
                     height / 2, height);
}

// Returns the reading of a sensor at x that looks at an angle to a wall's face at `wall`.
double ReadingOf(double wall, double x, double angle, double range)
{
  const double distance = (wall - x) / std::cos(angle);
  return distance < range ? 1 - distance / range : 0;
}

const EntityKindDescription& RowOfTag(const char* tag)
{
  RegisterEverything();
  return DescriptionOf(*KindOfTag(tag));
}

// Returns the box around the drawn mesh.
Eigen::AlignedBox3d DrawnBox(const EntityKindDescription& row)
{
  Eigen::AlignedBox3d box;
  for (const MeshPart& part : row.mesh)
  {
    if (part.form == MeshPart::Form::kBall)
    {
      box.extend(part.from - Vector3::Constant(part.radius));
      box.extend(part.from + Vector3::Constant(part.radius));
      continue;
    }
    Vector3 beside = Vector3::Zero();
    if (part.form == MeshPart::Form::kRod)
    {
      const Vector3 axis = (part.to - part.from).normalized();
      for (int k = 0; k < 3; ++k) beside[k] = part.radius * std::sqrt(std::max(0.0, 1 - axis[k] * axis[k]));
    }
    for (const Vector3& end : {part.from, part.to})
    {
      box.extend(Vector3(end - beside));
      box.extend(Vector3(end + beside));
    }
  }
  return box;
}

TEST(RobotsOfTheShelfRows, AreDrawnAsLargeAsTheyArePublished)
{
  struct Published
  {
    const char* tag;
    Vector3 size;  // m: length, width, height
    double tolerance;
  };
  // Webots' guide gives the Thymio II 112 x 117 x 53 mm with its wheels, Mobsya 110 x 112 mm.
  for (const Published& published :
       {Published{"thymio_ii", {0.112, 0.112, 0.053}, 0.005}, Published{"turtlebot4", {0.342, 0.339, 0.351}, 0.005},
        Published{"epuck2", {0.071, 0.071, 0.045}, 0.002}, Published{"khepera_iv", {0.1408, 0.1408, 0.058}, 0.005}})
  {
    const Eigen::AlignedBox3d box = DrawnBox(RowOfTag(published.tag));
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(box.max()[k] - (k == 2 ? 0 : box.min()[k]), published.size[k], published.tolerance)
          << published.tag << " " << k;
    EXPECT_GE(box.min().z(), -1e-9) << published.tag;
  }
}

TEST(RobotsOfTheShelfRows, HaveThePublishedMasses)
{
  EXPECT_NEAR(RowOfTag("thymio_ii").mass_kg, 0.25, 0.005);
  EXPECT_EQ(RowOfTag("turtlebot4").mass_kg, 3.945);
  EXPECT_EQ(RowOfTag("epuck2").mass_kg, 0.13);
  EXPECT_EQ(RowOfTag("epuck").mass_kg, 0.15);
}

// The axle is 30 mm before the back and 80 mm behind the front.
TEST(RobotsOfTheShelfRows, TheThymioHasItsWheelsAtTheBack)
{
  Eigen::AlignedBox3d outline;
  for (const Vector3& corner : RowOfTag("thymio_ii").corners) outline.extend(corner);
  EXPECT_NEAR((outline.min() - Vector3(-0.03, -0.055, 0)).norm(), 0, 1e-9);
  EXPECT_NEAR((outline.max() - Vector3(0.08, 0.055, 0.053)).norm(), 0, 1e-9);
}

TEST_P(RobotsOfTheShelf, ThymiosSenseAWallAheadByTheirFiveFrontSensors)
{
  constexpr double kWall = 0.11;
  Run({.kind = "thymio_ii", .library = "thymio_ii", .things = WallAcross(kWall)});
  const std::vector<double> expected = {ReadingOf(kWall, 0.063, 0.66323, 0.12),
                                        ReadingOf(kWall, 0.0756, 0.33161, 0.12),
                                        ReadingOf(kWall, 0.08, 0, 0.12),
                                        ReadingOf(kWall, 0.0756, 0.33161, 0.12),
                                        ReadingOf(kWall, 0.063, 0.66323, 0.12),
                                        0,
                                        0};
  ASSERT_EQ(LastSeen().proximity.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(LastSeen().proximity[i], expected[i], 0.01) << i;
}

TEST_P(RobotsOfTheShelf, ThymiosSenseAWallBehindByTheirTwoRearSensors)
{
  constexpr double kWall = -0.1;
  Run({.kind = "thymio_ii", .library = "thymio_ii", .things = WallAcross(kWall)});
  ASSERT_EQ(LastSeen().proximity.size(), 7U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(LastSeen().proximity[i], 0) << i;
  for (std::size_t i = 5; i < 7; ++i) EXPECT_NEAR(LastSeen().proximity[i], 1 - 0.07 / 0.12, 0.01) << i;
}

TEST_P(RobotsOfTheShelf, ThymiosTurnAboutTheirAxleAndDriveAtMost20CmInASecond)
{
  EXPECT_NEAR(FurthestDrive("thymio_ii", "thymio_ii"), 0.2 * kSecondsOfDrive, OfDrive(0.2 * kSecondsOfDrive));
  const DrivenTo place = Run({.kind = "thymio_ii", .library = "thymio_ii", .left = -0.02, .right = 0.02});
  const double turned = 0.04 / 0.0935 * kSecondsOfDrive;
  EXPECT_NEAR(place.yaw, turned, IsKinematic() ? 1e-9 : 0.08 * turned);
  EXPECT_NEAR(place.position.norm(), 0, 0.003);
}

// A box about the axle stands for the body in engines of the plane. The kinematic engine stops a step before it.
TEST_P(RobotsOfTheShelf, ThymiosThatDriveBackStopWithTheirBackAtTheWall)
{
  constexpr double kWall = -0.13, kStep = 0.01;
  const bool is_plane = GetParam() != std::string("dynamics3d");
  const DrivenTo place =
      Run({.kind = "thymio_ii", .library = "thymio_ii", .things = WallAcross(kWall), .left = -0.1, .right = -0.1});
  EXPECT_NEAR(place.position.x(), kWall + (is_plane ? 0.08 : 0.03), 0.004 + (IsKinematic() ? kStep : 0));
}

TEST_P(RobotsOfTheShelf, ThymiosSeeALineUnderOneOfTheirGroundSensors)
{
  Run({.kind = "thymio_ii",
       .library = "thymio_ii",
       .things = "<nest id='line' position='5.07157, 5.01155, 0' radius='0.008' colour='black'/>"});
  EXPECT_EQ(LastSeen().ground, (std::vector<double>{0, 1}));
}

TEST_P(RobotsOfTheShelf, TurtleBotsSenseAWallByTheInfraredSensorsThatReachIt)
{
  constexpr double kWall = 0.2;
  Run({.kind = "turtlebot4", .library = "turtlebot4", .things = WallAcross(kWall)});
  const double left = ReadingOf(kWall, 0.099, 0.873, 0.2), front_left = ReadingOf(kWall, 0.1396, 0.436, 0.2);
  const std::vector<double> expected = {0, left, front_left, ReadingOf(kWall, 0.154, 0, 0.2), front_left, left, 0};
  ASSERT_EQ(LastSeen().proximity.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(LastSeen().proximity[i], expected[i], 0.01) << i;
}

// Beam i of four looks to the back, right, front and left. The beams are above low walls.
TEST_P(RobotsOfTheShelf, TurtleBotsScanWhatIsAsHighAsTheirScannerUpTo12M)
{
  const std::string scanner = "beams='4' range='12' nearest='0.15' position='-0.04, 0, 0.193'";
  const auto scan = [&](double wall, double height)
  {
    Run({.kind = "turtlebot4", .library = "turtlebot4", .scanner = scanner, .things = WallAcross(wall, height)});
    return LastSeen().distances;
  };
  std::vector<double> distances = scan(1.5, 0.5);
  ASSERT_EQ(distances.size(), 4U);
  EXPECT_NEAR(distances[2], 1.54, 1e-3);
  for (const std::size_t aside : {0U, 1U, 3U}) EXPECT_EQ(distances[aside], kNothing) << aside;
  EXPECT_NEAR(scan(-1.5, 0.5)[0], 1.46, 1e-3);
  EXPECT_EQ(scan(1.5, 0.19)[2], kNothing);
}

TEST_P(RobotsOfTheShelf, TurtleBotsDriveAtMost306MmInASecondAndTurnByTheirAxle)
{
  EXPECT_NEAR(FurthestDrive("turtlebot4", "turtlebot4"), 0.306 * kSecondsOfDrive, OfDrive(0.306 * kSecondsOfDrive));
  const DrivenTo place = Run({.kind = "turtlebot4", .library = "turtlebot4", .left = -0.05, .right = 0.05});
  const double turned = 0.1 / 0.233 * kSecondsOfDrive;
  EXPECT_NEAR(place.yaw, turned, IsKinematic() ? 1e-9 : 0.08 * turned);
}

TEST_P(RobotsOfTheShelf, TurtleBotsSeeAHoleByTheCliffSensorAboveIt)
{
  Run({.kind = "turtlebot4",
       .library = "turtlebot4",
       .things = "<hole id='stairs' position='5.18, 5.045, 0' size='0.06, 0.04'/>"});
  EXPECT_EQ(LastSeen().ground, (std::vector<double>{1, 0, 1, 1}));
}

// 1,200 steps of a motor are 1.2 turns of a wheel.
TEST_P(RobotsOfTheShelf, EPuck2sDriveAtMost1200StepsInASecond)
{
  const double expected = 1.2 * 2 * kPi * 0.0205 * kSecondsOfDrive;
  EXPECT_NEAR(expected, 0.154 * kSecondsOfDrive, 0.002);
  EXPECT_NEAR(FurthestDrive("epuck2", "epuck"), expected, OfDrive(expected));
}

TEST_P(RobotsOfTheShelf, EPuck2sMeasureDistancesAheadUpTo2M)
{
  const auto measure = [&](double wall)
  {
    Run({.kind = "epuck2",
         .library = "epuck",
         .scanner = "beams='1' range='2' position='0.034, -0.0018, 0.033'",
         .things = WallAcross(wall)});
    return LastSeen().distances.at(0);
  };
  EXPECT_NEAR(measure(1.534), 1.5, 1e-3);
  EXPECT_EQ(measure(2.1), kNothing);
}

INSTANTIATE_TEST_SUITE_P(Engines, RobotsOfTheShelf, testing::Values("kinematics2d", "dynamics2d", "dynamics3d"),
                         [](const auto& parameters) { return std::string(parameters.param); });

}  // namespace
}  // namespace swarmanoid
