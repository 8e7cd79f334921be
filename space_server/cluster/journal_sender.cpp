// A replacement gets the newest state that the dead process saved together with the space, and all ticks since then. At
// the end it gets either the present tick or the sensor frames for it. The plan names places in the journal, so the
// blocks are read one by one when they are requested. If the robots have been dealt out otherwise since then, the
// commands of old ticks are converted (CommandsByRobot).
//
// Invariant: the ticks of a plan have no gap. A replacement that needs ticks which the journal has dropped is refused.
#include "space_server/cluster/journal_sender.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "common/journal/journal_blocks.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

// Returns the newest state of the process, before tick `end`, that was saved together with the space. `table`: the
// number of the hosts that must have saved it, or kUnknownTable for any.
std::optional<std::pair<JournalPlace, JournalPlace>> NewestState(const std::vector<JournalPlace>& places,
                                                                 const std::string& name, std::uint64_t after,
                                                                 std::uint64_t end, std::uint32_t table)
{
  for (auto part = places.rbegin(); part != places.rend(); ++part)
  {
    // At the first tick of the run the process needs no saved state.
    if (part->kind != JournalBlockKind::kPart || part->name != name || part->first_tick == after ||
        part->first_tick >= end)
      continue;
    if (table != kUnknownTable && part->table != table) continue;
    const auto snapshot =
        std::find_if(places.begin(), places.end(),
                     [&](const JournalPlace& place)
                     { return place.kind == JournalBlockKind::kSnapshot && place.first_tick == part->first_tick; });
    if (snapshot != places.end()) return std::pair(*snapshot, *part);
  }
  return std::nullopt;
}

// Returns whether the blocks have all ticks of the journal from that one on.
bool HasTicksFrom(const std::vector<JournalPlace>& places, std::uint64_t tick)
{
  return std::ranges::any_of(places, [tick](const JournalPlace& place)
                             { return place.kind == JournalBlockKind::kTicks && place.first_tick <= tick; });
}

}  // namespace

JournalSender::JournalSender(ServerSession& session, Lockstep& lockstep, const CSwarmanoidSpace& space,
                             const Assignment& assignment, JournalWriter* journal)
    : session_(session),
      lockstep_(lockstep),
      assignment_(assignment),
      acts_later_(space.GetExperiment().ahead > 0),
      shared_(space, assignment),
      journal_(journal)
{
}

void JournalSender::Work()
{
  for (const RecoveryRequestMessage& request : session_.TakeRecoveryRequests())
  {
    if (request.number == 0) plans_[request.process] = MakePlan(request.name);
    const auto plan = plans_.find(request.process);
    if (plan == plans_.end() || request.number > plan->second.places.size()) continue;
    const std::vector<JournalPlace>& places = plan->second.places;
    RecoveryBlockMessage answer{
        request.run, request.process, request.number, static_cast<std::uint32_t>(places.size() + 1), {}};
    answer.block = request.number < places.size() ? BlockAt(places[request.number]) : plan->second.last;
    session_.Answer(answer);
  }
}

std::vector<char> JournalSender::BlockAt(const JournalPlace& place)
{
  std::vector<char> block = journal_->Read(place);
  if (place.kind != JournalBlockKind::kTicks) return block;
  return shared_.Of(journal_->Table(place.table), std::move(block), place.ticks);
}

JournalSender::Plan JournalSender::MakePlan(const std::string& name)
{
  if (journal_ == nullptr || !journal_->Works())
    throw BusError(fmt::format("{} cannot be replaced: the journal of the run has ended", name));
  const auto [record, is_done] = lockstep_.Withdraw(name, session_.Incarnation(name));
  const std::uint64_t tick = record.state.tick;
  journal_->Flush();
  std::vector<JournalPlace> all = journal_->RecentPlaces();
  Plan plan;
  const JournalStart start = journal_->Start();
  std::uint64_t first = start.first_tick;
  bool is_host = false;
  for (std::size_t h = 0; h < assignment_.hosts.size(); ++h) is_host = is_host || name == HostName(h);
  const std::uint32_t table = is_host && !all.empty() ? all.back().table : kUnknownTable;
  // If commands act a tick later, others may lack what the process sent in the tick before. It computes that tick.
  const std::uint64_t end = tick + (acts_later_ ? 0 : 1);
  auto state = NewestState(all, name, first, end, table);
  if (!state || !HasTicksFrom(all, state->second.first_tick))
  {
    all = journal_->Places();
    state = NewestState(all, name, first, end, table);
  }
  if (state)
  {
    plan.places = {state->first, state->second};
    first = state->second.first_tick;
  }
  else if (const std::uint64_t kept = FirstTickOf(start, all); kept > first)
    // The error is no BusError, since restarting all processes would not help either.
    throw std::runtime_error(
        fmt::format("{} cannot be replaced: it saves no state, so it would do all ticks again, and of those before {} "
                    "nothing is left (--journal-budget); `swarmanoid resume` goes on from a saved state",
                    name, kept));
  for (JournalPlace& place : all)
  {
    if (place.kind != JournalBlockKind::kTicks || place.first_tick + place.ticks <= first || place.first_tick >= tick)
      continue;
    // The journal may have a record of the present tick, which an earlier space server wrote.
    place.ticks = static_cast<std::uint32_t>(std::min<std::uint64_t>(place.ticks, tick - place.first_tick));
    plan.places.push_back(std::move(place));
  }
  std::span<const char> last;
  ReusedMemory room;
  if (is_done)
  {
    // The engines may have all that they need of this tick. Then the run continues as soon as the new process is ready.
    TickRows rows;
    rows.Add(record.state, record.save, record.frames, {});
    last = EncodeJournalBlock(JournalBlockKind::kTicks, tick, 1, rows.Content(room));
  }
  else
    last = EncodeJournalBlock(JournalBlockKind::kFrames, tick, 0, ContentOf(record.frames));
  plan.last.assign(last.begin(), last.end());
  return plan;
}

}  // namespace swarmanoid
