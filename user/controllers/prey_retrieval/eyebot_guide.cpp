// The difficult part is the way to the nest, which may be out of sight for minutes. The eyebot searches slowly enough
// for the footbot to follow the laser spot, waits when the footbot falls behind, and fetches it when something hides
// the spot. The nest's place is remembered in the eyebot's own frame and moved against its commanded velocity in each
// step; the memory is given up when the place is reached without a nest in sight. The footbot that carries the prey is
// the one with blue LEDs nearest to the prey, because another one may carry the other prey.
#include "eyebot_guide.h"

#include <algorithm>
#include <istream>
#include <ostream>

#include "bt_numbers.h"
#include "common/math/elementary.h"
#include "prey_retrieval_colours.h"

using namespace swarmanoid;
using namespace prey_retrieval;

namespace
{

constexpr double kSearchSpeed = 0.25;   // m/s
constexpr double kLeadingSpeed = 0.12;  // m/s: slower than a following footbot
constexpr double kAtPrey = 0.08;        // m
constexpr double kBesidePrey = 0.2;     // rad of tilt: the spot falls beside the prey, where the footbot sees it
constexpr double kFootbotNear = 0.5;    // m: the guide waits for a footbot that is farther away
constexpr double kFootbotClose = 0.25;  // m
constexpr double kWaitFor = 5;          // s: then the guide fetches it, since something hides the spot
constexpr double kSearchFor = 200;      // s: then the guide returns to the remembered place of the nest
constexpr double kHeldWithin = 0.35;    // m: greatest distance from a prey to the footbot that holds it
constexpr double kAtPlace = 0.3;        // m: distance that counts as arrived
constexpr double kPatience = 60;        // s without the footbot, before the guide looks for the prey again

}  // namespace

CBTEyebotGuide::CBTEyebotGuide()
    : CCI_Behavior("guide"),
      search_(kSearchSpeed),
      slow_search_(kLeadingSpeed, 10),
      go_to_prey_(0, kSearchSpeed, kAtPrey),
      go_to_nest_(kNest, kLeadingSpeed, 0.02)
{
  State<std::string>* search = initializeState(this, SEARCH_FOR_PREY, "[SEARCH FOR PREY]");
  State<std::string>* go = initializeState(this, GO_TO_PREY, "[GO TO PREY]");
  State<std::string>* wait = initializeState(this, WAIT_FOR_FOOTBOT_GRIPPING, "[WAIT FOR FOOTBOT GRIPPING]");
  State<std::string>* nest = initializeState(this, SEARCH_FOR_NEST, "[SEARCH FOR NEST]");
  search->addTransition("preySeen", go);
  go->addTransition("preyLost", search);
  go->addTransition("preyReached", wait);
  wait->addTransition("preyLost", search);
  wait->addTransition("footbotGripping", nest);
  nest->addTransition("footbotLost", search);
  setStartState(search);
}

void CBTEyebotGuide::Step(CCI_EyeBotState& cRobotState)
{
  Fly(cRobotState);
  flown_ = cRobotState.GetVelocity();
}

void CBTEyebotGuide::Fly(CCI_EyeBotState& cRobotState)
{
  if (prey_colour_ == 0)
  {
    prey_colour_ = kPreys[cRobotState.GetRandom().Below(2)];
    go_to_prey_.SetColour(prey_colour_);
  }
  since_footbot_s_ = Carrier(cRobotState) != nullptr ? 0 : since_footbot_s_ + cRobotState.GetTickSeconds();
  RememberNest(cRobotState);
  if (input(Transition(cRobotState))) searched_s_ = 0;

  if (GetStateID() == SEARCH_FOR_PREY)
    cRobotState.SwitchLaserOff();
  else
    cRobotState.SwitchLaserOn(kLaser);
  cRobotState.SetLaserDirection(0, GetStateID() == SEARCH_FOR_NEST ? 0 : kBesidePrey);
  hover_.Step(cRobotState);
  switch (GetStateID())
  {
    case SEARCH_FOR_PREY:
      return search_.Step(cRobotState);
    case GO_TO_PREY:
    case WAIT_FOR_FOOTBOT_GRIPPING:
      return go_to_prey_.Step(cRobotState);
    default:
      return SearchForNest(cRobotState);
  }
}

std::string CBTEyebotGuide::Transition(const CCI_EyeBotState& cRobotState) const
{
  const CCI_ColourBlob* prey = cRobotState.GetNearestColourBlob(prey_colour_);
  switch (GetStateID())
  {
    case SEARCH_FOR_PREY:
      return prey != nullptr ? "preySeen" : "";
    case GO_TO_PREY:
      if (prey == nullptr) return "preyLost";
      return prey->distance_m <= kAtPrey ? "preyReached" : "";
    case WAIT_FOR_FOOTBOT_GRIPPING:
      if (since_footbot_s_ == 0) return "footbotGripping";
      return prey == nullptr ? "preyLost" : "";
    default:
      return since_footbot_s_ > kPatience ? "footbotLost" : "";
  }
}

