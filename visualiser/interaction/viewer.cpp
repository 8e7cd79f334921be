#include "visualiser/interaction/viewer.h"

#include <fmt/format.h>

#include <algorithm>

#include "common/logging/log.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

constexpr auto kMessageTime = std::chrono::seconds(6);
constexpr std::size_t kMostMessages = 5;
constexpr std::uint64_t kGapOfTrails = 20;  // ticks

std::string NoteName(const RunNote& note) { return fmt::format("{} {}", note.tick, note.text); }

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
  // The middle of the arena is placed in the middle of the area that no panel hides.
  const Vector3 middle = GetExperiment().arena_size.cwiseProduct(Vector3(0.5, 0.5, 0));
  camera.Pan(-left_ / 2.0 * MetresPerPixel(middle), 0);
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

}  // namespace swarmanoid
