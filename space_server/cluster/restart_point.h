// RestartPoint: the tick at which a new space server resumes a run after the death of the old one, read from the folder
// of the run. The journal has the states, and the log of events has the requests of users. The main thread of the
// space_server program makes and uses it before its first tick.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/journal/journal_reader.h"
#include "common/run/run_options.h"
#include "space_server/event_log.h"
#include "space_server/run_control.h"

namespace swarmanoid
{

class SpaceServer;

class RestartPoint
{
public:
  // Throws std::runtime_error if the journal belongs to another run or experiment.
  RestartPoint(const RunSettings& settings, const Experiment& experiment);

  // Returns the newest tick at which the server was saved and whose record is in the journal. Otherwise it returns the
  // first tick of the run.
  std::uint64_t Tick() const { return tick_; }
  // Brings the server, which is at the start of the run, to that tick.
  void Restore(SpaceServer& server) const;
  // Returns the journal, or nullptr if the server died before it had begun one.
  const JournalReader* Journal() const { return journal_ ? &*journal_ : nullptr; }
  // If other controller hosts had the robots, writes the new hosts into the journal, with the newest state that all
  // processes saved, distributed to these hosts.
  void ShareOut(JournalWriter& journal, const Experiment& experiment, const HostTable& hosts) const;
  // Returns the record of the tick, or nothing if it is the first one.
  const std::optional<TickRecord>& Record() const { return record_; }
  // Returns the poses of the newest tick in the journal, which may be later than Tick(). They are empty if the journal
  // has no tick.
  const std::vector<double>& NewestPoses() const { return newest_poses_; }
  const EarlierRequests& Requests() const { return requests_; }
  // Returns the failures of controllers in ticks that are computed again. A failure may be in the list twice.
  RecordedFaults Faults() const;
  // Fills in the requests that the run has still to execute, and those that it executed before.
  void Prepare(RunControlSetup& setup) const;

private:
  std::uint32_t ahead_;  // framework.ahead
  std::optional<JournalReader> journal_;
  std::uint64_t tick_ = 0;
  std::optional<TickRecord> record_;
  std::vector<double> newest_poses_;
  EarlierRequests requests_;
};

}  // namespace swarmanoid
