// Metrics of studies, against what is known of the scene: a robot that drives, rings of robots, cells that are counted.
#include "studies/metrics/recorder.h"

#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "common/control_interface/ci_controller.h"
#include "common/control_interface/ci_publish.h"
#include "common/control_interface/ci_wheels_actuator.h"
#include "common/space/publish.h"
#include "simulation/register_all.h"
#include "space_server/experiment_functions.h"
#include "studies/metrics/metric.h"
#include "tests/world/experiment_text.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

using testing::DoubleEq;
using testing::DoubleNear;
using testing::HasSubstr;

// Drives with both wheels at a speed, and publishes the tick and its double.
class CStudyDriver : public CCI_Controller
{
public:
  int Init(const TConfigurationTree tree) override
  {
    speed_ = tree.GetNumber("speed", 0);
    turn_ = tree.GetNumber("turn", 0);
    until_ = tree.GetInteger("until", 1000);
    return RETURN_OK;
  }
  void ControlStep() override
  {
    const auto tick = GetRobot()->GetTick();
    const double share = static_cast<long long>(tick) < until_ ? 1 : 0;
    GetRobot()->Actuator<CCI_WheelsActuator>("wheels").SetLinearVelocity(share * (speed_ - turn_),
                                                                         share * (speed_ + turn_));
    Publish(*GetRobot(), {{"tick", tick}, {"double", 2.0 * static_cast<double>(tick)}});
  }
  bool HasState() const override { return true; }

private:
  double speed_ = 0, turn_ = 0;
  long long until_ = 0;
};
REGISTER_CONTROLLER(CStudyDriver, "study_driver")

class CStudyFunctions : public CExperimentFunctions
{
public:
  void Init(const TConfigurationTree, SpaceEditor&) override {}
  void PostStep(SpaceEditor& space) override
  {
    if (space.GetSpace().GetTick() == 3) Publish(space.GetSpace(), "third", 3.5);
  }
};
REGISTER_EXPERIMENT_FUNCTIONS(CStudyFunctions, {.label = "study_functions", .brief = "publishes a number at tick 3"})

const std::string kWheels = "generic_wheels", kReport = "generic_report";

std::unique_ptr<Experiment> Scene(const std::string& entities, int ticks,
                                  const std::vector<std::string>& actuators = {kWheels, kReport})
{
  RegisterBuiltins();
  test::ExperimentText text{.framework = "<maxclock>" + std::to_string(ticks) + "</maxclock>",
                            .arena = entities,
                            .functions = "<study_functions id='f'/>"};
  for (const auto& [id, parameters] :
       std::vector<std::pair<std::string, std::string>>{{"go", "<speed>0.1</speed>"},
                                                        {"stay", ""},
                                                        {"curve", "<speed>0.1</speed><turn>0.04</turn>"},
                                                        {"spin", "<turn>0.05</turn>"},
                                                        {"brake", "<speed>0.1</speed><until>20</until>"}})
    text.controllers +=
        test::Controller({.tag = "study_driver", .id = id, .actuators = actuators, .parameters = parameters});
  return text.Load();
}

std::unique_ptr<Study> Metrics(const std::string& metrics, int every)
{
  LoadedStudy loaded = LoadStudyText(
      "<study experiment='e.xml'><metrics every='" + std::to_string(every) + "'>" + metrics + "</metrics></study>",
      "s.xml", ".");
  for (const Diagnostic& error : loaded.errors) ADD_FAILURE() << error.Text();
  return std::move(loaded.study);
}

RunSamples Measured(const Study& study, const Experiment& experiment, bool as_cluster = false)
{
  Recorder recorder(study, experiment);
  CSimulator simulator(experiment, {});
  do {
    recorder.Look(simulator);
    if (as_cluster) recorder.LookLast(simulator);
  } while (simulator.Step());
  if (!as_cluster) recorder.LookLast(simulator);
  simulator.Finish();
  return recorder.Take();
}

std::map<std::string, double> LastRow(const Study& study, const RunSamples& samples)
{
  const std::vector<std::string> columns = MetricColumns(study);
  std::map<std::string, double> row;
  for (std::size_t c = 0; c < columns.size(); ++c)
    row[columns[c]] = samples.values[samples.values.size() - columns.size() + c];
  return row;
}

std::map<std::string, double> AtEnd(const std::string& metrics, const Experiment& experiment)
{
  const auto study = Metrics(metrics, 0);
  return LastRow(*study, Measured(*study, experiment));
}

