// SlotTable: the meaning and the entity of each slot of the attributes. In most experiments entities with the same
// slots are consecutive. So the table has one entry for each such group, not one for each slot.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/experiment/experiment.h"

namespace swarmanoid
{

// The last slots of an entity that changes its engine.
struct EngineSlots
{
  static constexpr std::uint32_t kEngine = 0;    // the engine that moves it in the next tick
  static constexpr std::uint32_t kBefore = 1;    // the engine that moved it in the last tick
  static constexpr std::uint32_t kVelocity = 2;  // m/s of its position, along x, y and z, when it last left its volume
  static constexpr std::uint32_t kSpin = 5;      // rad/s about x, y and z, at the same time
  static constexpr std::uint32_t kCount = 8;
};

class SlotTable
{
public:
  // Adds the next entity in order: the attributes of its kind, then `further` slots of a long message, then `numbers`:
  // the rates of its deposits to floor fields and its battery (BatterySlots), then the slots of an entity that changes
  // its engine (EngineSlots).
  void Add(EntityKind kind, std::uint32_t further, bool changes_engine = false, std::uint32_t numbers = 0);

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
    bool changes_engine;
    std::uint32_t numbers;
    const Values* values;  // the slots of each of its entities; never empty
  };

  const Run& RunOf(std::uint32_t slot) const;
  const Values* ValuesOf(EntityKind kind, std::uint32_t further, bool changes_engine, std::uint32_t numbers);

  std::vector<Run> runs_;  // has no entry for entities without attributes
  std::vector<std::unique_ptr<const Values>> layouts_;
  std::uint32_t slots_ = 0;
  std::uint32_t entities_ = 0;
};

}  // namespace swarmanoid
