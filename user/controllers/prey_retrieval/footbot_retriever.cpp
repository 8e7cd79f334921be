// The footbot knows no positions: it acts on what its camera sees, the laser spot, preys and the blue LEDs of a robot
// that carries. Three deadlocks are broken by time or chance: gripping is given up after a while, a prey that a wall
// holds is pulled off backwards, and of two robots that grip at the same time one lets go at random.
#include "footbot_retriever.h"

#include <cmath>
#include <istream>
#include <ostream>

#include "bt_numbers.h"
#include "ci_colour.h"
#include "common/math/elementary.h"
#include "footbot/bt_footbot_drive.h"
#include "prey_retrieval_colours.h"

using namespace swarmanoid;
using namespace prey_retrieval;

namespace
{

constexpr double kSpeed = 0.20;          // m/s
constexpr double kWanderSpeed = 0.28;    // m/s
constexpr double kCarryingSpeed = 0.15;  // m/s
constexpr double kAtLaser = 0.45;        // m from the spot: the robot looks for the prey beside it
constexpr double kRepulsion = 3;         // weight of obstacles against the way to the laser
constexpr double kGripPatience = 25;     // s of attempts before the robot looks for the laser again
constexpr double kAside = 0.4;           // rad: if the spot is farther aside, the robot turns
constexpr double kHeldBack = 4;          // s of turning, several times the usual time: a wall holds the prey
constexpr double kBackFor = 1.5;         // s
constexpr double kGiveWay = 0.02;        // probability in each tick
constexpr double kAvoidFor = 6;          // s after a carrying footbot was last seen

const CCI_ColourBlob* NearestPrey(const CCI_FootBotState& cRobotState)
{
  const CCI_ColourBlob* nearest = nullptr;
  for (const std::uint32_t colour : kPreys)
  {
    const CCI_ColourBlob* prey = cRobotState.GetNearestColourBlob(colour);
    if (prey != nullptr && (nearest == nullptr || prey->distance_m < nearest->distance_m)) nearest = prey;
  }
  return nearest;
}

}  // namespace

CBTFootbotRetriever::CBTFootbotRetriever()
    : CCI_Behavior("prey retrieval"),
      wander_(kWanderSpeed),
      avoid_(CBTFootbotObstacleAvoidance::VERSION_VECTOR_BASED, kSpeed),
      grip_(kPreys[0]),
      follow_laser_(kLaser, kCarryingSpeed)
{
  State<std::string>* search = initializeState(this, SEARCH_FOR_LASER, "[SEARCH FOR LASER]");
  State<std::string>* go = initializeState(this, GO_TO_LASER, "[GO TO LASER]");
  State<std::string>* grip = initializeState(this, GRIP_PREY, "[GRIP PREY]");
  State<std::string>* nest = initializeState(this, GO_TO_NEST, "[GO TO NEST]");
  State<std::string>* avoid = initializeState(this, AVOID_GRIPPING_FOOTBOT, "[AVOID GRIPPING FOOTBOT]");
  search->addTransition("laserSeen", go);
  search->addTransition("grippingFootbotSeen", avoid);
  go->addTransition("laserLost", search);
  go->addTransition("preyReached", grip);
  go->addTransition("grippingFootbotSeen", avoid);
  grip->addTransition("preyGripped", nest);
  grip->addTransition("preyLost", search);
  grip->addTransition("grippingFootbotSeen", avoid);
  nest->addTransition("preyLost", search);
  nest->addTransition("grippingFootbotSeen", avoid);
  avoid->addTransition("grippingFootbotGone", search);
  setStartState(search);
}

void CBTFootbotRetriever::Step(CCI_FootBotState& cRobotState)
{
  const double tick = cRobotState.GetTickSeconds();
  in_state_s_ += tick;
  // The robot does not see its own LEDs.
  since_signal_s_ = cRobotState.GetNearestColourBlob(kGripping) != nullptr ? 0 : since_signal_s_ + tick;
  if (input(Transition(cRobotState))) in_state_s_ = held_back_s_ = backing_s_ = 0;

  cRobotState.SetAllLedColours(GetStateID() == GO_TO_NEST ? kGripping : CCI_Colour::BLACK);
  switch (GetStateID())
  {
    case SEARCH_FOR_LASER:
      return SearchForLaser(cRobotState);
    case GO_TO_LASER:
      return GoToLaser(cRobotState);
    case GRIP_PREY:
      return GripPrey(cRobotState);
    case GO_TO_NEST:
      return GoToNest(cRobotState);
    default:
      return AvoidGrippingFootbot(cRobotState);
  }
}