std::string Footbot(const std::string& id, double x, double y, double degrees, const std::string& controller = "stay")
{
  return fmt::format("<footbot id='{}' position='{},{},0' orientation='0,0,{}' controller='{}'/>", id, x, y, degrees,
                     controller);
}

std::string ComplaintAbout(const std::string& metrics, const Experiment& experiment)
{
  return test::MessageOf<ConfigurationError>(
      [&]
      {
        const auto study = Metrics(metrics, 0);
        const Recorder recorder(*study, experiment);
      });
}

TEST(StudyMetrics, AWayIsSpeedTimesTime)
{
  const auto experiment = Scene(Footbot("a", 2, 5, 0, "go") + Footbot("b", 2, 7, 0), 100);
  const auto row = AtEnd(
      "<distance id='way' aggregate='min max sum mean deviation count'/><displacement id='from' of='a'/>"
      "<nearest_neighbour id='near'/><distance id='own' of='b'/>",
      *experiment);
  EXPECT_NEAR(row.at("way.max"), 1, 1e-9) << "0.1 m/s for 10 s";
  EXPECT_EQ(row.at("way.min"), 0);
  EXPECT_EQ(row.at("own.mean"), 0);
  EXPECT_NEAR(row.at("way.mean"), 0.5, 1e-9);
  EXPECT_NEAR(row.at("way.deviation"), std::sqrt(0.5), 1e-9) << "of a sample of two";
  EXPECT_EQ(row.at("way.count"), 2);
  EXPECT_NEAR(row.at("from.mean"), 1, 1e-9);
  EXPECT_NEAR(row.at("near.mean"), std::sqrt(5.0), 1e-9);
}

TEST(StudyMetrics, OrderOfHeadings)
{
  const std::string metric = "<polarisation id='p'/>";
  EXPECT_THAT(AtEnd(metric, *Scene(Footbot("a", 2, 2, 30) + Footbot("b", 5, 5, 30), 1)).at("p"), DoubleNear(1, 1e-12));
  EXPECT_THAT(AtEnd(metric, *Scene(Footbot("a", 2, 2, 0) + Footbot("b", 5, 5, 180), 1)).at("p"), DoubleNear(0, 1e-12));
  EXPECT_THAT(AtEnd(metric, *Scene(Footbot("a", 2, 2, 0) + Footbot("b", 5, 5, 90), 1)).at("p"),
              DoubleNear(std::sqrt(0.5), 1e-12));
}

TEST(StudyMetrics, DispersionAndClustersOfKnownPlaces)
{
  // The robots form a square of side 1 m about (3, 3), and one robot is far away.
  const std::string square =
      Footbot("a", 2.5, 2.5, 0) + Footbot("b", 3.5, 2.5, 0) + Footbot("c", 3.5, 3.5, 0) + Footbot("d", 2.5, 3.5, 0);
  const auto row = AtEnd(
      "<dispersion id='u' of='a b c d'/><largest_cluster id='c' range='1.01'/><largest_cluster id='s' range='0.9'/>",
      *Scene(square + Footbot("far", 8, 8, 0), 1));
  const double radius = 0.085036758;
  EXPECT_THAT(row.at("u"), DoubleNear(4 * 0.5 / (4 * radius * radius), 1e-9));
  EXPECT_THAT(row.at("c"), DoubleEq(0.8));
  EXPECT_THAT(row.at("s"), DoubleEq(0.2));
}

TEST(StudyMetrics, RegionsKnowWhoIsInAndWhenTheyCame)
{
  const std::string entities =
      Footbot("a", 2, 5, 0, "go") + Footbot("b", 8, 8, 0) +
      "<ground_patch id='nest' position='3,5,0' radius='0.5'/><ground_patch id='field' position='8,8,0' size='1,2'/>";
  const auto experiment = Scene(entities, 100);
  const auto row = AtEnd(
      "<in_region id='nest_count' entity='nest'/><in_region id='field_count' entity='field'/>"
      "<in_region id='corner' min='7,7' max='9,9'/><time_to_region id='disc' centre='3,5' radius='0.5' aggregate='min "
      "count'/>"
      "<time_to_region id='never' centre='1,1' radius='0.1' aggregate='mean count'/>",
      *experiment);
  EXPECT_EQ(row.at("nest_count"), 1);
  EXPECT_EQ(row.at("field_count"), 1);
  EXPECT_EQ(row.at("corner"), 1);
  EXPECT_NEAR(row.at("disc.min"), 5, 0.11) << "half a metre at 0.1 m/s, in ticks of 0.1 s";
  EXPECT_EQ(row.at("disc.count"), 1);
  EXPECT_TRUE(std::isnan(row.at("never.mean")));
  EXPECT_EQ(row.at("never.count"), 0);
}

