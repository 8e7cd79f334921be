// PastCursor: looking back in a window: which tick of the run's journal is shown, playing from it, and the way back to
// the present. PlaybackReader reads the journal in a thread of its own; what is wanted meanwhile waits, and only the
// newest of it is asked for. Held by Viewer, in the thread of Draw and Idle.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>

#include "visualiser/past_inside.h"
#include "visualiser/playback_reader.h"

namespace swarmanoid
{

class PastCursor
{
public:
  using Clock = std::chrono::steady_clock;

  // The experiment outlives this.
  explicit PastCursor(const Experiment& experiment);
  ~PastCursor();

  // Looks for what has been added to the journal in the folder of the run. Another folder than
  // before is that of another run: what was looked at is left. Empty: there is none.
  void Follow(const std::string& run_folder);
  // Takes what was read meanwhile, and goes on playing. True if there is something else to show.
  bool Advance(Clock::time_point now);

  // Whether there are ticks to look at.
  bool IsThere() const { return Last() > First(); }
  std::uint64_t First() const { return timeline_.first; }
  std::uint64_t Last() const { return timeline_.end == 0 ? 0 : timeline_.end - 1; }
  std::span<const TimelineEvent> Events() const { return timeline_.events; }
  const std::string& RunFolder() const { return run_folder_; }

  // The tick that is looked at, which may still be on its way; nothing: the present.
  const std::optional<std::uint64_t>& Wanted() const { return wanted_; }
  bool IsOn() const { return wanted_.has_value(); }
  bool IsPlaying() const { return playing_.has_value(); }
  // What is to be shown; nullptr: the present.
  const CSwarmanoidSpace* Space() const { return IsOn() && has_state_ ? space_.get() : nullptr; }

  // The nearest tick that there is. Nothing happens if there are none.
  void Look(std::uint64_t tick);
  // From the tick that is looked at, or from the first one, in real time; or no more.
  void TogglePlay(Clock::time_point now);
  void GoLive();
  // The inside of these robots at the tick that is looked at is wanted from now on; it comes a while after the tick has
  // stood. Nothing happens in the present.
  void Inspect(std::span<const std::uint32_t> robots);
  // nullptr if it has not come.
  const RobotStatus* Inside(std::uint32_t robot) const;
  // Whether it will come; or why it does not.
  bool IsInsideComputed() const { return IsOn() && inside_ && inside_->IsPossible(); }
  const std::string& InsideError() const { return of_inside_.error; }
  // The tick of the event before or after the one that is looked at.
  std::optional<std::uint64_t> Neighbour(bool forward) const;
  // Why a tick cannot be shown; once.
  std::optional<std::string> TakeRefusal() { return std::exchange(refusal_, std::nullopt); }

private:
  struct Playing
  {
    std::uint64_t tick;
    Clock::time_point since;
  };
  // From the thread of PlaybackReader.
  struct Arrived
  {
    std::optional<JournalTimeline> timeline;
    std::optional<SpaceSnapshot> state;
    std::optional<std::string> refusal;
    std::optional<PastInsideAnswer> inside;
  };

  void Want(std::uint64_t tick);
  LookBackAnswers Answers();

  const Experiment& experiment_;
  std::string run_folder_;
  JournalTimeline timeline_;
  std::optional<std::uint64_t> wanted_;
  std::optional<std::uint64_t> asked_;  // whose answer is awaited
  std::optional<Playing> playing_;
  std::optional<std::string> refusal_;
  std::unique_ptr<CSwarmanoidSpace> space_;
  bool has_state_ = false;                    // since the present was left
  std::optional<LookBackRequest> inspected_;  // what `inside_` was asked last
  PastInsideAnswer of_inside_;

  std::mutex mutex_;
  Arrived arrived_;
  // Last: their threads use the above.
  std::unique_ptr<PlaybackReader> look_back_;
  std::unique_ptr<PastInside> inside_;
};

}  // namespace swarmanoid
