// The table of docs/determinism.md, line by line: which results stay the same under which change. Robots that stand
// still with noisy sensors record all their draws and readings.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "common/control_interface/ci_controller.h"
#include "common/control_interface/ci_range_and_bearing.h"
#include "common/control_interface/footbot/ci_footbot_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_light_sensor.h"
#include "simulation/register_all.h"
#include "simulation/simulator.h"
#include "tests/world/experiment_text.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

// By robot, step and tick, and what it was.
using Recording = std::map<std::string, std::vector<double>>;
Recording record;

class CRecorder : public CCI_Controller
{
public:
  int Init(const TConfigurationTree tree) override
  {
    tree.GetText("any", "");
    Draw("Init");
    return RETURN_OK;
  }
  void ControlStep() override
  {
    Draw("ControlStep");
    CCI_Robot& robot = *GetRobot();
    robot.Actuator<CCI_RangeAndBearingActuator>("range_and_bearing").SetMessage({});
    const auto ground = robot.Sensor<CCI_FootBotGroundSensor>("footbot_ground").GetAllSensorReadings();
    record[Place("ground")].assign(ground.begin(), ground.end());
    // Packets are sorted by distance, since their order has no meaning.
    std::vector<double>& ranges = record[Place("ranges")];
    for (const auto& packet : robot.Sensor<CCI_RangeAndBearingSensor>("range_and_bearing").GetAllPackets())
      ranges.push_back(packet.range_m);
    std::sort(ranges.begin(), ranges.end());
  }
  void Destroy() override { Draw("Destroy"); }

private:
  std::string Place(const std::string& what)
  {
    return GetRobot()->GetId() + " " + what + " " + std::to_string(GetRobot()->GetTick());
  }
  void Draw(const std::string& step)
  {
    std::vector<double>& numbers = record[Place(step)];
    for (int call = 0; call < 4; ++call) numbers.push_back(GetRobot()->GetRandom().Uniform());
  }
};
REGISTER_CONTROLLER(CRecorder, "crn_recorder")

// Parts of the file that a change replaces.
struct File
{
  std::string framework = "<maxclock>4</maxclock>";
  std::string controller_parameters{};
  std::vector<std::string> more_sensors{};
  std::string before{};  // entities before the robots
  std::string robots =
      "<footbot id='a' position='2,2,0' controller='c'/><footbot id='b' position='3,2,0' controller='c'/>";
  std::string after{};
  std::string visualisations{};
};

Recording Recorded(const File& file)
{
  RegisterBuiltins();
  const test::TemporaryFolder folder;
  std::vector<std::string> sensors = file.more_sensors;
  sensors.insert(sensors.end(),
                 {"generic_footbot_ground floor_colour='#808080' noise_kind='gaussian' noise_deviation='0.05'",
                  "generic_range_and_bearing range_noise_kind='gaussian' range_noise_deviation='0.05'"});
  const auto experiment =
      test::ExperimentText{.framework = file.framework,
                           .controllers = test::Controller({.tag = "crn_recorder",
                                                            .actuators = {"generic_range_and_bearing"},
                                                            .sensors = sensors,
                                                            .parameters = file.controller_parameters}),
                           .size = "20,20,2",
                           .arena = file.before + file.robots + file.after,
                           .visualisations = file.visualisations}
          .Load();
  record.clear();
  SimulatorOptions options;
  options.output_folder = folder.Path();
  CSimulator simulator(*experiment, options);
  while (simulator.Step()) continue;
  simulator.Finish();
  return record;
}

const std::string kFarBlock = "<block id='far' position='15,15,0.25' size='1,1,0.5'/>";

void ExpectAllOf(const Recording& expected, const Recording& found)
{
  for (const auto& [name, numbers] : expected)
  {
    ASSERT_TRUE(found.contains(name)) << name;
    EXPECT_EQ(found.at(name), numbers) << name;
  }
}

