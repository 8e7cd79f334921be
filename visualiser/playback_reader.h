// PlaybackReader: reads the past of the run from its journal, for the timelines of pages and windows. It uses its own
// thread, so that looking back slows neither the run nor views of the present. Renderers make and call it in the thread
// of Draw and Idle.
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

// A request for a tick of the past.
struct LookBackRequest
{
  std::uint64_t tick = 0;
  std::vector<std::uint32_t> entities;  // the entities whose details are wanted

  bool operator==(const LookBackRequest&) const = default;
};

// An event of a run's event log, as a mark on the timeline.
struct TimelineEvent
{
  std::uint64_t tick = 0;
  std::string what, entity, from;

  bool operator==(const TimelineEvent&) const = default;
};

// Returns the events of a run from its events.csv; none if there is no such file.
std::vector<TimelineEvent> TimelineEventsOf(const std::string& run_folder);

// The ticks that can be shown: from `first` up to the one before `end`.
struct JournalTimeline
{
  std::uint64_t first = 0;
  std::uint64_t end = 0;
  std::vector<TimelineEvent> events;

  bool operator==(const JournalTimeline&) const = default;
};

// The functions are called in the thread of PlaybackReader.
struct LookBackAnswers
{
  // Called whenever the timeline has changed.
  std::function<void(const JournalTimeline&)> timeline;
  // Gets the space at the tick of the request; entities that it does not have are left out. The space is the same
  // object each time and lives as long as PlaybackReader.
  std::function<void(std::uint64_t client, const LookBackRequest&, const CSwarmanoidSpace&)> past;
  std::function<void(std::uint64_t client, const std::string& text)> refused;
};

class PlaybackReader
{
public:
  // `run_folder` has the journal, or will have it. The experiment must outlive the object.
  PlaybackReader(const Experiment& experiment, std::string run_folder, LookBackAnswers answers);
  ~PlaybackReader();
  PlaybackReader(const PlaybackReader&) = delete;
  PlaybackReader& operator=(const PlaybackReader&) = delete;

  const std::string& RunFolder() const { return run_folder_; }
  // Sends a request. Only the newest request of a client counts.
  void Ask(std::uint64_t client, const LookBackRequest& request);
  void Forget(std::uint64_t client);
  // Looks again at the journal, which may have grown.
  void Refresh();

private:
  void Work();
  void Follow();
  void Answer(std::uint64_t client, LookBackRequest request);
  // Returns false while no journal of this experiment exists.
  bool IsOpen();

  const Experiment& experiment_;
  const std::string run_folder_;
  const LookBackAnswers answers_;

  // These members belong to the reader's thread.
  JournalFollower journal_;
  std::unique_ptr<RecordedStates> states_;
  JournalTimeline timeline_;
  std::uint64_t events_bytes_ = 0;
  bool refused_ = false;

  std::mutex mutex_;  // guards the members below
  std::condition_variable changed_;
  std::map<std::uint64_t, LookBackRequest> wanted_;
  bool refresh_ = true;
  bool over_ = false;
  std::thread thread_;
};

// Returns the absolute folder of the run that a renderer shows, if it can be read on this machine. A renderer of the
// run uses its output folder; otherwise the monitor, which may be nullptr, gives the folder. Empty: none.
std::string RunFolderOf(const std::string& output_folder, RunMonitor* monitor);

}  // namespace swarmanoid
