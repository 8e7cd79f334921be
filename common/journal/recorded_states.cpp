#include "common/journal/recorded_states.h"

#include <algorithm>

#include "common/space/space.h"
#include "common/space/state_checks.h"

namespace swarmanoid
{

RecordedStates::RecordedStates(const Experiment& experiment, const JournalBlocks& blocks, const JournalStart& start)
    : blocks_(blocks), start_(start), space_(std::make_unique<CSwarmanoidSpace>(experiment))
{
  initial_.tick = space_->GetTick();
  space_->WritePoses(initial_.poses);
  initial_.attributes.assign(space_->Attributes().Values().begin(), space_->Attributes().Values().end());
}

RecordedStates::~RecordedStates() = default;

bool RecordedStates::Next()
{
  if (!tick_) return SeekFrom(FirstTickOf(start_, blocks_.Places()));
  if (!NextRecord()) return false;
  if (record_.state.tick != *tick_ + 1) return SeekFrom(*tick_ + 1);
  space_->Apply(record_.state);
  tick_ = record_.state.tick;
  return true;
}

bool RecordedStates::NextRecord(std::uint64_t wanted)
{
  while (!records_ || !records_->Next(record_))
  {
    const std::vector<JournalPlace>& places = blocks_.Places();
    const auto place = std::find_if(places.begin(), places.end(),
                                    [this](const JournalPlace& p)
                                    { return p.kind == JournalBlockKind::kTicks && p.first_tick + p.ticks > *next_; });
    if (place == places.end()) return false;
    next_ = place->first_tick + place->ticks;
    records_.emplace(blocks_.Content(*place), place->ticks, wanted < *next_);
  }
  return true;
}

void RecordedStates::LoadStateBefore(std::uint64_t tick)
{
  const JournalPlace* newest = nullptr;
  for (const JournalPlace& place : blocks_.Places())
    if (place.kind == JournalBlockKind::kSnapshot && place.first_tick <= tick &&
        (newest == nullptr || place.first_tick > newest->first_tick))
      newest = &place;
  const bool is_ahead = tick_ && *tick_ <= tick && (newest == nullptr || newest->first_tick <= *tick_);
  if (is_ahead) return;
  tick_.reset();
  records_.reset();
  if (newest != nullptr)
  {
    const SpaceSnapshot snapshot = ReadSnapshot(blocks_.Content(*newest));
    CheckSnapshot(*space_, snapshot);
    space_->Apply(snapshot);
    next_ = newest->first_tick;
    return;
  }
  space_->Apply(initial_);
  next_ = start_.first_tick;
}

bool RecordedStates::SeekFrom(std::uint64_t tick)
{
  const std::uint64_t first = std::max(tick, FirstTickOf(start_, blocks_.Places()));
  for (const TickRange& range : ReadableTicks(start_, blocks_.Places()))
    if (range.end > first) return Seek(std::max(range.first, first));
  return false;
}

bool RecordedStates::Seek(std::uint64_t tick)
{
  const std::vector<JournalPlace>& places = blocks_.Places();
  if (tick < FirstTickOf(start_, places)) return false;
  const std::vector<TickRange> readable = ReadableTicks(start_, places);
  const auto range = std::find_if(readable.begin(), readable.end(),
                                  [tick](const TickRange& r) { return tick >= r.first && tick < r.end; });
  if (range == readable.end()) return false;
  LoadStateBefore(tick);
  // Values that no message of the ticks changed are as at the start of the experiment, or as in the saved state.
  if (tick_ == tick) return true;
  const std::uint64_t from = tick_ ? *tick_ + 1 : *next_;
  tick_.reset();
  // The poses are those of the tick. Attributes accumulate the changes of all ticks before it. Floor fields follow from
  // every tick before.
  const bool needs_each = !space_->Fields().empty();
  AttributeChanges changes;
  while (NextRecord(needs_each ? from : tick))
  {
    const SpaceState& state = record_.state;
    if (state.tick < from) continue;
    if (needs_each && state.tick < tick)
    {
      space_->Apply(state);
      continue;
    }
    for (std::size_t k = 0; k < state.attributes.slots.size(); ++k)
      changes.Add(state.attributes.slots[k], state.attributes.values[k]);
    if (state.tick < tick) continue;
    SpaceState whole = state;
    whole.attributes = std::move(changes);
    space_->Apply(whole);
    tick_ = state.tick;
    break;
  }
  if (tick_ == tick) return true;
  tick_.reset();
  return false;
}

}  // namespace swarmanoid
