// Messages between controllers and code that sees the whole space: experiment functions, programs around a simulator.
#include <gtest/gtest.h>

#include "common/control_interface/ci_controller.h"
#include "common/control_interface/ci_functions_channel.h"
#include "common/space/entities_by_kind.h"
#include "simulation/register_all.h"
#include "simulation/simulator.h"
#include "space_server/robot_messages.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid
{
namespace
{

struct Order
{
  double speed;
  int goal;
};

struct Answer
{
  std::uint64_t tick;
  double doubled;
  bool is_new;
};

// Answers in each step, from the first order on.
class CChannelEcho : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override
  {
    const auto& instruction = GetRobot()->Sensor<CCI_InstructionSensor>("instruction");
    const auto order = instruction.Get<Order>();
    EXPECT_FALSE(instruction.Get<float>()) << "of another size";
    if (!order) return;
    auto& report = GetRobot()->Actuator<CCI_ReportActuator>("report");
    report.Report(7);
    report.Report(Answer{GetRobot()->GetTick(), 2 * order->speed + order->goal, instruction.IsNew()});
  }
  bool HasState() const override { return true; }
};
REGISTER_CONTROLLER(CChannelEcho, "functions_channel_echo")

TEST(FunctionsChannel, CarriesMessagesBothWaysOnceATick)
{
  RegisterBuiltins();
  const auto experiment = test::ExperimentText{.framework = "<maxclock>5</maxclock>",
                                               .controllers = test::Controller({.tag = "functions_channel_echo",
                                                                                .actuators = {"generic_report"},
                                                                                .sensors = {"generic_instruction"}}),
                                               .arena =
                                                   "<footbot id='a' position='2,2,0' controller='c'/>"
                                                   "<footbot id='b' position='3,2,0' controller='c'/>"}
                              .Load();
  ASSERT_TRUE(experiment);
  CSimulator simulator(*experiment, {});
  const CSwarmanoidSpace& space = simulator.GetSpace();
  const auto& a = *space.FindEntity("a");
  EXPECT_FALSE(ReportOf<Answer>(a));
  simulator.Step();
  EXPECT_EQ(ReportsOf(a), 0) << "nothing to answer";
  Instruct(simulator.GetEditor(), "a", Order{0.25, 3});
  simulator.Step();
  ASSERT_TRUE(ReportOf<Answer>(a));
  EXPECT_EQ(ReportOf<Answer>(a)->tick, 1U);
  EXPECT_EQ(ReportOf<Answer>(a)->doubled, 3.5);
  EXPECT_TRUE(ReportOf<Answer>(a)->is_new);
  EXPECT_EQ(ReportsOf(a), 1) << "the last report of a step counts";
  EXPECT_FALSE(ReportOf<int>(a)) << "of another size";
  simulator.Step();
  EXPECT_FALSE(ReportOf<Answer>(a)->is_new);
  EXPECT_EQ(ReportsOf(a), 2);
  Instruct(simulator.GetEditor(), "a", Order{0.25, 3});
  simulator.Step();
  EXPECT_TRUE(ReportOf<Answer>(a)->is_new) << "the same again is another one";
  EXPECT_EQ(ReportsOf(*space.FindEntity("b")), 0);
  EXPECT_THROW(Instruct(simulator.GetEditor(), "c", 1), std::invalid_argument);

  EXPECT_EQ(GetEntitiesByKind(space, "footbot"), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_TRUE(GetEntitiesByKind(space, "eyebot").empty());
  EXPECT_THROW(GetEntitiesByKind(space, "fotbot"), std::invalid_argument);
}

}  // namespace
}  // namespace swarmanoid
