#include "common/space/slot_table.h"

#include <gtest/gtest.h>

#include "common/space/attributes.h"

namespace swarmanoid
{
namespace
{

// Beside what a walk over all entities finds.
TEST(SlotTable, TellsWhoHasASlotAndWhatItIs)
{
  using enum EntityKind;
  const std::vector<std::pair<EntityKind, std::uint32_t>> entities{
      {kWall, 0},    {kHole, 0},        {kFootbot, 0}, {kFootbot, 0},  {kHole, 0},    {kFootbot, 0},
      {kFootbot, 3}, {kFootbot, 3},     {kEyebot, 0},  {kHandbot, 2},  {kFootbot, 0}, {kFootbot, 0},
      {kFootbot, 3}, {kGroundPatch, 0}, {kWall, 0},    {kLightBulb, 0}};
  SlotTable table;
  for (const auto& [kind, further] : entities) table.Add(kind, further);
  std::uint32_t slot = 0;
  for (std::uint32_t entity = 0; entity < entities.size(); ++entity)
  {
    const auto expect = [&](AttributeValue value, std::uint32_t count)
    {
      for (; count > 0; --count, ++slot)
      {
        EXPECT_EQ(table[slot], value) << slot;
        EXPECT_EQ(table.EntityOf(slot), entity) << slot;
      }
    };
    for (const AttributeSpec& spec : AttributesOf(entities[entity].first))
      expect(spec.value, static_cast<std::uint32_t>(spec.count));
    expect(AttributeValue::kBytes, entities[entity].second);
  }
  EXPECT_EQ(table.size(), slot);
  EXPECT_GT(slot, 300U);
  for (std::uint32_t entity = 0; entity < entities.size(); ++entity, ++slot)
  {
    EXPECT_EQ(table[slot], AttributeValue::kPresence);
    EXPECT_EQ(table.EntityOf(slot), entity);
  }
}

}  // namespace
}  // namespace swarmanoid
