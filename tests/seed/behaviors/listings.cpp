// The listings of behaviours and of state machines, each compiled as printed, in a separate namespace. Parts that a
// listing leaves out, such as the declaration of its class, come before it. The controllers at the end run the
// listings.
#include <string>

#include "behavior/ci_behavior_controller.h"
#include "behavior/ci_footbot_state.h"
#include "behavior/fsm.h"
#include "ci_colour.h"
#include "footbot/bt_footbot_random_walk_with_obstacle_avoidance.h"

using namespace std;

#define DECLARE_AVOIDANCE                                                   \
  class CBTFootbotObstacleAvoidance : public CCI_Behavior<CCI_FootBotState> \
  {                                                                         \
  public:                                                                   \
    void Step(CCI_FootBotState& cRobotState) override;                      \
  };

#define DECLARE_COMBINER                                           \
  class CBTFootbotRWWithOA : public CCI_Behavior<CCI_FootBotState> \
  {                                                                \
  public:                                                          \
    CBTFootbotRWWithOA();                                          \
    void Step(CCI_FootBotState& cRobotState) override;             \
                                                                   \
  private:                                                         \
    CBTFootbotRandomWalk* m_pcRW;                                  \
    CBTFootbotObstacleAvoidance* m_pcOa;                           \
  };

namespace behavior
{
DECLARE_AVOIDANCE
#include "writing_a_behavior.inc"
}  // namespace behavior

namespace behavior_filled
{
DECLARE_AVOIDANCE
#include "writing_a_behavior_filled.inc"
}  // namespace behavior_filled

namespace sequential
{
DECLARE_COMBINER
#include "combiner_sequentially.inc"
}  // namespace sequential

namespace parallel
{
DECLARE_COMBINER
#include "combiner_parallelly.inc"
}  // namespace parallel

namespace parallel_filled
{
DECLARE_COMBINER

// Sets the mean of the wheel velocities that the two states have set. A state that has set none does not count.
void Merge(const CCI_FootBotState& first, const CCI_FootBotState& second, CCI_FootBotState& into)
{
  double left = 0;
  double right = 0;
  double wishes = 0;
  for (const CCI_FootBotState* copy : {&first, &second})
  {
    if (!copy->HasNewWheelVelocity()) continue;
    double wish_left = 0;
    double wish_right = 0;
    copy->GetFootBotWheelsAngularVelocity(wish_left, wish_right);
    left += wish_left;
    right += wish_right;
    ++wishes;
  }
  if (wishes > 0) into.SetFootBotWheelsAngularVelocity(left / wishes, right / wishes);
}
#include "combiner_parallelly_filled.inc"
}  // namespace parallel_filled

namespace container
{
class CNewController : public CCI_BehaviorController<CCI_FootBotState>
{
public:
  int Init(const TConfigurationTree t_tree) override;
  void ControlStep() override;
  void Destroy() override;
};
#include "new_behavior_controller.inc"
}  // namespace container

namespace fsm
{
#include "fsm_declaration.inc"
// clang-format would sort them.
#include "fsm_constructor.inc"
#include "fsm_step.inc"
#include "fsm_transitions.inc"
}  // namespace fsm

namespace fsm_filled
{
// The conditions of the test: each is met at one tick.
bool ConditionsMet(unsigned from, unsigned to, const CCI_FootBotState& state)
{
  if (from == 0 && to == 1) return state.GetTick() == 3;
  if (from == 1 && to == 2) return state.GetTick() == 6;
  return state.GetTick() == 9;
}
#include "fsm_declaration.inc"
// clang-format would sort them.
#include "fsm_constructor.inc"
#include "fsm_step.inc"
#include "fsm_transitions_filled.inc"
}  // namespace fsm_filled

namespace
{

template <class Behavior>
class Container : public CCI_BehaviorController<CCI_FootBotState>
{
public:
  int Init(const TConfigurationTree) override
  {
    m_pcState = new CCI_FootBotState(GetRobot());
    m_pcState->Init();
    m_pcRootBehavior = new Behavior();
    m_pcRootBehavior->Init();
    return CCI_Controller::RETURN_OK;
  }
  void Destroy() override
  {
    m_pcRootBehavior->Destroy();
    delete m_pcState;
    delete m_pcRootBehavior;
  }
};

// Shows the id of the state as the colour of the LEDs.
template <class Machine>
class ShowsState : public Machine
{
public:
  void Step(CCI_FootBotState& cRobotState)
  {
    Machine::Step(cRobotState);
    cRobotState.SetAllLedColours(1 + this->GetStateID());
  }
};

using Behavior = Container<behavior::CBTFootbotObstacleAvoidance>;
using BehaviorFilled = Container<behavior_filled::CBTFootbotObstacleAvoidance>;
using RandomWalk = Container<CBTFootbotRandomWalk>;
using Sequential = Container<sequential::CBTFootbotRWWithOA>;
using Parallel = Container<parallel::CBTFootbotRWWithOA>;
using ParallelFilled = Container<parallel_filled::CBTFootbotRWWithOA>;
using NewController = container::CNewController;
using Machine = Container<ShowsState<fsm::CBTFootbotSampleBehavior>>;
using MachineFilled = Container<ShowsState<fsm_filled::CBTFootbotSampleBehavior>>;

}  // namespace

REGISTER_CONTROLLER(Behavior, "behavior")
REGISTER_CONTROLLER(BehaviorFilled, "behavior_filled")
REGISTER_CONTROLLER(RandomWalk, "random_walk")
REGISTER_CONTROLLER(Sequential, "sequential")
REGISTER_CONTROLLER(Parallel, "parallel")
REGISTER_CONTROLLER(ParallelFilled, "parallel_filled")
REGISTER_CONTROLLER(NewController, "new_controller")
REGISTER_CONTROLLER(Machine, "machine")
REGISTER_CONTROLLER(MachineFilled, "machine_filled")