TEST(StudyMetrics, CoverageCountsCells)
{
  const auto study = Metrics("<coverage id='seen' cell='0.5'/><trajectories id='ways' of='a'/>", 50);
  const RunSamples samples = Measured(*study, *Scene(Footbot("a", 2.015, 5.2, 0, "go"), 100));
  // The way from 2.015 to 3.015 m covers three cells of 400.
  ASSERT_EQ(samples.ticks, (std::vector<std::uint64_t>{0, 50, 100}));
  EXPECT_THAT(samples.values, testing::ElementsAre(DoubleEq(1.0 / 400), DoubleEq(2.0 / 400), DoubleEq(3.0 / 400)));
  ASSERT_EQ(samples.grids.size(), 1U);
  EXPECT_EQ(samples.grids[0].columns, 20U);
  std::uint32_t visits = 0;
  for (const std::uint32_t count : samples.grids[0].visits) visits += count;
  EXPECT_EQ(visits, 101U) << "one for each state";
  EXPECT_EQ(samples.grids[0].visits[10 * 20 + 6], 2U);
  EXPECT_THAT(samples.ways, testing::ElementsAre(testing::FloatNear(2.015F, 1e-5F), testing::FloatNear(5.2F, 1e-5F),
                                                 testing::FloatNear(2.515F, 1e-5F), testing::FloatNear(5.2F, 1e-5F),
                                                 testing::FloatNear(3.015F, 1e-5F), testing::FloatNear(5.2F, 1e-5F)));
}

TEST(StudyMetrics, AContactCountsOnceAsLongAsItLasts)
{
  // One drives against a wall and stays there, 25 mm away, as the kinematic engine lets it; two touch from the start;
  // one is alone.
  const std::string entities = Footbot("driver", 5, 5, 0, "go") +
                               "<block id='wall' position='5.5,5,0.25' size='0.1,2,0.5'/>" + Footbot("left", 2, 2, 0) +
                               Footbot("right", 2.1705, 2, 0) + Footbot("alone", 8, 8, 0);
  const auto row = AtEnd(
      "<collisions id='all' gap='0.03' aggregate='sum max'/><collisions id='d' of='driver' gap='0.03'/><collisions "
      "id='l' "
      "of='left'/><collisions id='o' of='alone'/>",
      *Scene(entities, 200));
  EXPECT_EQ(row.at("d.mean"), 1);
  EXPECT_EQ(row.at("l.mean"), 1);
  EXPECT_EQ(row.at("o.mean"), 0);
  EXPECT_EQ(row.at("all.sum"), 3);
}

TEST(StudyMetrics, WhatIsPublishedJoinsTheTable)
{
  const auto study = Metrics(
      "<published id='third' name='third'/><published id='when' name='tick' by='controllers' aggregate='max'/>"
      "<published id='twice' name='double' by='controllers'/>"
      "<attribute id='reports' name='report' of='a'/>",
      2);
  const auto experiment = Scene(Footbot("a", 2, 2, 0) + Footbot("b", 5, 5, 0), 5);
  const RunSamples samples = Measured(*study, *experiment);
  ASSERT_EQ(samples.ticks, (std::vector<std::uint64_t>{0, 2, 4, 5}));
  EXPECT_TRUE(std::isnan(samples.values[0])) << "not yet";
  EXPECT_TRUE(std::isnan(samples.values[1]));
  const auto row = LastRow(*study, samples);
  EXPECT_EQ(row.at("third"), 3.5);
  EXPECT_EQ(row.at("when.max"), 4) << "of the last control step";
  EXPECT_EQ(row.at("twice.mean"), 8);
  EXPECT_EQ(row.at("reports.mean"), 5) << "one report a step, whatever it holds";
}

// Returns the complaint about a metric at the end of a run.
std::string ComplaintAfter(const std::string& metric, int ticks)
{
  const auto experiment = Scene(Footbot("a", 2, 2, 0), ticks);
  const auto study = Metrics(metric, 0);
  return test::MessageOf<ConfigurationError>([&] { Measured(*study, *experiment); });
}

