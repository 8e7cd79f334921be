#include "footbot_forager.h"

#include <algorithm>
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
constexpr double kFull = 0.95;       // charge up to which it stays in the nest
constexpr std::uint32_t kPrey = CCI_Colour::YELLOW;
constexpr std::uint32_t kNest = CCI_Colour::GREEN;

}  // namespace

CBTFootbotForager::CBTFootbotForager(double search_s, double rest_s, double recharge, const CCI_BatterySensor* battery)
    : CCI_Behavior("forage"),
      wander_(kSpeed),
      avoid_(CBTFootbotObstacleAvoidance::VERSION_VECTOR_BASED, kSpeed),
      grip_(kPrey),
      most_search_s_(search_s),
      nest_rest_s_(rest_s),
      recharge_(recharge),
      battery_(battery)
{
}

void CBTFootbotForager::Step(CCI_FootBotState& cRobotState)
{
  const double tick = cRobotState.GetTickSeconds();
  const bool carries = cRobotState.IsGripping();
  const CCI_ColourBlob* prey = cRobotState.GetNearestColourBlob(kPrey);
  if (MustReturn(carries, prey != nullptr, tick))
  {
    carried_ = carries;
    busy_s_ = 0;
    return Return(cRobotState);
  }
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

bool CBTFootbotForager::MustReturn(bool carries, bool sees_prey, double tick_s)
{
  if (most_search_s_ == 0 && nest_rest_s_ == 0 && recharge_ == 0) return false;
  search_s_ = carries || sees_prey ? 0 : search_s_ + tick_s;
  const bool is_in_vain = most_search_s_ > 0 && search_s_ > most_search_s_;
  // The prey is gone, and the robot has not let it loose itself.
  const bool has_delivered = nest_rest_s_ > 0 && carried_ && !carries && rest_s_ <= 0;
  const bool is_low = battery_ != nullptr && battery_->GetCharge() < recharge_;
  returns_ |= is_in_vain || has_delivered || (is_low && !carries);
  return returns_;
}

void CBTFootbotForager::Carry(CCI_FootBotState& cRobotState)
{
  cRobotState.SetGripper(1);
  if (const CCI_ColourBlob* nest = cRobotState.GetNearestColourBlob(kNest))
    BTFootbotSteer(cRobotState, nest->angle_rad, kSpeed);
  else
    wander_.Step(cRobotState);
}

void CBTFootbotForager::Return(CCI_FootBotState& cRobotState)
{
  cRobotState.SetGripper(0);
  cRobotState.SetAllLedColours(CCI_Colour::BLACK);
  if (cRobotState.GetFloorColour() == kNest && in_nest_s_ < 0) in_nest_s_ = nest_rest_s_;
  if (in_nest_s_ >= 0)
  {
    cRobotState.SetFootBotWheelsLinearVelocity(0, 0);
    in_nest_s_ -= cRobotState.GetTickSeconds();
    const bool charges = recharge_ > 0 && battery_ != nullptr && battery_->GetCharge() < kFull;
    if (charges) in_nest_s_ = std::max(in_nest_s_, 0.0);
    if (in_nest_s_ >= 0) return;
    returns_ = false;
    search_s_ = 0;
    return;
  }
  const CCI_ColourBlob* nest = cRobotState.GetNearestColourBlob(kNest);
  if (nest == nullptr) return wander_.Step(cRobotState);
  BTFootbotSteer(cRobotState, nest->angle_rad, kSpeed);
  avoid_.Step(cRobotState);
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
  for (const double number : {busy_s_, rest_s_, carried_ ? 1.0 : 0.0, search_s_, in_nest_s_, returns_ ? 1.0 : 0.0})
    BTSaveNumber(state, number);
  wander_.SaveState(state);
}

void CBTFootbotForager::LoadState(std::istream& state)
{
  busy_s_ = BTLoadNumber(state);
  rest_s_ = BTLoadNumber(state);
  carried_ = BTLoadNumber(state) != 0;
  search_s_ = BTLoadNumber(state);
  in_nest_s_ = BTLoadNumber(state);
  returns_ = BTLoadNumber(state) != 0;
  wander_.LoadState(state);
}

class CFootbotForager : public CCI_BehaviorController<CCI_FootBotState>
{
public:
  int Init(const TConfigurationTree t_tree) override
  {
    state_ = std::make_unique<CCI_FootBotState>(GetRobot());
    const CCI_BatterySensor* battery =
        GetRobot()->HasSensor("battery") ? &GetRobot()->Sensor<CCI_BatterySensor>("battery") : nullptr;
    behavior_ = std::make_unique<CBTFootbotForager>(t_tree.GetNumber("search"), t_tree.GetNumber("rest"),
                                                    t_tree.GetNumber("recharge"), battery);
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

REGISTER_CONTROLLER(CFootbotForager,
                    {.label = "footbot_forager",
                     .brief = "carries yellow preys to the green nest, and wanders between",
                     .parameters = {{.name = "search",
                                     .unit = "s",
                                     .default_value = "0",
                                     .description = "Time without a prey after which it returns to the nest; 0: never. "
                                                    "Needs the sensor footbot_ground.",
                                     .minimum = 0,
                                     .maximum = 1e6},
                                    {.name = "rest",
                                     .unit = "s",
                                     .default_value = "0",
                                     .description = "Rest in the nest after a delivery and a search in vain. Needs the "
                                                    "sensor footbot_ground.",
                                     .minimum = 0,
                                     .maximum = 1e6},
                                    {.name = "recharge",
                                     .default_value = "0",
                                     .description = "Charge (1 is full) below which it returns to the nest, until the "
                                                    "battery is nearly full. Needs the sensors battery and "
                                                    "footbot_ground.",
                                     .minimum = 0,
                                     .maximum = 0.9}}})
