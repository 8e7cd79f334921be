#include "common/messages/attribute_changes.h"

#include <algorithm>
#include <functional>

#include "common/math/lanes.h"

namespace swarmanoid
{

bool IsOrdered(const AttributeChanges& changes)
{
  return changes.slots.size() == changes.values.size() &&
         std::adjacent_find(changes.slots.begin(), changes.slots.end(), std::greater_equal<>()) == changes.slots.end();
}

// Devices add changes in the order of robots, so there are a few ascending runs to merge.
void AttributeOrder::Apply(AttributeChanges& changes)
{
  if (IsOrdered(changes)) return;
  places_.clear();
  for (std::size_t i = 0; i < changes.slots.size(); ++i)
    places_.push_back(static_cast<std::uint64_t>(changes.slots[i]) << 32U | i);
  merged_.resize(places_.size());
  while (!std::is_sorted(places_.begin(), places_.end()))
  {
    for (auto first = places_.begin(); first != places_.end();)
    {
      const auto second = std::is_sorted_until(first, places_.end());
      const auto end = std::is_sorted_until(second, places_.end());
      std::merge(first, second, second, end, merged_.begin() + (first - places_.begin()));
      first = end;
    }
    places_.swap(merged_);
  }

  ordered_.Clear();
  for (std::size_t k = 0; k < places_.size(); ++k)
  {
    const auto slot = static_cast<std::uint32_t>(places_[k] >> 32U);
    if (k + 1 < places_.size() && places_[k + 1] >> 32U == slot) continue;  // a later value counts
    ordered_.Add(slot, changes.values[static_cast<std::uint32_t>(places_[k])]);
  }
  changes.slots.swap(ordered_.slots);
  changes.values.swap(ordered_.values);
}

namespace
{

// The slots that many robots have next to each other: those of LEDs and of a message.
constexpr std::size_t kRing = 12;
constexpr std::size_t kMessage = 3;

// Returns whether values[0] … of slots[0] …, as many as kSlots, are in `known`. The slots ascend.
template <std::size_t kSlots>
bool AreKnown(const std::uint32_t* slots, const double* values, const SparseVector<double>& known)
{
  if (slots[kSlots - 1] - slots[0] != kSlots - 1) return false;
  const double* const before = known.Part(slots[0], kSlots).data();
  std::size_t i = 0;
  LongLanes differ{};
  for (; i + kDoubleLanes <= kSlots; i += kDoubleLanes) differ |= LoadLanes(before + i) != LoadLanes(values + i);
  bool are_known = LaneMask(differ) == 0;
  for (; i < kSlots; ++i) are_known &= before[i] == values[i];
  return are_known;
}

}  // namespace

void ReportChanges(std::span<const std::uint32_t> slots, std::span<const double> values,
                   const SparseVector<double>& known, AttributeChanges& changes)
{
  std::size_t next = 0;  // of the pending changes
  const auto differs = [&](std::uint32_t slot, double value)
  {
    if (changes.pending == nullptr) return known[slot] != value;
    const AttributeChanges& pending = *changes.pending;
    while (next < pending.slots.size() && pending.slots[next] < slot) ++next;
    const bool is_pending = next < pending.slots.size() && pending.slots[next] == slot;
    return (is_pending ? pending.values[next] : known[slot]) != value;
  };
  thread_local AttributeOrder order;
  if (!changes.slots.empty()) order.Apply(changes);
  const std::size_t others = changes.slots.size();
  std::size_t other = 0;
  for (std::size_t i = 0; i < slots.size();)
  {
    while (other < others && changes.slots[other] < slots[i]) ++other;
    // Most attributes stay, so several are compared at once.
    const auto stay = [&]<std::size_t kSlots>()
    {
      if (slots.size() - i < kSlots || changes.pending != nullptr) return false;
      if (other < others && changes.slots[other] <= slots[i + kSlots - 1]) return false;
      return AreKnown<kSlots>(&slots[i], &values[i], known);
    };
    if (const std::size_t known_slots = stay.template operator()<kRing>()      ? kRing
                                        : stay.template operator()<kMessage>() ? kMessage
                                                                               : 0;
        known_slots != 0)
    {
      i += known_slots;
      continue;
    }
    const bool changed_before = other < others && changes.slots[other] == slots[i];
    if (differs(slots[i], values[i]) || changed_before) changes.Add(slots[i], values[i]);
    ++i;
  }
}

}  // namespace swarmanoid