TEST(StudyMetrics, ANameThatIsNeverPublishedIsAnErrorAtTheEndOfTheRun)
{
  EXPECT_EQ(ComplaintAfter("<published id='n' name='third'/>", 5), "");
  EXPECT_EQ(
      ComplaintAfter("<published id='n' name='thrid'/>", 5),
      "s.xml:1:64: no experiment function has published 'thrid' in the 5 ticks of the run; a number that has no value "
      "yet is published as 0 from the first tick on; published are: third; did you mean 'third'?");
  EXPECT_THAT(ComplaintAfter("<published id='n' name='third'/>", 1), HasSubstr("published are: none"));
  EXPECT_EQ(ComplaintAfter("<published id='n' name='tick' by='controllers'/>", 5), "");
  EXPECT_THAT(ComplaintAfter("<published id='n' name='tack' by='controllers'/>", 5),
              HasSubstr("s.xml:1:64: no controller of the entity has published 'tack' in the 5 ticks of the run"));
}

TEST(StudyMetrics, WhoeverCannotKnowTheLastTickHasTheSameRows)
{
  const auto study = Metrics("<distance id='d'/><coverage id='c' cell='0.1'/><trajectories id='t'/>", 4);
  const auto experiment = Scene(Footbot("a", 2, 2, 0, "go"), 10);
  const RunSamples one = Measured(*study, *experiment, false);
  const RunSamples other = Measured(*study, *experiment, true);
  EXPECT_EQ(one.ticks, (std::vector<std::uint64_t>{0, 4, 8, 10}));
  EXPECT_EQ(one.ticks, other.ticks);
  EXPECT_EQ(one.values, other.values);
  EXPECT_EQ(one.ways, other.ways);
  EXPECT_EQ(one.grids[0].visits, other.grids[0].visits);
}

TEST(StudyMetrics, AQuantileLiesBetweenItsNeighbours)
{
  std::vector<double> values{4, 1, 3, 2};
  EXPECT_EQ(Aggregate("median", values), 2.5);
  EXPECT_EQ(Aggregate("q25", values), 1.75);
  EXPECT_EQ(Aggregate("q0", values), 1);
  EXPECT_EQ(Aggregate("q100", values), 4);
  std::vector<double> none;
  EXPECT_EQ(Aggregate("count", none), 0);
  EXPECT_TRUE(std::isnan(Aggregate("mean", none)));
}

TEST(StudyMetrics, WhatDoesNotFitTheExperimentIsToldWithItsPlace)
{
  const auto experiment =
      Scene(Footbot("fb_1", 2, 2, 0) + "<block id='box' position='5,5,0.25' size='0.1,2,0.5'/>", 1, {kWheels});
  EXPECT_THAT(ComplaintAbout("<distance id='d' of='fb_2'/>", *experiment),
              HasSubstr("s.xml:1:63: no entity of the experiment fits 'fb_2'; did you mean 'fb_1'?"));
  EXPECT_THAT(ComplaintAbout("<attribute id='d' name='leds'/>", *experiment), HasSubstr("did you mean 'led'?"));
  EXPECT_THAT(ComplaintAbout("<attribute id='d' name='led' element='12'/>", *experiment),
              HasSubstr("the elements 0 to 11"));
  EXPECT_THAT(ComplaintAbout("<in_region id='d' entity='bx'/>", *experiment), HasSubstr("did you mean 'box'?"));
  EXPECT_THAT(ComplaintAbout("<published id='d' name='x' by='controllers'/>", *experiment), HasSubstr("<report>"));
  EXPECT_THAT(ComplaintAbout("<dispersion id='d' of='*'/>", *experiment), HasSubstr("'box' is no cylinder"));
  EXPECT_THAT(ComplaintAbout("<coverage id='d' cell='0.0001'/>", *experiment), HasSubstr("at most 1e+07"));
  EXPECT_THAT(ComplaintAbout("<trajectories id='a'/><trajectories id='b'/>", *experiment),
              HasSubstr("second <trajectories>"));
}

