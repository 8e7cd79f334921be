// Experiment functions that request a change that cannot be part of the state, at tick 5; the mode says which.
#include <limits>

#include "space_server/experiment_functions.h"

using namespace swarmanoid;

class CStateFunctions : public CExperimentFunctions
{
public:
  void Init(const TConfigurationTree t_tree, SpaceEditor&) override { mode_ = t_tree.GetText("mode"); }

  void PreStep(SpaceEditor& space) override
  {
    if (space.GetSpace().GetTick() != 5) return;
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    const std::string robot = "robot_one";
    if (mode_ == "move_nan") space.MoveEntity(robot, {{kNan, 1, 0}, Quaternion::Identity()});
    if (mode_ == "move_far") space.MoveEntity(robot, {{-1e9, 1, 0}, Quaternion::Identity()});
    if (mode_ == "move_not_unit") space.MoveEntity(robot, {{2, 2, 0}, Quaternion(0.5, 0, 0, 0)});
    if (mode_ == "led_12") space.SetAttribute(robot, "led", 77, 12);
    if (mode_ == "led_13") space.SetAttribute(robot, "led", 77, 13);
    if (mode_ == "led_far") space.SetAttribute(robot, "led", 77, 100000000);
    if (mode_ == "led_negative") space.SetAttribute(robot, "led", 77, -1);
    if (mode_ == "led_nan") space.SetAttribute(robot, "led", kNan);
    if (mode_ == "gripped_far") space.SetAttribute(robot, "gripped", 1e6);
    if (mode_ == "beacon") space.SetAttribute(robot, "beacon", 0xff0000);
  }

private:
  std::string mode_;
};

REGISTER_EXPERIMENT_FUNCTIONS(
    CStateFunctions,
    {.label = "state_functions",
     .brief = "asks for what cannot be part of the state",
     .parameters = {{.name = "mode", .type = ParameterType::kText, .description = "What is asked for."}}})
