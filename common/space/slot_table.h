// SlotTable: the meaning and the entity of each slot of the attributes. In most experiments entities with the same
// slots are consecutive. So the table has one entry for each such group, not one for each slot.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

class SlotTable
{
public:
  // The next entity in order: the attributes of its kind, then `further` slots of a long message.
  void Add(EntityKind kind, std::uint32_t further);

  // Returns the number of slots of all attributes, with the presence of each entity at the end.
  std::uint32_t size() const { return slots_; }
  AttributeValue operator[](std::uint32_t slot) const
  {
    if (slot >= slots_) return AttributeValue::kPresence;
    const Run& run = RunOf(slot);
    return (*run.values)[(slot - run.first_slot) % run.values->size()];
  }
  std::uint32_t EntityOf(std::uint32_t slot) const
  {
    if (slot >= slots_) return slot - slots_;
    const Run& run = RunOf(slot);
    return run.first_entity + (slot - run.first_slot) / static_cast<std::uint32_t>(run.values->size());
  }

private:
  using Values = std::vector<AttributeValue>;
  struct Run
  {
    std::uint32_t first_slot;
    std::uint32_t first_entity;
    EntityKind kind;
    std::uint32_t further;
    const Values* values;  // of the slots of each of its entities; never empty
  };

  const Run& RunOf(std::uint32_t slot) const;
  const Values* ValuesOf(EntityKind kind, std::uint32_t further);

  std::vector<Run> runs_;  // none of entities without attributes
  std::vector<std::unique_ptr<const Values>> layouts_;
  std::uint32_t slots_ = 0;
  std::uint32_t entities_ = 0;
};

}  // namespace swarmanoid