TEST(CommonRandomNumbers, StepsOfOneRobotDrawDifferentNumbers)
{
  const Recording all = Recorded({});
  std::vector<double> drawn;
  for (const char* step :
       {"a Init 0", "a ControlStep 0", "a ControlStep 1", "b Init 0", "b ControlStep 0", "a Destroy 3"})
    drawn.insert(drawn.end(), all.at(step).begin(), all.at(step).end());
  ASSERT_EQ(drawn.size(), 24U);
  std::sort(drawn.begin(), drawn.end());
  EXPECT_EQ(std::adjacent_find(drawn.begin(), drawn.end()), drawn.end());
}

TEST(CommonRandomNumbers, AnEntityMoreChangesNothing)
{
  const Recording expected = Recorded({});
  ExpectAllOf(expected, Recorded({.before = kFarBlock}));
  ExpectAllOf(expected, Recorded({.after = kFarBlock}));
  ExpectAllOf(expected, Recorded({.before = "<footbot id='c' position='10,10,0' controller='c'/>"}));
}

TEST(CommonRandomNumbers, AThirdRobotBesideChangesNothingBetweenTwo)
{
  const Recording expected = Recorded({});
  const Recording found = Recorded({.before = "<footbot id='c' position='2.5,4,0' controller='c'/>"});
  for (const auto& [name, numbers] : expected)
  {
    if (name.find("ranges") == std::string::npos) continue;
    // The third robot is farther away.
    EXPECT_TRUE(std::equal(numbers.begin(), numbers.end(), found.at(name).begin())) << name;
  }
}

TEST(CommonRandomNumbers, TheOrderInTheFileChangesNothing)
{
  ExpectAllOf(Recorded({}), Recorded({.robots = "<footbot id='b' position='3,2,0' controller='c'/><footbot id='a' "
                                                "position='2,2,0' controller='c'/>"}));
}

TEST(CommonRandomNumbers, ADeviceMoreChangesNothing)
{
  ExpectAllOf(Recorded({}),
              Recorded({.more_sensors = {"generic_footbot_light noise_kind='uniform' noise_range='0.1'"}}));
}

TEST(CommonRandomNumbers, AParameterOfTheControllerChangesNothing)
{
  ExpectAllOf(Recorded({}), Recorded({.controller_parameters = "<any>1</any>"}));
}

TEST(CommonRandomNumbers, AVisualiserChangesNothing)
{
  ExpectAllOf(Recorded({}), Recorded({.visualisations = "<text_render id='crn_table' file='crn_table.txt'/>"}));
}

TEST(CommonRandomNumbers, LengthAndNumberOfTicksChangeNothingUpToThen)
{
  Recording expected = Recorded({});
  std::erase_if(expected, [](const auto& entry) { return entry.first.find("Destroy") != std::string::npos; });
  ExpectAllOf(expected, Recorded({.framework = "<clocktick>50</clocktick><maxclock>4</maxclock>"}));
  ExpectAllOf(expected, Recorded({.framework = "<maxclock>7</maxclock>"}));
}

TEST(CommonRandomNumbers, AnotherSeedChangesAll)
{
  const Recording expected = Recorded({});
  const Recording other = Recorded({.framework = "<maxclock>4</maxclock><seed>2</seed>"});
  for (const auto& [name, numbers] : expected)
  {
    if (numbers.empty()) continue;
    EXPECT_NE(other.at(name), numbers) << name;
  }
}

TEST(CommonRandomNumbers, AnotherIdChangesWhatIsItsOwn)
{
  const Recording expected = Recorded({});
  const Recording renamed = Recorded({.robots = "<footbot id='a' position='2,2,0' controller='c'/><footbot id='z' "
                                                "position='3,2,0' controller='c'/>"});
  EXPECT_EQ(renamed.at("a ground 2"), expected.at("a ground 2"));
  EXPECT_EQ(renamed.at("a ControlStep 2"), expected.at("a ControlStep 2"));
  EXPECT_NE(renamed.at("a ranges 2"), expected.at("a ranges 2"));
  EXPECT_NE(renamed.at("z ControlStep 2"), expected.at("b ControlStep 2"));
}

}  // namespace
}  // namespace swarmanoid
