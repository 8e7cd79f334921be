#include "eyebot_guide.h"

#include <istream>
#include <ostream>

#include "bt_numbers.h"
#include "prey_retrieval_colours.h"

using namespace prey_retrieval;

namespace
{

constexpr double kSearchSpeed = 0.25;   // m/s
constexpr double kLeadingSpeed = 0.12;  // m/s: slower than a footbot that follows
constexpr double kAtPrey = 0.08;        // m
constexpr double kBesidePrey = 0.2;     // rad of tilt: the spot falls beside the prey, where it is seen
constexpr double kFootbotNear = 0.5;    // m: a footbot farther off is waited for
constexpr double kFootbotClose = 0.25;  // m
constexpr double kWaitFor = 5;          // s: then it is fetched, for something hides the spot from it
constexpr double kPatience = 60;        // s without the footbot before the prey is looked for again

}  // namespace

CBTEyebotGuide::CBTEyebotGuide()
    : CCI_Behavior("guide"),
      search_(kSearchSpeed),
      slow_search_(kLeadingSpeed, 10),
      go_to_prey_(0, kSearchSpeed, kAtPrey),
      go_to_nest_(kNest, kLeadingSpeed, 0.02),
      go_to_footbot_(kGripping, kLeadingSpeed)
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
  if (prey_colour_ == 0)
  {
    prey_colour_ = kPreys[cRobotState.GetRandom().Below(2)];
    go_to_prey_.SetColour(prey_colour_);
  }
  since_footbot_s_ =
      cRobotState.GetNearestColourBlob(kGripping) != nullptr ? 0 : since_footbot_s_ + cRobotState.GetTickSeconds();
  input(Transition(cRobotState));

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

void CBTEyebotGuide::SearchForNest(CCI_EyeBotState& cRobotState)
{
  const CCI_ColourBlob* footbot = cRobotState.GetNearestColourBlob(kGripping);
  if (footbot == nullptr) return;  // it comes
  if (footbot->distance_m <= (fetching_ ? kFootbotClose : kFootbotNear))
  {
    fetching_ = false;
    waited_s_ = 0;
  }
  else
  {
    waited_s_ += cRobotState.GetTickSeconds();
    fetching_ = waited_s_ > kWaitFor;
    if (fetching_) go_to_footbot_.Step(cRobotState);
    return;
  }
  slow_search_.Step(cRobotState);
  go_to_nest_.Step(cRobotState);
}

void CBTEyebotGuide::SaveState(std::ostream& state) const
{
  state << GetStateID() << ' ' << prey_colour_ << ' ';
  BTSaveNumber(state, since_footbot_s_);
  BTSaveNumber(state, waited_s_);
  state << fetching_ << ' ';
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
  state >> fetching_;
  search_.LoadState(state);
  slow_search_.LoadState(state);
}
