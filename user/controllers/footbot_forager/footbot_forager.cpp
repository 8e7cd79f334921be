#include "footbot_forager.h"

#include <memory>

#include "behavior/ci_behavior_controller.h"
#include "bt_numbers.h"
#include "footbot/bt_footbot_drive.h"

using namespace swarmanoid;

namespace
{

constexpr double kSpeed = 0.2;       // m/s
constexpr double kGripWithin = 0.4;  // m between centres: from here the robot approaches the prey head on
constexpr double kPatience = 30;     // s
constexpr double kRest = 6;          // s
constexpr std::uint32_t kPrey = CCI_Colour::YELLOW;
constexpr std::uint32_t kNest = CCI_Colour::GREEN;

}  // namespace

CBTFootbotForager::CBTFootbotForager()
    : CCI_Behavior("forage"),
      wander_(kSpeed),
      avoid_(CBTFootbotObstacleAvoidance::VERSION_VECTOR_BASED, kSpeed),
      grip_(kPrey)
{
}

void CBTFootbotForager::Step(CCI_FootBotState& cRobotState)
{
  const double tick = cRobotState.GetTickSeconds();
  const bool carries = cRobotState.IsGripping();
  const CCI_ColourBlob* prey = cRobotState.GetNearestColourBlob(kPrey);
  busy_s_ = (carries || prey != nullptr) && carries == carried_ ? busy_s_ + tick : 0;
  carried_ = carries;
  if (busy_s_ > kPatience)
  {
    busy_s_ = 0;
    rest_s_ = kRest;
  }
  cRobotState.SetAllLedColours(carries ? CCI_Colour::BLUE : CCI_Colour::BLACK);

  if (rest_s_ > 0)
  {
    rest_s_ -= tick;
    cRobotState.SetGripper(0);
    wander_.Step(cRobotState);
  }
  else if (carries)
    Carry(cRobotState);
  else if (prey != nullptr)
    Fetch(cRobotState, *prey);
  else
  {
    cRobotState.SetGripper(0);
    wander_.Step(cRobotState);
  }
}

void CBTFootbotForager::Carry(CCI_FootBotState& cRobotState)
{
  cRobotState.SetGripper(1);
  if (const CCI_ColourBlob* nest = cRobotState.GetNearestColourBlob(kNest))
    BTFootbotSteer(cRobotState, nest->angle_rad, kSpeed);
  else
    wander_.Step(cRobotState);
}

void CBTFootbotForager::Fetch(CCI_FootBotState& cRobotState, const CCI_ColourBlob& prey)
{
  if (prey.distance_m < kGripWithin) return grip_.Step(cRobotState);
  cRobotState.SetGripper(0);
  BTFootbotSteer(cRobotState, prey.angle_rad, kSpeed);
  avoid_.Step(cRobotState);
}

void CBTFootbotForager::SaveState(std::ostream& state) const
{
  for (const double number : {busy_s_, rest_s_, carried_ ? 1.0 : 0.0}) BTSaveNumber(state, number);
  wander_.SaveState(state);
}

void CBTFootbotForager::LoadState(std::istream& state)
{
  busy_s_ = BTLoadNumber(state);
  rest_s_ = BTLoadNumber(state);
  carried_ = BTLoadNumber(state) != 0;
  wander_.LoadState(state);
}

class CFootbotForager : public CCI_BehaviorController<CCI_FootBotState>
{
public:
  int Init(const TConfigurationTree) override
  {
    state_ = std::make_unique<CCI_FootBotState>(GetRobot());
    behavior_ = std::make_unique<CBTFootbotForager>();
    m_pcState = state_.get();
    m_pcRootBehavior = behavior_.get();
    state_->Init();
    behavior_->Init();
    return RETURN_OK;
  }

private:
  std::unique_ptr<CCI_FootBotState> state_;
  std::unique_ptr<CBTFootbotForager> behavior_;
};

REGISTER_CONTROLLER(CFootbotForager, {.label = "footbot_forager",
                                      .brief = "carries yellow preys to the green nest, and wanders between"})
