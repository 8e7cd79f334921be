// The eyebot of the prey retrieval experiment (behaviour diagram: figure 4.6). It chooses one of the two preys at
// random, looks for it, marks it with the laser, and waits until a footbot grips it. Then it leads that footbot to the
// nest. If it does not find the nest for long, it flies back to where it saw the nest last, by dead reckoning.
#pragma once

#include <array>
#include <string>

#include "behavior/ci_behavior.h"
#include "behavior/ci_eyebot_state.h"
#include "behavior/fsm.h"
#include "eyebot/bt_eyebot_go_to.h"
#include "eyebot/bt_eyebot_hover.h"
#include "eyebot/bt_eyebot_search.h"

class CBTEyebotGuide : public CCI_Behavior<CCI_EyeBotState>, public FSM<std::string>
{
public:
  static constexpr unsigned int SEARCH_FOR_PREY = 0;
  static constexpr unsigned int GO_TO_PREY = 1;
  static constexpr unsigned int WAIT_FOR_FOOTBOT_GRIPPING = 2;
  static constexpr unsigned int SEARCH_FOR_NEST = 3;

  CBTEyebotGuide();

  void Step(CCI_EyeBotState& cRobotState) override;
  std::string StatusText() const override { return GetStateName(); }
  void SaveState(std::ostream& state) const override;
  void LoadState(std::istream& state) override;

private:
  void Fly(CCI_EyeBotState& cRobotState);
  std::string Transition(const CCI_EyeBotState& cRobotState) const;
  // Returns the footbot that seems to hold its prey; nullptr if it sees none.
  const CCI_ColourBlob* Carrier(const CCI_EyeBotState& cRobotState) const;
  void SearchForNest(CCI_EyeBotState& cRobotState);
  // Updates the place of the nest in the eyebot's frame.
  void RememberNest(const CCI_EyeBotState& cRobotState);
  void GoBack(CCI_EyeBotState& cRobotState);

  CBTEyebotSearch search_;
  CBTEyebotSearch slow_search_;
  CBTEyebotGoTo go_to_prey_;
  CBTEyebotGoTo go_to_nest_;
  CBTEyebotHover hover_;
  std::uint32_t prey_colour_ = 0;  // 0: not chosen yet
  double since_footbot_s_ = 0;     // since the carrying footbot was last seen
  bool knows_nest_ = false;        // it has seen the nest, and has not missed it at the remembered place
  double nest_x_ = 0;              // m, forward: the remembered place of the nest
  double nest_y_ = 0;              // m, to the left
  std::array<double, 4> flown_{};  // the velocity of the previous step: m/s forward, left and up, rad/s
  double searched_s_ = 0;          // time of the search for the nest
  double waited_s_ = 0;            // time of waiting for a footbot that does not follow
  bool fetching_ = false;          // the eyebot flies back to the footbot
};
