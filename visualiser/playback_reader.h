// PlaybackReader: what the journal of the run has of its past, for the timelines of pages and windows. It reads the
// journal in the folder of the run, in a thread of its own, so that nobody who looks back slows the run, or those who
// look at the present. Made and asked by renderers in the thread of Draw and Idle.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "common/journal/journal_follower.h"
#include "common/journal/recorded_states.h"
#include "visualiser/render.h"

namespace swarmanoid
{

// A tick of the past.
struct LookBackRequest
{
  std::uint64_t tick = 0;
  std::vector<std::uint32_t> entities;  // whose details are wanted

  bool operator==(const LookBackRequest&) const = default;
};

// An event of a run's log of events, as a mark on the timeline.
struct TimelineEvent
{
  std::uint64_t tick = 0;
  std::string what, entity, from;

  bool operator==(const TimelineEvent&) const = default;
};

// What can be looked at: the ticks from `first` up to the one before `end`.
struct JournalTimeline
{
  std::uint64_t first = 0;
  std::uint64_t end = 0;
  std::vector<TimelineEvent> events;

  bool operator==(const JournalTimeline&) const = default;
};

// Called in the thread of PlaybackReader.
struct LookBackAnswers
{
  // Whenever it has changed.
  std::function<void(const JournalTimeline&)> timeline;
  // The space as it was at the tick of the request; entities that it does not have are left out. The space is the same
  // object each time, and is as long as PlaybackReader.
  std::function<void(std::uint64_t client, const LookBackRequest&, const CSwarmanoidSpace&)> past;
  std::function<void(std::uint64_t client, const std::string& text)> refused;
};

class PlaybackReader
{
public:
  // `run_folder` has the journal, or will have it. The experiment outlives this.
  PlaybackReader(const Experiment& experiment, std::string run_folder, LookBackAnswers answers);
  ~PlaybackReader();
  PlaybackReader(const PlaybackReader&) = delete;
  PlaybackReader& operator=(const PlaybackReader&) = delete;

  const std::string& RunFolder() const { return run_folder_; }
  // The newest request of a client counts.
  void Ask(std::uint64_t client, const LookBackRequest& request);
  void Forget(std::uint64_t client);
  // The journal may have grown; somebody looks.
  void Refresh();

private:
  void Work();
  void Follow();
  void Answer(std::uint64_t client, LookBackRequest request);
  // False while there is none of this experiment.
  bool IsOpen();

  const Experiment& experiment_;
  const std::string run_folder_;
  const LookBackAnswers answers_;

  // Of the thread.
  JournalFollower journal_;
  std::unique_ptr<RecordedStates> states_;
  JournalTimeline timeline_;
  std::uint64_t events_bytes_ = 0;
  bool refused_ = false;

  std::mutex mutex_;  // of what follows
  std::condition_variable changed_;
  std::map<std::uint64_t, LookBackRequest> wanted_;
  bool refresh_ = true;
  bool over_ = false;
  std::thread thread_;
};

// The folder of the run that a renderer shows, absolute, if it can be read here: where it writes to if it belongs to
// the run, otherwise what the monitor, which may be nullptr, says. Empty: none.
std::string RunFolderOf(const std::string& output_folder, RunMonitor* monitor);

}  // namespace swarmanoid
