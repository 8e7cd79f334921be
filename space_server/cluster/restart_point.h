// RestartPoint: where a space server takes a run up whose space server has died, from the folder of the run. The
// journal says what the state was, the log of events what users asked. Made and used by the main thread of the
// space_server program before its first tick.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/journal/journal_reader.h"
#include "common/run/run_settings.h"
#include "space_server/event_log.h"
#include "space_server/run_control.h"

namespace swarmanoid
{

class SpaceServer;

class RestartPoint
{
public:
  // Throws std::runtime_error if the journal is of something else.
  RestartPoint(const RunSettings& settings, const Experiment& experiment);

  // The newest tick at which the server was saved and whose record is in the journal; otherwise the first one of the
  // run.
  std::uint64_t Tick() const { return tick_; }
  // Brings the server there, which is where the run began.
  void Restore(SpaceServer& server) const;
  // Nothing can be read of it if the server died before it had begun.
  const JournalReader* Journal() const { return journal_ ? &*journal_ : nullptr; }
  // If other controller hosts had the robots: has the journal say so, with the newest state that all processes saved,
  // shared out among these.
  void ShareOut(JournalWriter& journal, const Experiment& experiment, const HostTable& hosts) const;
  // Of the tick; nothing if it is the first one.
  const std::optional<TickRecord>& Record() const { return record_; }
  // Of the newest tick that the journal has, which may be a later one; none if it has none.
  const std::vector<double>& NewestPoses() const { return newest_poses_; }
  const EarlierRequests& Requests() const { return requests_; }
  // Of controllers, in ticks that are done again. Some may stand there twice.
  RecordedFaults Faults() const;
  // What is asked of the run from now on, after what was asked before.
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
