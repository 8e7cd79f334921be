#include "common/space/slot_table.h"

#include <algorithm>

#include "common/space/attributes.h"

namespace swarmanoid
{

void SlotTable::Add(EntityKind kind, std::uint32_t further, bool changes_engine, std::uint32_t numbers)
{
  const std::uint32_t entity = entities_++;
  const Run* last = runs_.empty() ? nullptr : &runs_.back();
  const bool is_alike = last != nullptr && last->kind == kind && last->further == further &&
                        last->changes_engine == changes_engine && last->numbers == numbers;
  if (is_alike && last->first_entity + (slots_ - last->first_slot) / last->values->size() == entity)
  {
    slots_ += static_cast<std::uint32_t>(last->values->size());
    return;
  }
  const Values* values = ValuesOf(kind, further, changes_engine, numbers);
  if (values->empty()) return;
  runs_.push_back({slots_, entity, kind, further, changes_engine, numbers, values});
  slots_ += static_cast<std::uint32_t>(values->size());
}

const SlotTable::Values* SlotTable::ValuesOf(EntityKind kind, std::uint32_t further, bool changes_engine,
                                             std::uint32_t numbers)
{
  const auto same = std::ranges::find_if(runs_,
                                         [&](const Run& run)
                                         {
                                           return run.kind == kind && run.further == further &&
                                                  run.changes_engine == changes_engine && run.numbers == numbers;
                                         });
  if (same != runs_.end()) return same->values;
  Values values;
  for (const AttributeSpec& spec : AttributesOf(kind))
    values.insert(values.end(), static_cast<std::size_t>(spec.count), spec.value);
  values.insert(values.end(), further, AttributeValue::kBytes);
  values.insert(values.end(), numbers, AttributeValue::kNumber);
  if (changes_engine)
  {
    values.insert(values.end(), EngineSlots::kVelocity, AttributeValue::kEngine);
    values.insert(values.end(), EngineSlots::kCount - EngineSlots::kVelocity, AttributeValue::kNumber);
  }
  return layouts_.emplace_back(std::make_unique<const Values>(std::move(values))).get();
}

const SlotTable::Run& SlotTable::RunOf(std::uint32_t slot) const
{
  const auto behind = std::ranges::upper_bound(runs_, slot, {}, &Run::first_slot);
  return *(behind - 1);
}

}  // namespace swarmanoid
