// Keys, buttons and the mouse end in the same functions. The camera turns about the selected or visible point that
// Pivot finds. In the past, the picture shows a space of its own, made from the journal, and entities cannot be moved.
#include "visualiser/interaction/viewer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "common/logging/log.h"
#include "common/math/elementary.h"
#include "common/program/shell_word.h"
#include "common/space/space.h"
#include "visualiser/scene/picking.h"

namespace swarmanoid
{
namespace
{

constexpr auto kMessageTime = std::chrono::seconds(6);
constexpr std::size_t kMostMessages = 5;
constexpr std::uint64_t kGapOfTrails = 20;  // ticks

std::string NoteName(const RunNote& note) { return fmt::format("{} {}", note.tick, note.text); }

constexpr double kOrbitStep = 5;  // degrees of an arrow key
constexpr double kZoomStep = 0.85;
// The speed 0, as fast as possible, comes after the last one.
constexpr std::array kSpeeds{0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0};

constexpr double kClickReach = 4;  // pixels that a click may move
constexpr double kDegreesPerPixel = 0.3;
constexpr double kWheelFactor = 0.88;
constexpr double kWheelTurn = 15;  // degrees of an entity that is being moved
constexpr double kFarPivot = 10;   // m, if the camera does not look at the floor

constexpr auto kFollowPeriod = std::chrono::milliseconds(500);

}  // namespace

Viewer::Viewer(const RenderSetup& setup, int width, int height)
    : setup_(setup),
      scene_(setup.space),
      past_(setup.space.GetExperiment()),
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
  may_look_back_ = !parameters.Boolean("write_frames");
  if (viewpoints_.First())
    camera = *viewpoints_.First();
  else
    ShowWholeArena(false);
}

const Experiment& Viewer::GetExperiment() const { return setup_.space.GetExperiment(); }

void Viewer::SetSize(int width, int height, const HiddenEdges& hidden)
{
  const bool is_same =
      width == width_ && height == height_ && hidden.left == hidden_.left && hidden.bottom == hidden_.bottom;
  width_ = width;
  height_ = height;
  hidden_ = hidden;
  if (whole_arena_ && !is_same) ShowWholeArena(camera.pitch < -80);
}

void Viewer::ShowWholeArena(bool from_above)
{
  camera = DefaultView(GetExperiment(), static_cast<double>(width_) / height_, from_above, hidden_);
  whole_arena_ = true;
}

void Viewer::SetSpeed(double real_time_factor)
{
  if (!CanControl()) return Say("this visualisation may only watch", true);
  setup_.control->SetSpeed(real_time_factor);
}

void Viewer::Reset()
{
  if (!CanControl()) return Say("this visualisation may only watch", true);
  setup_.control->Reset();
}

void Viewer::SayWhyNotMoved()
{
  Say(CanControl() ? "this is the past: Q goes back to the present" : "this visualisation may only watch", true);
}

void Viewer::MoveEntity(std::uint32_t entity, const Pose& pose)
{
  if (!CanMove()) return SayWhyNotMoved();
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
  if (gives_keys_) setup_.control->SelectEntity(Space().GetEntity(entity).GetId());
  followed_place_.reset();
  LogInfo("window: selected '{}'", Space().GetEntity(entity).GetId());
}

