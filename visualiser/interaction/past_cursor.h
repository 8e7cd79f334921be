// PastCursor: looking back in a window. It knows the shown tick of the run's journal, plays from it, and returns to the
// present. PlaybackReader reads the journal in its own thread. Requests wait meanwhile, and only the newest one is
// sent. Viewer owns it and uses it in the thread of Draw and Idle.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>

#include "visualiser/playback_reader.h"
#include "visualiser/robot_playback.h"

namespace swarmanoid
{

class PastCursor
{
public:
  using Clock = std::chrono::steady_clock;

  // The experiment must outlive the object.
  explicit PastCursor(const Experiment& experiment);
  ~PastCursor();

  // Looks for new content of the journal in the folder of the run. A new folder is that of another run, so the cursor
  // returns to the present. Empty: no journal.
  void Follow(const std::string& run_folder);
  // Takes the states that were read meanwhile, and continues playing. Returns true if the shown state changed.
  bool Advance(Clock::time_point now);

  // Returns whether the journal has ticks to look at.
  bool IsThere() const { return Last() > First(); }
  std::uint64_t First() const { return timeline_.first; }
  std::uint64_t Last() const { return timeline_.end == 0 ? 0 : timeline_.end - 1; }
  std::span<const TimelineEvent> Events() const { return timeline_.events; }
  const std::string& RunFolder() const { return run_folder_; }

  // Returns the requested tick, which may not be read yet; nothing: the present.
  const std::optional<std::uint64_t>& Wanted() const { return wanted_; }
  bool IsOn() const { return wanted_.has_value(); }
  bool IsPlaying() const { return playing_.has_value(); }
  // Returns the space to show; nullptr: the present.
  const CSwarmanoidSpace* Space() const { return IsOn() && has_state_ ? space_.get() : nullptr; }

  // Goes to the nearest tick of the journal. Does nothing if it has none.
  void Look(std::uint64_t tick);
  // Starts playing from the requested tick, or from the first one, in real time; or stops playing.
  void TogglePlay(Clock::time_point now);
  void GoLive();
  // Requests the status of these robots at the requested tick. The status comes a while after the tick has been chosen.
  // Does nothing in the present.
  void Inspect(std::span<const std::uint32_t> robots);
  // Returns nullptr if the status has not come.
  const RobotStatus* Inside(std::uint32_t robot) const;
  // The first function returns whether the status will come, the second one why it does not.
  bool IsInsideComputed() const { return IsOn() && inside_ && inside_->IsPossible(); }
  const std::string& InsideError() const { return of_inside_.error; }
  // Returns the tick of the event before or after the requested tick.
  std::optional<std::uint64_t> Neighbour(bool forward) const;
  // Returns, once, why a tick cannot be shown.
  std::optional<std::string> TakeRefusal() { return std::exchange(refusal_, std::nullopt); }

private:
  struct Playing
  {
    std::uint64_t tick;
    Clock::time_point since;
  };
  // Results from the thread of PlaybackReader.
  struct Arrived
  {
    std::optional<JournalTimeline> timeline;
    std::optional<SpaceSnapshot> state;
    std::optional<std::string> refusal;
    std::optional<RobotPlaybackAnswer> inside;
  };

  void Want(std::uint64_t tick);
  LookBackAnswers Answers();

  const Experiment& experiment_;
  std::string run_folder_;
  JournalTimeline timeline_;
  std::optional<std::uint64_t> wanted_;
  std::optional<std::uint64_t> asked_;  // the tick whose answer is awaited
  std::optional<Playing> playing_;
  std::optional<std::string> refusal_;
  std::unique_ptr<CSwarmanoidSpace> space_;
  bool has_state_ = false;                    // a state has come since the cursor left the present
  std::optional<LookBackRequest> inspected_;  // the last request to `inside_`
  RobotPlaybackAnswer of_inside_;

  std::mutex mutex_;  // guards arrived_
  Arrived arrived_;
  // These members are last, since their threads use the ones above.
  std::unique_ptr<PlaybackReader> look_back_;
  std::unique_ptr<RobotPlayback> inside_;
};

}  // namespace swarmanoid
