// Controllers of the tests: one behaviour of the toolkit each, named by the parameter <behavior>.
#include <functional>
#include <map>
#include <stdexcept>
#include <string>

#include "behavior/ci_behavior_controller.h"
#include "ci_colour.h"
#include "eyebot/bt_eyebot_follow.h"
#include "eyebot/bt_eyebot_go_to.h"
#include "eyebot/bt_eyebot_hover.h"
#include "eyebot/bt_eyebot_search.h"
#include "footbot/bt_footbot_flocking.h"
#include "footbot/bt_footbot_follow_laser.h"
#include "footbot/bt_footbot_go_to_blob.h"
#include "footbot/bt_footbot_go_to_light.h"
#include "footbot/bt_footbot_grip.h"
#include "footbot/bt_footbot_random_walk_with_obstacle_avoidance.h"
#include "handbot/bt_handbot_climb.h"
#include "handbot/bt_handbot_grasp.h"

namespace
{

// It is a behaviour that is given by a function.
template <class State>
class Does : public CCI_Behavior<State>
{
public:
  explicit Does(std::function<void(State&)> what) : what_(std::move(what)) {}
  void Step(State& state) override { what_(state); }

private:
  std::function<void(State&)> what_;
};

// The behaviours run one after the other.
template <class State>
class Sequence : public CCI_Behavior<State>
{
public:
  Sequence(CCI_Behavior<State>* first, CCI_Behavior<State>* second) : first_(first), second_(second) {}
  ~Sequence() override
  {
    delete first_;
    delete second_;
  }
  void Step(State& state) override
  {
    first_->Step(state);
    second_->Step(state);
  }

private:
  CCI_Behavior<State>* first_;
  CCI_Behavior<State>* second_;
};

using Footbot = CCI_FootBotState;
using Eyebot = CCI_EyeBotState;
using Handbot = CCI_HandBotState;
template <class State>
using Factory = std::function<CCI_Behavior<State>*()>;
template <class State>
using Factories = std::map<std::string, Factory<State>>;

template <class State>
Does<State>* Do(std::function<void(State&)> what)
{
  return new Does<State>(std::move(what));
}

CCI_Behavior<Footbot>* Straight()
{
  return Do<Footbot>([](Footbot& state) { state.SetFootBotWheelsLinearVelocity(0.1, 0.1); });
}

CCI_Behavior<Footbot>* Leds(std::uint32_t colour)
{
  return Do<Footbot>([colour](Footbot& state) { state.SetAllLedColours(colour); });
}

const Factories<Footbot> footbots{
    {"random_walk", [] { return new CBTFootbotRandomWalk(); }},
    {"avoid_by_vector",
     []
     {
       return new Sequence<Footbot>(Straight(),
                                    new CBTFootbotObstacleAvoidance(CBTFootbotObstacleAvoidance::VERSION_VECTOR_BASED));
     }},
    {"avoid_by_weights",
     []
     {
       return new Sequence<Footbot>(Straight(),
                                    new CBTFootbotObstacleAvoidance(CBTFootbotObstacleAvoidance::VERSION_BRAITENBERG));
     }},
    {"wander", [] { return new CBTFootbotRandomWalkWithObstacleAvoidance(); }},
    {"go_to_light", [] { return new CBTFootbotGoToLight(); }},
    {"flee_light", [] { return new CBTFootbotGoToLight(0.1, true); }},
    {"go_to_blue", [] { return new CBTFootbotGoToBlob(CCI_Colour::BLUE, 0.1, 0.3); }},
    {"flock", [] { return new Sequence<Footbot>(Leds(CCI_Colour::RED), new CBTFootbotFlocking(CCI_Colour::RED)); }},
    {"grip", [] { return new CBTFootbotGrip(CCI_Colour::YELLOW); }},
    {"follow_laser", [] { return new CBTFootbotFollowLaser(); }},
    {"show_blue", [] { return Leds(CCI_Colour::BLUE); }},
    {"show_red", [] { return Leds(CCI_Colour::RED); }},
    {"show_floor", [] { return Do<Footbot>([](Footbot& state) { state.SetAllLedColours(state.GetFloorColour()); }); }},
    {"drive_blue", [] { return new Sequence<Footbot>(Straight(), Leds(CCI_Colour::BLUE)); }}};

const Factories<Eyebot> eyebots{{"hover", [] { return new CBTEyebotHover(); }},
                                {"hover_at_1", [] { return new CBTEyebotHover(1.0); }},
                                {"search", [] { return new CBTEyebotSearch(); }},
                                {"go_to_blue", [] { return new CBTEyebotGoTo(CCI_Colour::BLUE); }},
                                {"follow_blue", [] { return new CBTEyebotFollow(CCI_Colour::BLUE); }},
                                // Flies east with the laser on, and switches it off after 20 s.
                                {"lead", []
                                 {
                                   return Do<Eyebot>(
                                       [](Eyebot& state)
                                       {
                                         const bool on = state.GetTick() < 200;
                                         on ? state.SwitchLaserOn(CCI_Colour::RED) : state.SwitchLaserOff();
                                         state.SetVelocity(0.06, 0, 0, 0);
                                       });
                                 }}};

const Factories<Handbot> handbots{{"climb", [] { return new CBTHandbotClimb(1.0); }},
                                  {"grasp", [] { return new CBTHandbotGrasp(); }}};

template <class State>
const Factories<State>& Known();
template <>
const Factories<Footbot>& Known<Footbot>()
{
  return footbots;
}
template <>
const Factories<Eyebot>& Known<Eyebot>()
{
  return eyebots;
}
template <>
const Factories<Handbot>& Known<Handbot>()
{
  return handbots;
}

template <class State>
class Probe : public CCI_BehaviorController<State>
{
public:
  int Init(const TConfigurationTree t_tree) override
  {
    this->m_pcState = new State(this->GetRobot());
    this->m_pcState->Init();
    this->m_pcRootBehavior = Known<State>().at(t_tree.GetText("behavior"))();
    this->m_pcRootBehavior->Init();
    return CCI_Controller::RETURN_OK;
  }
  void Destroy() override
  {
    this->m_pcRootBehavior->Destroy();
    delete this->m_pcState;
    delete this->m_pcRootBehavior;
  }
};

using FootbotProbe = Probe<Footbot>;
using EyebotProbe = Probe<Eyebot>;
using HandbotProbe = Probe<Handbot>;

}  // namespace

REGISTER_CONTROLLER(FootbotProbe, "footbot_probe")
REGISTER_CONTROLLER(EyebotProbe, "eyebot_probe")
REGISTER_CONTROLLER(HandbotProbe, "handbot_probe")
