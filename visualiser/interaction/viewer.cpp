#include "visualiser/interaction/viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "common/logging/log.h"
#include "common/math/elementary.h"

namespace swarmanoid
{
namespace
{

constexpr auto kMessageTime = std::chrono::seconds(6);
constexpr std::size_t kMostMessages = 5;
constexpr double kOrbitStep = 5;  // degrees of an arrow key
constexpr double kZoomStep = 0.85;
// 0, as fast as possible, comes after the last.
constexpr std::array kSpeeds{0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0};

std::string NoteName(const RunNote& note) { return fmt::format("{} {}", note.tick, note.text); }

}  // namespace

Viewer::Viewer(const RenderSetup& setup, int width, int height)
    : setup_(setup),
      scene_(setup.space),
      viewpoints_(setup.parameters),
      filter_(setup.space, setup.assignment),
      width_(width),
      height_(height)
{
  const Parameters& parameters = setup.parameters;
  shown.textures = parameters.Boolean("use_textures");
  shown.shadows = parameters.Boolean("use_shadows");
  shown.scene.ids = parameters.Boolean("show_ids");
  shown.scene.trails = parameters.Boolean("show_trails");
  shown.scene.rays = parameters.Boolean("show_rays");
  shown.scene.collision_models = parameters.Boolean("show_collision_models");
  no_status_.phase = RunStatus::Phase::kUnknown;
  if (viewpoints_.First())
    camera = *viewpoints_.First();
  else
    ShowWholeArena(false);
}

void Viewer::SetSize(int width, int height, int left)
{
  if (width == width_ && height == height_ && left == left_) return;
  width_ = width;
  height_ = height;
  left_ = left;
  if (whole_arena_) ShowWholeArena(camera.pitch < -80);
}

void Viewer::ShowWholeArena(bool from_above)
{
  const double free = std::max(width_ - left_, width_ / 2);
  camera = DefaultView(GetExperiment(), free / height_, from_above);
  // The middle of the arena to the middle of what no panel hides.
  const Vector3 middle = GetExperiment().arena_size.cwiseProduct(Vector3(0.5, 0.5, 0));
  camera.Pan(-left_ / 2.0 * MetresPerPixel(middle), 0);
  whole_arena_ = true;
}

void Viewer::Press(const KeyPress& press)
{
  if (const std::optional<KeyCommand> command = CommandOf(press)) Do(*command);
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
  // The next of the list above or below what is wanted now.
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

void Viewer::SetSpeed(double real_time_factor)
{
  if (!CanControl()) return Say("this visualisation may only watch", true);
  setup_.control->SetSpeed(real_time_factor);
}

void Viewer::MoveEntity(std::uint32_t entity, const Pose& pose)
{
  if (!CanControl()) return Say("this visualisation may only watch", true);
  setup_.control->MoveEntity(Space().GetEntity(entity).GetId(), pose);
}

void Viewer::Say(const std::string& text, bool refused)
{
  LogInfo("window: {}", text);
  messages_.push_back({text, refused, Clock::now() + kMessageTime});
  if (messages_.size() > kMostMessages) messages_.pop_front();
}

const std::deque<Viewer::Message>& Viewer::Messages()
{
  while (!messages_.empty() && messages_.front().until < Clock::now()) messages_.pop_front();
  return messages_;
}

void Viewer::Select(std::uint32_t entity, bool in_further_window)
{
  const bool open = std::find(inspected_.begin(), inspected_.end(), entity) != inspected_.end();
  if (!open)
  {
    if (inspected_.empty() || in_further_window)
      inspected_.push_back(entity);
    else
      inspected_.back() = entity;
  }
  if (shown.scene.selected == entity) return;
  shown.scene.selected = entity;
  followed_place_.reset();
  LogInfo("window: selected '{}'", Space().GetEntity(entity).GetId());
}

void Viewer::CloseInspector(std::uint32_t entity)
{
  std::erase(inspected_, entity);
  if (shown.scene.selected == entity) Deselect();
}

void Viewer::Visit(std::uint32_t entity)
{
  const CSwarmanoidSpaceEntity& body = Space().GetEntity(entity);
  if (!Space().IsPresent(entity)) return Say(fmt::format("'{}' is not in the arena", body.GetId()), true);
  camera.pitch = std::clamp(camera.pitch, -60.0, -20.0);
  camera.roll = 0;
  camera.position = body.GetPosition() - (1.2 + 2 * body.GetSize().maxCoeff()) * camera.Forward();
  whole_arena_ = false;
  followed_place_.reset();
}

bool Viewer::IsPlotted(const ValueName& value) const
{
  return std::any_of(plots_.begin(), plots_.end(), [&](const Plot& plot) { return plot.value == value; });
}

void Viewer::SetPlotted(const ValueName& value, const std::string& unit, bool plotted)
{
  if (plotted == IsPlotted(value)) return;
  if (!plotted)
  {
    std::erase_if(plots_, [&](const Plot& plot) { return plot.value == value; });
    return;
  }
  const bool device = value.source == ValueGroup::Source::kSensor || value.source == ValueGroup::Source::kActuator;
  plots_.push_back(
      {value,
       fmt::format("{} {}{}", Space().GetEntity(value.entity).GetId(), device ? value.group + " " : "", value.name),
       unit,
       {}});
  shown.plots = true;
}

EntityMotion Viewer::Motion(std::uint32_t entity) const
{
  const auto found = tracks_.find(entity);
  return found == tracks_.end() ? EntityMotion{} : found->second.motion;
}

const RunStatus& Viewer::Status()
{
  if (setup_.monitor != nullptr) return setup_.monitor->Status();
  no_status_.tick = Space().GetTick();
  return no_status_;
}

const RobotStatus* Viewer::Robot(std::uint32_t entity)
{
  return setup_.monitor == nullptr ? nullptr : setup_.monitor->Robot(entity);
}

std::vector<std::uint32_t> Viewer::Watched() const
{
  std::vector<std::uint32_t> watched = inspected_;
  for (const Plot& plot : plots_) watched.push_back(plot.value.entity);
  std::sort(watched.begin(), watched.end());
  watched.erase(std::unique(watched.begin(), watched.end()), watched.end());
  return watched;
}

void Viewer::StateCame()
{
  const double time = Space().GetTime();
  for (const std::uint32_t entity : Watched())
  {
    const Pose pose = Space().GetPose(entity);
    Track& track = tracks_.try_emplace(entity, Track{time, pose, {}}).first->second;
    if (const double passed = time - track.time; passed > 0)
    {
      track.motion.speed = (pose.position - track.pose.position).norm() / passed;
      track.motion.turn = RadiansToDegrees(WrapAngle(YawOf(pose.orientation) - YawOf(track.pose.orientation))) / passed;
    }
    track.time = time;
    track.pose = pose;
  }
  for (Plot& plot : plots_)
  {
    const std::uint32_t entity = plot.value.entity;
    const auto value = FindValue(ValuesOf(Space(), entity, Motion(entity), Robot(entity)), plot.value);
    if (value && std::isfinite(value->value)) plot.history.Add(time, value->value);
  }

  if (!follows || !shown.scene.selected) return;
  // One that leaves the arena is waited for where it was.
  if (!Space().IsPresent(*shown.scene.selected)) return followed_place_.reset();
  const Vector3 place = Space().GetPose(*shown.scene.selected).position;
  if (followed_place_) camera.position += place - *followed_place_;
  followed_place_ = place;
}

const Scene& Viewer::Refresh()
{
  HearNotes();
  std::vector<std::uint32_t> watched = Watched();
  if (watched != watched_)
  {
    watched_ = std::move(watched);
    std::erase_if(
        tracks_, [&](const auto& track) { return !std::binary_search(watched_.begin(), watched_.end(), track.first); });
    if (setup_.monitor != nullptr) setup_.monitor->Watch(watched_);
  }
  scene_.Update(shown.scene);
  return scene_;
}

// What came of the requests of all who look at this run.
void Viewer::HearNotes()
{
  if (setup_.monitor == nullptr) return;
  const std::span<const RunNote> notes = setup_.monitor->Notes();
  // Of a list that keeps the last hundred: those after the one heard last.
  std::size_t heard = std::min(notes_heard_, notes.size());
  if (notes.size() == notes_heard_ && !notes.empty() && NoteName(notes.back()) != last_note_)
    for (heard = notes.size(); heard > 0 && NoteName(notes[heard - 1]) != last_note_;) --heard;
  for (std::size_t n = heard; n < notes.size(); ++n) Say(notes[n].text, !notes[n].done);
  notes_heard_ = notes.size();
  if (!notes.empty()) last_note_ = NoteName(notes.back());
}

}  // namespace swarmanoid