void Viewer::Deselect()
{
  if (gives_keys_ && shown.scene.selected) setup_.control->SelectEntity({});
  shown.scene.selected.reset();
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

const RunStatus& Viewer::Status()
{
  if (setup_.monitor != nullptr) return setup_.monitor->Status();
  no_status_.tick = Present().GetTick();
  return no_status_;
}

const RobotStatus* Viewer::Robot(std::uint32_t entity)
{
  if (past_.Space() != nullptr) return past_.Inside(entity);
  return setup_.monitor == nullptr ? nullptr : setup_.monitor->Robot(entity);
}

void Viewer::FollowSelected()
{
  if (!follows || !shown.scene.selected) return;
  // If the entity leaves the arena, the camera waits where the entity was.
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
  if (past_.Space() == nullptr)
  {
    scene_.Update(shown.scene);
    return scene_;
  }
  if (past_scene_ == nullptr) past_scene_ = std::make_unique<Scene>(*past_.Space());
  // Trails need ticks near each other, since the path between distant ticks is unknown.
  const std::uint64_t tick = Space().GetTick();
  if (tick < past_tick_ || tick > past_tick_ + kGapOfTrails) past_scene_->ForgetTrails();
  past_tick_ = tick;
  past_scene_->Update(shown.scene);
  return *past_scene_;
}

// Shows the results of the requests of all users of this run.
void Viewer::HearNotes()
{
  if (setup_.monitor == nullptr) return;
  const std::span<const RunNote> notes = setup_.monitor->Notes();
  // The list keeps the last hundred notes; the new ones are those after the last one that was shown.
  std::size_t heard = std::min(notes_heard_, notes.size());
  if (notes.size() == notes_heard_ && !notes.empty() && NoteName(notes.back()) != last_note_)
    for (heard = notes.size(); heard > 0 && NoteName(notes[heard - 1]) != last_note_;) --heard;
  for (std::size_t n = heard; n < notes.size(); ++n) Say(notes[n].text, !notes[n].done);
  notes_heard_ = notes.size();
  if (!notes.empty()) last_note_ = NoteName(notes.back());
}

// The next functions do what keys and their buttons ask for.

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

// The next functions move the camera and entities by the mouse.

Vector3 Viewer::Pivot() const
{
  if (follows && shown.scene.selected) return Space().GetPose(*shown.scene.selected).position;
  const double size = GetExperiment().arena_size.head<2>().norm();
  const Vector3 floor = PointOnFloor(camera.RayThrough(width_ / 2.0, height_ / 2.0, width_, height_), 0, kFarPivot);
  // A floor point near the horizon is too far away to turn about.
  return (floor - camera.position).norm() < 2 * size + kFarPivot ? floor
                                                                 : camera.position + kFarPivot * camera.Forward();
}

double Viewer::MetresPerPixel(const Vector3& at) const
{
  const double depth = std::max((at - camera.position).dot(camera.Forward()), 0.05);
  return 2 * depth * std::tan(DegreesToRadians(camera.field_of_view) / 2) / height_;
}

void Viewer::MousePress(MouseButton button, double x, double y, bool ctrl, bool shift)
{
  if (drag_ != Drag::kNone) return;
  drag_button_ = button;
  drag_ctrl_ = ctrl;
  drag_x_ = x;
  drag_y_ = y;
  drag_ = button == MouseButton::kLeft ? Drag::kClick : Drag::kPan;
  if (button != MouseButton::kLeft || !shift) return;

  const Ray ray = camera.RayThrough(x, y, width_, height_);
  const std::optional<Pick> pick = PickEntity(Space(), ray);
  if (!pick) return;
  Select(pick->entity);
  StartMove(pick->entity);
}

void Viewer::StartMove(std::uint32_t entity)
{
  drag_ = Drag::kNone;
  const CSwarmanoidSpaceEntity& body = Space().GetEntity(entity);
  if (!CanMove()) return SayWhyNotMoved();
  if (!body.IsMovable()) return Say(fmt::format("'{}' stands fast: it cannot be moved", body.GetId()), true);
  drag_ = Drag::kEntity;
  move_ = Move{entity, body.GetPose()};
  const Ray ray = camera.RayThrough(drag_x_, drag_y_, width_, height_);
  move_offset_ = body.GetPosition() - PointOnFloor(ray, body.GetPosition().z(), kFarPivot);
}

void Viewer::MouseMove(double x, double y)
{
  const double right = x - drag_x_;
  const double down = y - drag_y_;
  if (drag_ == Drag::kClick && std::hypot(right, down) > kClickReach) drag_ = Drag::kOrbit;
  if (drag_ == Drag::kNone || drag_ == Drag::kClick) return;
  drag_x_ = x;
  drag_y_ = y;
  if (drag_ == Drag::kOrbit)
  {
    camera.Orbit(Pivot(), right * kDegreesPerPixel, down * kDegreesPerPixel);
    whole_arena_ = false;
  }
  else if (drag_ == Drag::kPan)
  {
    const double scale = MetresPerPixel(Pivot());
    camera.Pan(-right * scale, down * scale);
    whole_arena_ = false;
  }
  else if (move_)
  {
    Vector3& place = move_->pose.position;
    const double height = place.z();
    const Vector3& arena = GetExperiment().arena_size;
    place = PointOnFloor(camera.RayThrough(x, y, width_, height_), height, kFarPivot) + move_offset_;
    place = Vector3(std::clamp(place.x(), 0.0, arena.x()), std::clamp(place.y(), 0.0, arena.y()), height);
  }
}

void Viewer::MouseRelease(MouseButton button)
{
  if (button != drag_button_) return;
  if (drag_ == Drag::kClick) Click(drag_x_, drag_y_, drag_ctrl_);
  if (drag_ == Drag::kEntity && move_) MoveEntity(move_->entity, move_->pose);
  move_.reset();
  drag_ = Drag::kNone;
}

void Viewer::Click(double x, double y, bool ctrl)
{
  if (const std::optional<Pick> pick = PickEntity(Space(), camera.RayThrough(x, y, width_, height_)))
    Select(pick->entity, ctrl);
  else
    Deselect();
}

void Viewer::Wheel(double notches, double x, double y)
{
  if (move_)
  {
    const double turn = DegreesToRadians(kWheelTurn * notches);
    move_->pose.orientation = (QuaternionFromYaw(turn) * move_->pose.orientation).normalized();
    return;
  }
  // Towards what is under the mouse.
  Vector3 at = Pivot();
  if (!follows)
  {
    const double reach = (at - camera.position).norm();
    const Vector3 floor = PointOnFloor(camera.RayThrough(x, y, width_, height_), 0, reach);
    if ((floor - camera.position).norm() < 3 * reach) at = floor;
  }
  camera.Zoom(at, std::pow(kWheelFactor, notches));
  whole_arena_ = false;
}

// The next functions look back at the past of the run.

bool Viewer::MayLookBack()
{
  if (past_.IsThere()) return true;
  Say(may_look_back_ ? "there is nothing to look back at: the run keeps no journal here"
                     : "a window that writes frames shows the present alone",
      true);
  return false;
}

void Viewer::LookBackAt(std::uint64_t tick)
{
  if (!MayLookBack()) return;
  if (!past_.IsOn()) followed_place_.reset();
  move_.reset();
  past_.Look(tick);
}

void Viewer::LookBackBy(int ticks)
{
  const std::uint64_t from = past_.Wanted().value_or(past_.Last());
  LookBackAt(ticks < 0 && from == 0 ? 0 : from + static_cast<std::uint64_t>(ticks));
}

void Viewer::LookBackAtEvent(bool forward)
{
  if (!MayLookBack()) return;
  if (const auto tick = past_.Neighbour(forward))
    LookBackAt(*tick);
  else
    Say(forward ? "there is no event after this" : "there is no event before this");
}

void Viewer::CopyBranchCommand()
{
  if (!MayLookBack()) return;
  const std::uint64_t tick = past_.Wanted().value_or(past_.Last());
  copy_ = fmt::format("swarmanoid run --branch {}", ShellWord(fmt::format("{}@{}", past_.RunFolder(), tick)));
  Say(fmt::format("a new run from tick {}: {}", tick, copy_));
}

// Copies the command that computes the status of the selected robot, which the journal does not have.
void Viewer::CopyInspectCommand()
{
  const auto& selected = shown.scene.selected;
  if (!past_.IsOn() || !selected || Present().GetEntity(*selected).GetConfiguration().controller.empty())
    return Say("look back and select a robot with a controller first");
  const std::string& id = Present().GetEntity(*selected).GetId();
  copy_ = fmt::format("swarmanoid inspect {} {}", ShellWord(fmt::format("{}@{}", past_.RunFolder(), *past_.Wanted())),
                      ShellWord(id));
  Say(fmt::format("what '{}' sensed at tick {}: {}", id, *past_.Wanted(), copy_));
}

bool Viewer::FollowPast()
{
  const Clock::time_point now = Clock::now();
  if (may_look_back_ && now - followed_ >= kFollowPeriod)
  {
    followed_ = now;
    past_.Follow(RunFolderOf(setup_.output_folder, setup_.monitor));
  }
  const bool changed = past_.Advance(now);
  past_.Inspect(inspected_);
  if (const auto refusal = past_.TakeRefusal()) Say(*refusal, true);
  if (past_.IsOn() != was_past_) Say(past_.IsOn() ? "looking back: Q goes to the present" : "the present again");
  was_past_ = past_.IsOn();
  if (changed && past_.Space() != nullptr) FollowSelected();
  return changed;
}

// The next functions measure the motions of inspected entities and plot their values.

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

std::string Viewer::Owner(std::uint32_t entity) const
{
  const int engine = Space().EngineOf(entity, setup_.assignment.owner);
  return engine < 0 ? std::string() : EngineName(GetExperiment(), static_cast<std::size_t>(engine));
}

std::optional<EntityMotion> Viewer::Motion(std::uint32_t entity) const
{
  if (past_.Space() != nullptr) return std::nullopt;
  return MotionNow(entity);
}

EntityMotion Viewer::MotionNow(std::uint32_t entity) const
{
  const auto found = tracks_.find(entity);
  return found == tracks_.end() ? EntityMotion{} : found->second.motion;
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
  const double time = Present().GetTime();
  for (const std::uint32_t entity : Watched())
  {
    const Pose pose = Present().GetPose(entity);
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
    const RobotStatus* robot = setup_.monitor == nullptr ? nullptr : setup_.monitor->Robot(entity);
    const auto value = FindValue(ValuesOf(Present(), entity, MotionNow(entity), robot), plot.value);
    if (value && std::isfinite(value->value)) plot.history.Add(time, value->value);
  }

  if (past_.Space() == nullptr) FollowSelected();
}

}  // namespace swarmanoid
