// The run resumes at the newest tick with a whole state of the space server. Workers resume from older states of their
// own and catch up. The log of events may be ahead of the journal or behind it. Changes up to the tick are dropped, and
// later ones are carried out again at their ticks.
//
// Invariant: a tick whose checkpoint file is due counts only if the file is there.
#include "space_server/cluster/restart_point.h"

#include <filesystem>
#include <stdexcept>
#include "common/checkpoint/host_state.h"
#include "space_server/space_server.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

}  // namespace

RestartPoint::RestartPoint(const RunSettings& settings, const Experiment& experiment) : ahead_(experiment.ahead)
{
  const std::optional<std::uint64_t> paused = settings.paused ? std::optional<std::uint64_t>(0) : std::nullopt;
  requests_ = ReadEarlierRequests(settings.output_folder + "/events.csv", experiment, paused);
  const std::string file = JournalFile(settings.output_folder);
  if (!IsBegun(file)) return;
  journal_.emplace(file);
  const JournalStart& start = journal_->Start();
  if (start.origin.experiment != FingerprintOf(experiment))
    throw std::runtime_error("the journal '" + file + "' is of another run");
  tick_ = start.first_tick;
  if (const auto newest = journal_->RecordOf(EndTickOf(start, journal_->Places()) - 1))
    newest_poses_ = newest->state.poses;
  // A tick whose checkpoint file is due is usable only if the file exists. Otherwise the part of a process may be lost.
  const auto usable = [&](std::uint64_t tick)
  {
    const bool of_file = settings.checkpoint_every != 0 && tick % settings.checkpoint_every == 0;
    return !of_file || fs::exists(settings.output_folder + "/" + CheckpointName(tick));
  };
  const auto saved = journal_->RestartTick(usable);
  if (!saved && journal_->FirstTick() != start.first_tick)
    throw std::runtime_error("the journal '" + file + "' has no whole state of the space server any more");
  if (!saved) return;
  tick_ = *saved;
  record_ = journal_->RecordOf(tick_);
  // Changes up to this tick were carried out before the state was saved.
  std::erase_if(requests_.changes, [this](const RecordedEvent& event) { return event.tick <= tick_; });
}

void RestartPoint::Restore(SpaceServer& server) const
{
  if (!record_) return;
  const auto checkpoint = journal_->CheckpointAt(tick_, {kServerPart});
  checkpoint->LoadPart(kServerPart, [&](ByteReader& state) { server.LoadState(checkpoint->snapshot, state); });
  server.Resend(record_->state);
}

void RestartPoint::ShareOut(JournalWriter& journal, const Experiment& experiment, const HostTable& hosts) const
{
  if (journal.Start().hosts != hosts)
    journal.BeginHosts(hosts, tick_);
  else if (journal_->NewestHostsSavedUntil(tick_, PartsOf(experiment, hosts.hosts)))
    return;
  // A server that died at this point has written the new assignment of robots, but perhaps not their saved states.
  const auto checkpoint = journal_->WholeCheckpointUntil(tick_, experiment, hosts);
  if (!checkpoint) return;
  journal.Add(checkpoint->snapshot);
  for (const SavedPart& part : checkpoint->parts) journal.Add(checkpoint->snapshot.tick, part);
}

RecordedFaults RestartPoint::Faults() const
{
  RecordedFaults known = journal_ ? journal_->FaultsFrom(tick_, ahead_) : RecordedFaults();
  // The journal may end before the log of events, so faults of the log are added.
  for (const RecordedFault& fault : requests_.failed)
    if (fault.tick >= tick_) known.faults.push_back(fault);
  return known;
}

void RestartPoint::Prepare(RunControlSetup& setup) const
{
  setup.goes_on = true;
  setup.failed = requests_.failed;
  setup.asked_from = requests_.until;
  std::vector<RecordedEvent> all = requests_.changes;
  AddUndone(all, setup.repeated);
  setup.repeated = std::move(all);
  if (requests_.speed) setup.real_time_factor = *requests_.speed;
  setup.paused = requests_.pause_at && *requests_.pause_at <= tick_;
  if (!requests_.pause_at || setup.paused) return;
  setup.pause_at = *requests_.pause_at;
  setup.step = requests_.step;
}

}  // namespace swarmanoid
