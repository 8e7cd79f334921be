// The actions of keys and of the buttons for them.
#include "visualiser/interaction/viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

constexpr double kOrbitStep = 5;  // degrees of an arrow key
constexpr double kZoomStep = 0.85;
// 0, which means as fast as possible, comes after the last one.
constexpr std::array kSpeeds{0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0};

}  // namespace

void Viewer::Press(const KeyPress& press)
{
  const std::optional<KeyCommand> command = CommandOf(press);
  const bool ends = command && command->action == Action::kKeysToFunctions;
  const std::string name = NameOfKey(press.key);
  if (gives_keys_ && !ends && !press.ctrl && !name.empty())
  {
    if (std::find(given_keys_.begin(), given_keys_.end(), press.key) != given_keys_.end()) return;
    given_keys_.push_back(press.key);
    return setup_.control->PressKey(name, true);
  }
  if (command) Do(*command);
}

void Viewer::Release(int key)
{
  if (std::erase(given_keys_, key) != 0) setup_.control->PressKey(NameOfKey(key), false);
}

void Viewer::ToggleKeys()
{
  if (!CanControl()) return Say("this visualisation may only watch", true);
  if (GetExperiment().functions.empty()) return Say("the experiment has no functions that keys could go to", true);
  if (gives_keys_)
  {
    for (const int key : std::exchange(given_keys_, {})) setup_.control->PressKey(NameOfKey(key), false);
    if (shown.scene.selected) setup_.control->SelectEntity({});
  }
  gives_keys_ = !gives_keys_;
  if (gives_keys_ && shown.scene.selected)
    setup_.control->SelectEntity(Space().GetEntity(*shown.scene.selected).GetId());
  Say(gives_keys_ ? "keys and selections go to the experiment functions; F8 ends it" : "keys are the window's again");
}

void Viewer::Do(const KeyCommand& command)
{
  switch (command.action)
  {
    case Action::kHelp:
      shown.help = !shown.help || !shown.panels;
      shown.panels |= shown.help;
      break;
    case Action::kRunPanel:
      shown.run = !shown.run;
      break;
    case Action::kEntityPanel:
      shown.entities = !shown.entities;
      break;
    case Action::kPlotPanel:
      shown.plots = !shown.plots;
      if (shown.plots && plots_.empty()) Say("choose what to plot with the dots before the values of an inspector");
      break;
    case Action::kTimelinePanel:
      shown.timeline = !shown.timeline;
      if (shown.timeline) MayLookBack();
      break;
    case Action::kAllPanels:
      shown.panels = !shown.panels;
      break;
    case Action::kPause:
      TogglePause();
      break;
    case Action::kStep:
    case Action::kStepTen:
      if (CanControl()) setup_.control->Step(command.action == Action::kStep ? 1 : 10);
      break;
    case Action::kFaster:
      ChangeSpeed(1);
      break;
    case Action::kSlower:
      ChangeSpeed(-1);
      break;
    case Action::kTickBack:
    case Action::kTickForward:
      LookBackBy(command.action == Action::kTickBack ? -1 : 1);
      break;
    case Action::kEventBack:
    case Action::kEventForward:
      LookBackAtEvent(command.action == Action::kEventForward);
      break;
    case Action::kPlayPast:
      if (MayLookBack()) past_.TogglePlay(Clock::now());
      break;
    case Action::kPresent:
      past_.GoLive();
      followed_place_.reset();
      break;
    case Action::kBranch:
      CopyBranchCommand();
      break;
    case Action::kInspectPast:
      CopyInspectCommand();
      break;
    case Action::kTextures:
      Toggle(shown.textures, "textures");
      break;
    case Action::kShadows:
      Toggle(shown.shadows, "shadows");
      break;
    case Action::kCollisionModels:
      Toggle(shown.scene.collision_models, "collision models");
      break;
    case Action::kIds:
      Toggle(shown.scene.ids, "ids");
      break;
    case Action::kTrails:
      Toggle(shown.scene.trails, "trails");
      break;
    case Action::kRays:
      Toggle(shown.scene.rays, "rays");
      break;
    case Action::kBeams:
      Toggle(shown.scene.beams, "laser beams");
      break;
    case Action::kFollow:
      if (!shown.scene.selected)
        Say("click on an entity first, then F follows it");
      else
        Toggle(follows, fmt::format("following '{}'", Space().GetEntity(*shown.scene.selected).GetId()));
      followed_place_.reset();
      break;
    case Action::kDeselect:
      if (shown.help)
        shown.help = false;
      else
        Deselect();
      break;
    case Action::kKeysToFunctions:
      ToggleKeys();
      break;
    case Action::kWholeArena:
    case Action::kFromAbove:
      follows = false;
      ShowWholeArena(command.action == Action::kFromAbove);
      break;
    case Action::kRecall:
      if (const std::optional<Camera>& view = viewpoints_.At(command.number))
      {
        camera = *view;
        follows = whole_arena_ = false;
        Say(fmt::format("viewpoint {}", command.number));
      }
      else
        Say(fmt::format("there is no viewpoint {0}; Ctrl-Shift-{0} stores this one", command.number), true);
      break;
    case Action::kStore:
      StoreViewpoint(command.number);
      break;
    case Action::kOrbitLeft:
    case Action::kOrbitRight:
      camera.Orbit(Pivot(), command.action == Action::kOrbitLeft ? -kOrbitStep : kOrbitStep, 0);
      whole_arena_ = false;
      break;
    case Action::kOrbitUp:
    case Action::kOrbitDown:
      camera.Orbit(Pivot(), 0, command.action == Action::kOrbitUp ? kOrbitStep : -kOrbitStep);
      whole_arena_ = false;
      break;
    case Action::kZoomIn:
    case Action::kZoomOut:
      camera.Zoom(Pivot(), command.action == Action::kZoomIn ? kZoomStep : 1 / kZoomStep);
      whole_arena_ = false;
      break;
    case Action::kPicture:
      picture_ = true;
      break;
    case Action::kClose:
      close_ = true;
      break;
    case Action::kMouse:
      break;
  }
}

void Viewer::Toggle(bool& option, const std::string& what)
{
  option = !option;
  Say(what + (option ? " on" : " off"));
}

void Viewer::StoreViewpoint(int number)
{
  viewpoints_.Store(number, camera);
  stored_xml_ = ViewpointXml(number, camera);
  copy_ = stored_xml_;
  fmt::print("{}\n", stored_xml_);
  std::fflush(stdout);
  Say(fmt::format("viewpoint {} stored; its XML is printed and in the clipboard", number));
}

void Viewer::TogglePause()
{
  if (!CanControl()) return Say("this visualisation may only watch", true);
  if (Status().phase == RunStatus::Phase::kPaused)
    setup_.control->Resume();
  else
    setup_.control->Pause();
}

void Viewer::ChangeSpeed(int steps)
{
  // Finds the next speed in the list above or below the current one.
  const double wanted = Status().speed_wanted;
  double next = 0;
  if (steps > 0 && wanted > 0)
  {
    const auto above = std::find_if(kSpeeds.begin(), kSpeeds.end(), [&](double speed) { return speed > wanted; });
    next = above == kSpeeds.end() ? 0 : *above;
  }
  else if (steps < 0)
  {
    const auto below =
        std::find_if(kSpeeds.rbegin(), kSpeeds.rend(), [&](double speed) { return wanted == 0 || speed < wanted; });
    next = below == kSpeeds.rend() ? kSpeeds.front() : *below;
  }
  SetSpeed(next);
}

}  // namespace swarmanoid