std::string CBTFootbotRetriever::Transition(CCI_FootBotState& cRobotState) const
{
  const CCI_ColourBlob* laser = cRobotState.GetNearestColourBlob(kLaser);
  const CCI_ColourBlob* prey = NearestPrey(cRobotState);
  const bool signal = since_signal_s_ == 0;
  switch (GetStateID())
  {
    case SEARCH_FOR_LASER:
      if (signal) return "grippingFootbotSeen";
      return laser != nullptr ? "laserSeen" : "";
    case GO_TO_LASER:
      if (signal) return "grippingFootbotSeen";
      if (laser == nullptr) return "laserLost";
      return laser->distance_m <= kAtLaser && prey != nullptr ? "preyReached" : "";
    case GRIP_PREY:
      if (cRobotState.IsGripping()) return "preyGripped";
      if (signal) return "grippingFootbotSeen";
      return prey == nullptr || in_state_s_ > kGripPatience ? "preyLost" : "";
    case GO_TO_NEST:
      if (!cRobotState.IsGripping()) return "preyLost";
      // Two robots that grip at the same time block each other, so one of them gives way at random.
      return signal && cRobotState.GetRandom().Uniform() < kGiveWay ? "grippingFootbotSeen" : "";
    default:
      return since_signal_s_ > kAvoidFor ? "grippingFootbotGone" : "";
  }
}

void CBTFootbotRetriever::SearchForLaser(CCI_FootBotState& cRobotState)
{
  cRobotState.SetGripper(0);
  wander_.Step(cRobotState);
}

void CBTFootbotRetriever::GoToLaser(CCI_FootBotState& cRobotState)
{
  cRobotState.SetGripper(0);
  const CCI_ColourBlob* laser = cRobotState.GetNearestColourBlob(kLaser);
  if (laser == nullptr) return;
  // The prey beside the spot is no obstacle; other robots are. Both directions are added: with a priority, two robots
  // could stand face to face for ever.
  SinCos wish = SinCosOf(laser->angle_rad);
  if (NearestPrey(cRobotState) == nullptr)
  {
    const BTVector obstacle = BTFootbotProximityVector(cRobotState);
    const SinCos direction = SinCosOf(obstacle.angle);
    wish.cos -= kRepulsion * obstacle.length * direction.cos;
    wish.sin -= kRepulsion * obstacle.length * direction.sin;
  }
  BTFootbotSteer(cRobotState, Atan2(wish.sin, wish.cos), kSpeed);
}

void CBTFootbotRetriever::GripPrey(CCI_FootBotState& cRobotState)
{
  const CCI_ColourBlob* prey = NearestPrey(cRobotState);
  if (prey != nullptr) grip_.SetColour(prey->colour);
  grip_.Step(cRobotState);
}

void CBTFootbotRetriever::GoToNest(CCI_FootBotState& cRobotState)
{
  cRobotState.SetGripper(1);
  follow_laser_.Step(cRobotState);
  // A prey at a wall cannot swing past it, so the robot first pulls it off.
  const double tick = cRobotState.GetTickSeconds();
  const CCI_ColourBlob* laser = cRobotState.GetNearestColourBlob(kLaser);
  const bool aside = laser != nullptr && !follow_laser_.HasArrived() && std::abs(laser->angle_rad) > kAside;
  held_back_s_ = aside ? held_back_s_ + tick : 0;
  if (held_back_s_ > kHeldBack)
  {
    held_back_s_ = 0;
    backing_s_ = kBackFor;
  }
  if (backing_s_ <= 0) return;
  backing_s_ -= tick;
  cRobotState.SetFootBotWheelsLinearVelocity(-kCarryingSpeed, -kCarryingSpeed);
}

void CBTFootbotRetriever::AvoidGrippingFootbot(CCI_FootBotState& cRobotState)
{
  cRobotState.SetGripper(0);
  const CCI_ColourBlob* signal = cRobotState.GetNearestColourBlob(kGripping);
  if (signal != nullptr)
    BTFootbotSteer(cRobotState, signal->angle_rad + kPi, kSpeed);
  else
    wander_.Step(cRobotState);
  avoid_.Step(cRobotState);
}

void CBTFootbotRetriever::SaveState(std::ostream& state) const
{
  state << GetStateID() << ' ';
  BTSaveNumber(state, in_state_s_);
  BTSaveNumber(state, held_back_s_);
  BTSaveNumber(state, backing_s_);
  BTSaveNumber(state, since_signal_s_);
  wander_.SaveState(state);
}

void CBTFootbotRetriever::LoadState(std::istream& state)
{
  unsigned int id = 0;
  state >> id;
  RestoreState(id);
  in_state_s_ = BTLoadNumber(state);
  held_back_s_ = BTLoadNumber(state);
  backing_s_ = BTLoadNumber(state);
  since_signal_s_ = BTLoadNumber(state);
  wander_.LoadState(state);
}