const CCI_ColourBlob* CBTEyebotGuide::Carrier(const CCI_EyeBotState& cRobotState) const
{
  const auto place = [](const CCI_ColourBlob& blob)
  {
    const SinCos direction = SinCosOf(blob.angle_rad);
    return Vector2(blob.distance_m * direction.cos, blob.distance_m * direction.sin);
  };
  // Another footbot may have gripped the other prey.
  const CCI_ColourBlob* prey = cRobotState.GetNearestColourBlob(prey_colour_);
  if (prey == nullptr) return cRobotState.GetNearestColourBlob(kGripping);
  const CCI_ColourBlob* carrier = nullptr;
  double nearest = kHeldWithin * kHeldWithin;
  for (const CCI_ColourBlob& blob : cRobotState.GetColourBlobs())
  {
    const double square = (place(blob) - place(*prey)).squaredNorm();
    if (CCI_Colour::Nearest(blob.colour) != kGripping || square > nearest) continue;
    nearest = square;
    carrier = &blob;
  }
  return carrier;
}

void CBTEyebotGuide::SearchForNest(CCI_EyeBotState& cRobotState)
{
  const CCI_ColourBlob* footbot = Carrier(cRobotState);
  if (footbot == nullptr) return;  // the footbot is on its way
  if (footbot->distance_m <= (fetching_ ? kFootbotClose : kFootbotNear))
  {
    fetching_ = false;
    waited_s_ = 0;
  }
  else
  {
    waited_s_ += cRobotState.GetTickSeconds();
    fetching_ = waited_s_ > kWaitFor;
    if (!fetching_) return;
    const SinCos direction = SinCosOf(footbot->angle_rad);
    const double speed = std::min(kLeadingSpeed, footbot->distance_m);
    return cRobotState.SetVelocity(speed * direction.cos, speed * direction.sin, 0, 0);
  }
  searched_s_ += cRobotState.GetTickSeconds();
  if (searched_s_ > kSearchFor && knows_nest_)
    GoBack(cRobotState);
  else
    slow_search_.Step(cRobotState);
  go_to_nest_.Step(cRobotState);
}

// Walls that stop the eyebot make the memory wrong, since the eyebot assumes that it has flown farther.
void CBTEyebotGuide::RememberNest(const CCI_EyeBotState& cRobotState)
{
  if (const CCI_ColourBlob* nest = cRobotState.GetNearestColourBlob(kNest))
  {
    const SinCos direction = SinCosOf(nest->angle_rad);
    knows_nest_ = true;
    nest_x_ = nest->distance_m * direction.cos;
    nest_y_ = nest->distance_m * direction.sin;
    return;
  }
  if (!knows_nest_) return;
  const auto& [forward, left, up, yaw_rate] = flown_;
  const double tick = cRobotState.GetTickSeconds();
  const SinCos turn = SinCosOf(-yaw_rate * tick);
  const double x = nest_x_ - forward * tick;
  const double y = nest_y_ - left * tick;
  nest_x_ = turn.cos * x - turn.sin * y;
  nest_y_ = turn.sin * x + turn.cos * y;
  if (nest_x_ * nest_x_ + nest_y_ * nest_y_ < kAtPlace * kAtPlace) knows_nest_ = false;
}

void CBTEyebotGuide::GoBack(CCI_EyeBotState& cRobotState)
{
  const SinCos direction = SinCosOf(Atan2(nest_y_, nest_x_));
  cRobotState.SetVelocity(kLeadingSpeed * direction.cos, kLeadingSpeed * direction.sin, 0, 0);
}

void CBTEyebotGuide::SaveState(std::ostream& state) const
{
  state << GetStateID() << ' ' << prey_colour_ << ' ';
  BTSaveNumber(state, since_footbot_s_);
  BTSaveNumber(state, waited_s_);
  BTSaveNumber(state, searched_s_);
  BTSaveNumber(state, nest_x_);
  BTSaveNumber(state, nest_y_);
  for (const double speed : flown_) BTSaveNumber(state, speed);
  state << fetching_ << ' ' << knows_nest_ << ' ';
  search_.SaveState(state);
  slow_search_.SaveState(state);
}

void CBTEyebotGuide::LoadState(std::istream& state)
{
  unsigned int id = 0;
  state >> id >> prey_colour_;
  RestoreState(id);
  go_to_prey_.SetColour(prey_colour_);
  since_footbot_s_ = BTLoadNumber(state);
  waited_s_ = BTLoadNumber(state);
  searched_s_ = BTLoadNumber(state);
  nest_x_ = BTLoadNumber(state);
  nest_y_ = BTLoadNumber(state);
  for (double& speed : flown_) speed = BTLoadNumber(state);
  state >> fetching_ >> knows_nest_;
  search_.LoadState(state);
  slow_search_.LoadState(state);
}
