// Robots that write and read the fields on the floor, in one process: devices, functions, hash, checkpoints, pictures.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numeric>

#include "common/checkpoint/checkpoint.h"
#include "common/control_interface/ci_controller.h"
#include "common/control_interface/ci_floor_field.h"
#include "common/space/drawn_fields.h"
#include "common/space/space.h"
#include "simulation/register_all.h"
#include "simulation/simulator.h"
#include "space_server/experiment_functions.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid
{
namespace
{

// Deposits 4 per second until its third step, and notes what it reads.
class CFieldWriter : public CCI_Controller
{
public:
  static inline std::vector<CCI_FloorFieldSensor::Reading> read;  // of the robot a, step after step
  static inline std::vector<std::string> fields;

  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override
  {
    auto& actuator = GetRobot()->Actuator<CCI_FloorFieldActuator>("floor_field");
    const auto& sensor = GetRobot()->Sensor<CCI_FloorFieldSensor>("floor_field");
    actuator.SetRate(++steps_ < 3 ? 4 : 0);
    EXPECT_THROW(actuator.SetRate(1, 2), std::out_of_range);
    EXPECT_EQ(sensor.FieldOf("food"), 1U);
    EXPECT_THROW(sensor.FieldOf("fod"), std::out_of_range);
    if (GetRobot()->GetId() != "a") return;
    fields.assign(sensor.GetFields().begin(), sensor.GetFields().end());
    EXPECT_EQ(sensor.PointCount(), 2U);
    read.push_back(sensor.GetReadings()[1]);
  }
  bool HasState() const override { return true; }
  void SaveState(std::ostream& state) const override { state << steps_; }
  void LoadState(std::istream& state) override { state >> steps_; }

private:
  int steps_ = 0;
};
REGISTER_CONTROLLER(CFieldWriter, "field_writer")

std::unique_ptr<Experiment> Scene(const std::string& robots, const std::string& more = "",
                                  const std::string& faults = "", const std::string& noise = "")
{
  RegisterBuiltins();
  return test::ExperimentText{
      .framework = "<maxclock>40</maxclock><canonical_period>10</canonical_period>",
      .controllers = test::Controller({.tag = "field_writer",
                                       .actuators = {"generic_floor_field point='0.1, 0'" + noise},
                                       .sensors = {"generic_floor_field points='0, 0; 0.1, 0'"}}),
      .size = "4,4,1",
      .arena =
          "<floor_field id='trail' evaporation='0.5' diffusion='1e-3' " + more + "/><floor_field id='food'/>" + robots,
      .faults = faults}
      .Load();
}

// The sums of the trail after four ticks of 4 per second, for three seeds, with these parameters of the actuator.
std::vector<double> SumsOfTrails(const std::string& noise)
{
  std::vector<double> sums;
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
  {
    auto experiment = Scene("<footbot id='a' position='1.025,1.025,0' controller='c'/>", "", "", noise);
    if (!experiment) return {};
    experiment->seed = seed;
    CSimulator simulator(*experiment, {});
    for (int tick = 0; tick < 4; ++tick) simulator.Step();
    double sum = 0;
    simulator.GetSpace().Fields().Field("trail").VisitRuns([&](std::size_t, std::span<const float> run)
                                                           { sum = std::accumulate(run.begin(), run.end(), sum); });
    sums.push_back(sum);
  }
  return sums;
}

TEST(FloorFieldDevices, NoiseChangesWhatIsDeposited)
{
  const std::vector<double> exact = SumsOfTrails("");
  const std::vector<double> noisy = SumsOfTrails(" noise_kind='uniform' noise_range='1'");
  ASSERT_EQ(exact.size(), 3U);
  ASSERT_EQ(noisy.size(), 3U);
  EXPECT_GT(exact[0], 0);
  EXPECT_EQ(exact[1], exact[0]) << "without noise nothing is random";
  EXPECT_NE(noisy[0], exact[0]);
  EXPECT_NE(noisy[1], noisy[0]);
  EXPECT_NEAR(noisy[0], exact[0], exact[0] / 4 + 1e-9) << "1 of 4 at most";
}

const std::string kTwo =
    "<footbot id='a' position='1.025,1.025,0' controller='c'/>"
    "<footbot id='b' position='3.025,2.025,0' orientation='0,0,90' controller='c'/>";

TEST(FloorFieldDevices, DepositAtAPointAndReadItTwoTicksLater)
{
  CFieldWriter::read.clear();
  const auto experiment = Scene(kTwo);
  ASSERT_TRUE(experiment);
  CSimulator simulator(*experiment, {});
  const CSwarmanoidSpace& space = simulator.GetSpace();
  const FloorField& trail = space.Fields().Field("trail");
  simulator.Step();
  EXPECT_EQ(trail.Total(), 0) << "the state of tick 1 has the rates, and the field of tick 2 the deposits";
  simulator.Step();
  EXPECT_NEAR(trail.Total(), 2 * 0.4 * std::exp(-0.05), 1e-5);
  EXPECT_GT(trail.ValueOf(trail.CellAt(1.125, 1.025)), 0.9 * trail.Largest());
  EXPECT_GT(trail.ValueOf(trail.CellAt(3.025, 2.125)), 0.9 * trail.Largest()) << "the point turns with the robot";
  EXPECT_EQ(space.Fields().Field("food").Total(), 0);
  for (int tick = 0; tick < 10; ++tick) simulator.Step();
  EXPECT_EQ(CFieldWriter::fields, (std::vector<std::string>{"trail", "food"}));
  EXPECT_EQ(CFieldWriter::read[1].value, 0);
  EXPECT_NEAR(CFieldWriter::read[2].value, 0.4 / 0.0025 * std::exp(-0.05) * (1 - 4 * 1e-3 * 0.1 / 0.0025), 0.01);
  EXPECT_NEAR(CFieldWriter::read[2].gradient_x, 0, 1e-3);
  EXPECT_NEAR(trail.Total(), 0.8 * (std::exp(-0.05 * 11) + std::exp(-0.05 * 10)), 1e-5) << "two steps deposited";
}

TEST(FloorFieldDevices, GradientsAreInTheFrameOfTheRobot)
{
  CFieldWriter::read.clear();
  const auto experiment = Scene("<footbot id='a' position='2.025,2.025,0' orientation='0,0,90' controller='c'/>");
  ASSERT_TRUE(experiment);
  CSimulator simulator(*experiment, {});
  const FloorField& trail = simulator.GetSpace().Fields().Field("trail");
  for (std::size_t cell = 0; cell < trail.Cells(); ++cell)
    simulator.GetEditor().SetFieldCell("trail", cell, static_cast<double>(cell % trail.Columns()));
  simulator.Step();
  EXPECT_NEAR(CFieldWriter::read.at(0).gradient_x, 0, 1e-6);
  EXPECT_NEAR(CFieldWriter::read.at(0).gradient_y, -20, 1e-6) << "it grows along x, which is to the right";
}

TEST(FloorFieldDevices, FunctionsReadAndChangeAndTheHashKnows)
{
  const auto experiment = Scene(kTwo);
  ASSERT_TRUE(experiment);
  CSimulator simulator(*experiment, {});
  SpaceEditor& editor = simulator.GetEditor();
  const std::uint64_t before = simulator.GetSpace().Hash();
  editor.Deposit("food", 1, 1, 3);
  EXPECT_NE(simulator.GetSpace().Hash(), before);
  EXPECT_NEAR(simulator.GetSpace().Fields().Field("food").Total(), 3, 1e-6);
  editor.Deposit("food", 1, 1, -5);
  EXPECT_EQ(simulator.GetSpace().Hash(), before) << "empty again";
  EXPECT_THROW(editor.Deposit("fod", 1, 1, 3), std::invalid_argument);
  EXPECT_THROW(editor.Deposit("food", 4, 1, 3), std::invalid_argument);
  EXPECT_THROW(editor.Deposit("food", std::nan(""), 1, 3), std::invalid_argument);
  EXPECT_THROW(editor.Deposit("food", 1, 1, std::nan("")), std::invalid_argument);
  EXPECT_THROW(editor.SetFieldCell("food", 6400, 1), std::invalid_argument);
  EXPECT_THROW(editor.SetFieldCell("food", 0, -1), std::invalid_argument);
  editor.SetFieldCell("food", 6399, 1);
  EXPECT_EQ(simulator.GetSpace().Fields()[1].ValueOf(6399), 1);
}

TEST(FloorFieldDevices, StepOnlyOnceAPeriod)
{
  const auto experiment = Scene(kTwo, "period='4'");
  ASSERT_TRUE(experiment);
  CSimulator simulator(*experiment, {});
  const FloorField& trail = simulator.GetSpace().Fields().Field("trail");
  for (int tick = 0; tick < 3; ++tick) simulator.Step();
  EXPECT_NEAR(trail.Total(), 1.6, 1e-5) << "deposits count at every tick";
  simulator.Step();
  EXPECT_NEAR(trail.Total(), 1.6 * std::exp(-0.2), 1e-5);
  simulator.Step();
  EXPECT_NEAR(trail.Total(), 1.6 * std::exp(-0.2), 1e-5);
}

TEST(FloorFieldDevices, DeadOnesDepositNothing)
{
  const auto experiment =
      Scene(kTwo, "", "<fault id='f' entities='a' device='floor_field' side='actuator' kind='dead'/>");
  ASSERT_TRUE(experiment);
  CSimulator simulator(*experiment, {});
  for (int tick = 0; tick < 2; ++tick) simulator.Step();
  EXPECT_NEAR(simulator.GetSpace().Fields().Field("trail").Total(), 0.4 * std::exp(-0.05), 1e-5);
}

TEST(FloorFieldDevices, GoOnFromACheckpoint)
{
  const std::string folder = testing::TempDir() + "floor_fields";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const auto experiment = Scene(kTwo);
  ASSERT_TRUE(experiment);
  SimulatorOptions options;
  options.output_folder = folder;
  options.checkpoint_every = 20;
  CSimulator whole(*experiment, options);
  while (whole.Step())
    if (whole.GetSpace().GetTick() == 5) whole.GetEditor().Deposit("food", 2, 2, 1);
  EXPECT_GT(whole.GetSpace().Fields().Field("trail").Total(), 0);
  options.checkpoint_every = 0;
  options.restore_file = folder + "/" + CheckpointName(20);
  CSimulator restored(*experiment, options);
  EXPECT_GT(restored.GetSpace().Fields().Field("food").Total(), 0);
  while (restored.Step())
  {
  }
  EXPECT_EQ(restored.Finish().hash, whole.Finish().hash);
  std::filesystem::remove_all(folder);
}

TEST(FloorFieldDevices, AreDrawnAsRectangles)
{
  const auto experiment = Scene(kTwo);
  ASSERT_TRUE(experiment);
  CSimulator simulator(*experiment, {});
  Drawing drawing;
  DrawFields(simulator.GetSpace(), drawing);
  EXPECT_TRUE(drawing.IsEmpty()) << "an empty field has no shapes";
  simulator.GetEditor().SetFieldCell("food", 0, 4);
  simulator.GetEditor().SetFieldCell("food", 1, 4);
  simulator.GetEditor().SetFieldCell("food", 80, 1);
  DrawFields(simulator.GetSpace(), drawing);
  ASSERT_EQ(drawing.shapes.size(), 2U) << "neighbours of one shade in a row are one rectangle";
  EXPECT_EQ(drawing.Mistake(2), "");
  EXPECT_EQ(drawing.shapes[0].kind, DrawnShape::Kind::kPolygon);
  EXPECT_FLOAT_EQ(drawing.numbers[3], 0.1F) << "x of the second corner";
}

}  // namespace
}  // namespace swarmanoid
