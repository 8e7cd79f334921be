#include "space_server/cluster/recovery_service.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace swarmanoid
{
namespace
{

// The newest state of the process that was saved together with the space.
std::optional<std::pair<JournalPlace, JournalPlace>> NewestState(const std::vector<JournalPlace>& places,
                                                                 const std::string& name)
{
  for (auto part = places.rbegin(); part != places.rend(); ++part)
  {
    if (part->kind != JournalBlockKind::kPart || part->name != name) continue;
    const auto snapshot =
        std::find_if(places.begin(), places.end(),
                     [&](const JournalPlace& place)
                     { return place.kind == JournalBlockKind::kSnapshot && place.first_tick == part->first_tick; });
    if (snapshot != places.end()) return std::pair(*snapshot, *part);
  }
  return std::nullopt;
}

}  // namespace

void RecoveryService::Work()
{
  for (const RecoveryRequestMessage& request : session_.TakeRecoveryRequests())
  {
    if (request.number == 0) plans_[request.process] = MakePlan(request.name);
    const auto plan = plans_.find(request.process);
    if (plan == plans_.end() || request.number > plan->second.places.size()) continue;
    const std::vector<JournalPlace>& places = plan->second.places;
    RecoveryBlockMessage answer{
        request.run, request.process, request.number, static_cast<std::uint32_t>(places.size() + 1), {}};
    answer.block = request.number < places.size() ? journal_->Read(places[request.number]) : plan->second.last;
    session_.Answer(answer);
  }
}

RecoveryService::Plan RecoveryService::MakePlan(const std::string& name)
{
  if (journal_ == nullptr || !journal_->Works())
    throw BusError(fmt::format("{} cannot be replaced: the journal of the run has ended", name));
  const auto [record, is_done] = lockstep_.Withdraw(name, session_.Incarnation(name));
  const std::uint64_t tick = record.state.tick;
  journal_->Flush();
  const std::vector<JournalPlace> all = journal_->Places();
  Plan plan;
  std::uint64_t first = 0;
  if (const auto state = NewestState(all, name))
  {
    plan.places = {state->first, state->second};
    first = state->second.first_tick;
  }
  for (const JournalPlace& place : all)
    if (place.kind == JournalBlockKind::kTicks && place.first_tick + place.ticks > first && place.first_tick < tick)
      plan.places.push_back(place);
  if (is_done)
  {
    // The engines may have all that they need of it: then the run goes on as soon as the new process is there.
    TickRows rows;
    rows.Add(record.state, record.save, record.frames, {});
    plan.last = EncodeJournalBlock(JournalBlockKind::kTicks, tick, 1, rows.Content());
  }
  else
    plan.last = EncodeJournalBlock(JournalBlockKind::kFrames, tick, 0, ContentOf(record.frames));
  return plan;
}

}  // namespace swarmanoid
