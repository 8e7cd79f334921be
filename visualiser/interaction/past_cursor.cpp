// The past is read by a PlaybackReader in its own thread, which may take long for one tick. So at most one tick is
// asked for at a time, and only the latest wish counts: if the wish has changed when an answer comes, the answer is
// shown and the new wish is asked for. Playing follows the clock and leaves out ticks that come too late. `mutex_`
// guards the answers that have arrived; all other members belong to the thread of the window.
#include "visualiser/interaction/past_cursor.h"

#include <algorithm>
#include <utility>
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

constexpr std::uint64_t kWindow = 0;  // the number of the only client

}  // namespace

LookBackAnswers PastCursor::Answers()
{
  return {[this](const JournalTimeline& timeline)
          {
            const std::lock_guard lock(mutex_);
            arrived_.timeline = timeline;
          },
          [this](std::uint64_t, const LookBackRequest&, const CSwarmanoidSpace& space)
          {
            SpaceSnapshot state;
            state.tick = space.GetTick();
            space.WritePoses(state.poses);
            state.attributes.assign(space.Attributes().Values().begin(), space.Attributes().Values().end());
            space.Fields().WriteCells(state.fields);
            const std::lock_guard lock(mutex_);
            arrived_.state = std::move(state);
          },
          [this](std::uint64_t, const std::string& text)
          {
            const std::lock_guard lock(mutex_);
            arrived_.refusal = text;
          }};
}

PastCursor::PastCursor(const Experiment& experiment) : experiment_(experiment) {}

PastCursor::~PastCursor() = default;

void PastCursor::Follow(const std::string& run_folder)
{
  if (run_folder != run_folder_)
  {
    look_back_.reset();
    inside_.reset();
    GoLive();
    arrived_ = {};
    asked_.reset();
    timeline_ = {};
    run_folder_ = run_folder;
    if (run_folder.empty()) return;
    look_back_ = std::make_unique<PlaybackReader>(experiment_, run_folder, Answers());
    inside_ = std::make_unique<RobotPlayback>(experiment_, run_folder,
                                              [this](std::uint64_t, const RobotPlaybackAnswer& answer)
                                              {
                                                const std::lock_guard lock(mutex_);
                                                arrived_.inside = answer;
                                              });
  }
  else if (look_back_)
    look_back_->Refresh();
}

bool PastCursor::Advance(Clock::time_point now)
{
  Arrived arrived;
  {
    const std::lock_guard lock(mutex_);
    std::swap(arrived, arrived_);
  }
  bool changed = arrived.timeline.has_value();
  if (arrived.timeline) timeline_ = std::move(*arrived.timeline);
  if (arrived.inside)
  {
    changed = true;
    of_inside_ = std::move(*arrived.inside);
  }
  if (arrived.state || arrived.refusal)
  {
    const bool late = asked_ != wanted_;
    asked_.reset();
    changed = true;
    if (arrived.state && IsOn())
    {
      if (!space_) space_ = std::make_unique<CSwarmanoidSpace>(experiment_);
      space_->Apply(*arrived.state);
      has_state_ = true;
    }
    if (arrived.refusal && !late)
    {
      refusal_ = std::move(arrived.refusal);
      GoLive();
    }
    else if (late && IsOn())
      Want(*wanted_);
  }
  if (!playing_ || asked_) return changed;
  const std::chrono::duration<double> passed = now - playing_->since;
  const std::uint64_t tick = playing_->tick + static_cast<std::uint64_t>(passed.count() / experiment_.TickSeconds());
  if (tick > Last())
  {
    GoLive();
    return true;
  }
  if (tick != wanted_) Want(tick);
  return changed;
}

void PastCursor::Want(std::uint64_t tick)
{
  wanted_ = tick;
  if (asked_) return;
  asked_ = tick;
  look_back_->Ask(kWindow, {tick, {}});
}

void PastCursor::Inspect(std::span<const std::uint32_t> robots)
{
  if (!inside_ || !IsOn()) return;
  LookBackRequest request{*wanted_, {robots.begin(), robots.end()}};
  if (inspected_ == request) return;
  of_inside_ = {};
  inside_->Ask(kWindow, request);
  inspected_ = std::move(request);
}

const RobotStatus* PastCursor::Inside(std::uint32_t robot) const
{
  if (!IsOn() || of_inside_.tick != *wanted_) return nullptr;
  const auto found = std::ranges::find(of_inside_.robots, robot, &RobotStatus::entity);
  return found == of_inside_.robots.end() ? nullptr : &*found;
}

void PastCursor::Look(std::uint64_t tick)
{
  if (!IsThere()) return;
  playing_.reset();
  Want(std::clamp(tick, First(), Last()));
}

void PastCursor::TogglePlay(Clock::time_point now)
{
  if (!IsThere()) return;
  if (std::exchange(playing_, std::nullopt)) return;
  if (!IsOn()) Want(First());
  playing_ = Playing{*wanted_, now};
}

void PastCursor::GoLive()
{
  wanted_.reset();
  playing_.reset();
  has_state_ = false;
  if (!inspected_) return;
  inspected_.reset();
  of_inside_ = {};
  if (inside_) inside_->Forget(kWindow);
}

std::optional<std::uint64_t> PastCursor::Neighbour(bool forward) const
{
  // The present is later than all events.
  const std::uint64_t from = wanted_.value_or(Last() + 1);
  std::optional<std::uint64_t> nearest;
  for (const TimelineEvent& event : timeline_.events)
  {
    if (event.tick < First() || event.tick > Last() || (forward ? event.tick <= from : event.tick >= from)) continue;
    if (!nearest || (forward ? event.tick < *nearest : event.tick > *nearest)) nearest = event.tick;
  }
  return nearest;
}

}  // namespace swarmanoid