TEST(Publishing, TakesThreeNamesAStep)
{
  class Report : public CCI_ReportActuator
  {
  public:
    void ReportBytes(std::span<const std::uint8_t> given) override { bytes.assign(given.begin(), given.end()); }
    std::vector<std::uint8_t> bytes;
  } report;
  CCI_Robot robot("r", "footbot");
  Publish(robot, {{"a", 1}});
  EXPECT_TRUE(report.bytes.empty());
  robot.AddActuator("report", &report);
  Publish(robot, {{"a", -7}, {"b", 2.5F}, {"c", true}});
  EXPECT_EQ(PublishedNumberIn(report.bytes, "a"), -7);
  EXPECT_EQ(PublishedNumberIn(report.bytes, "b"), 2.5);
  EXPECT_EQ(PublishedNumberIn(report.bytes, "c"), 1);
  EXPECT_EQ(PublishedNumberIn(report.bytes, "d"), std::nullopt);
  EXPECT_THROW(Publish(robot, {{"a", 1}, {"b", 2}, {"c", 3}, {"d", 4}}), std::length_error);
  // The report could not distinguish these names.
  std::string same;
  for (int i = 0; same.empty(); ++i)
    if (ShortName("n" + std::to_string(i)) == ShortName("a")) same = "n" + std::to_string(i);
  EXPECT_THROW(Publish(robot, {{"a", 1}, {same, 1}}), std::invalid_argument);
}

TEST(Publishing, CountsOnlyIfSomebodyMeasuresThatRun)
{
  const auto experiment = Scene(Footbot("a", 2, 2, 0), 1);
  CSimulator one(*experiment, {}), other(*experiment, {});
  Publish(one.GetSpace(), "x", 1);
  const PublishedNumbers numbers(one.GetSpace());
  EXPECT_TRUE(numbers.Values().empty());
  Publish(other.GetSpace(), "x", 2);
  EXPECT_TRUE(numbers.Values().empty());
  Publish(one.GetSpace(), "x", 3);
  Publish(one.GetSpace(), "x", 4);
  EXPECT_EQ(numbers.Values().at("x"), 4);
  EXPECT_THROW(Publish(one.GetSpace(), "x", NAN), std::invalid_argument);
}

// Idle, the robot takes 2 W; 3 N act against the wheels; it has 1.5 kg; half of what the drive takes becomes work. The
// run lasts five seconds.
constexpr const char* kEnergy = "<energy id='e' idle='2' resistance='3' mass='1.5' efficiency='0.5' aggregate='sum'/>";
constexpr double kIdle_j = 2 * 5, kStart_j = 1.5 / 2 * 0.1 * 0.1 / 0.5;

TEST(StudyMetrics, EnergyOfADriveIsIdleResistanceAndSpeed)
{
  const auto scene = Scene(Footbot("go", 2, 5, 30, "go"), 50);
  EXPECT_NEAR(AtEnd(kEnergy, *scene)["e.sum"], kIdle_j + 3 * 0.1 * 5 / 0.5 + kStart_j, 1e-9);
  const auto still = Scene(Footbot("stay", 2, 5, 30), 50);
  EXPECT_NEAR(AtEnd(kEnergy, *still)["e.sum"], kIdle_j, 1e-9);
}

TEST(StudyMetrics, EnergyOfATurnIsWhatTheWheelsRoll)
{
  const auto scene = Scene(Footbot("spin", 5, 5, 0, "spin"), 50);
  EXPECT_NEAR(AtEnd(kEnergy, *scene)["e.sum"], kIdle_j + 3 * 0.05 * 5 / 0.5, 1e-9);
  // Wheels at 0.06 and 0.14 m/s. What moves is the chord of each tick's arc: (sin(x) / x) of 0.1 m/s, x half its angle.
  const auto curve = Scene(Footbot("curve", 5, 5, 0, "curve"), 50);
  const double half_angle = 0.08 / 0.14 * 0.1 / 2;
  const double speed = 0.1 * std::sin(half_angle) / half_angle;
  EXPECT_NEAR(AtEnd(kEnergy, *curve)["e.sum"], kIdle_j + (3 * speed * 5 + 1.5 / 2 * speed * speed) / 0.5, 1e-6);
}

TEST(StudyMetrics, EnergyIsNotGivenBack)
{
  const auto scene = Scene(Footbot("brake", 2, 5, 0, "brake"), 50);
  EXPECT_NEAR(AtEnd(kEnergy, *scene)["e.sum"], kIdle_j + 3 * 0.1 * 2 / 0.5 + kStart_j, 1e-9);
}

}  // namespace
}  // namespace swarmanoid
