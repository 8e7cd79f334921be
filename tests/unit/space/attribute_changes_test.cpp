// Slots ascend and occur once, in any order in which devices and engines add them.
#include "common/messages/attribute_changes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <random>

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;

TEST(AttributeChanges, AscendAndTheLastValueCounts)
{
  std::mt19937 random(1);
  AttributeChanges changes;
  AttributeOrder order;
  for (int round = 0; round < 500; ++round)
  {
    changes.Clear();
    std::map<std::uint32_t, double> expected;
    const auto count = random() % 40U;
    for (std::size_t k = 0; k < count; ++k)
    {
      const auto slot = static_cast<std::uint32_t>(random() % (round % 2 == 0 ? 20U : 0xffffffffU));
      changes.Add(slot, static_cast<double>(k));
      expected[slot] = static_cast<double>(k);
    }
    std::vector<std::uint32_t> slots;
    std::vector<double> values;
    for (const auto& [slot, value] : expected) slots.push_back(slot), values.push_back(value);
    order.Apply(changes);
    EXPECT_TRUE(IsOrdered(changes));
    EXPECT_EQ(changes.slots, slots);
    EXPECT_EQ(changes.values, values);
  }
}

TEST(AttributeChanges, ASlotThatStandsTwiceIsNotOrdered)
{
  AttributeChanges changes;
  changes.Add(3, 1);
  EXPECT_TRUE(IsOrdered(changes));
  changes.Add(3, 1);
  EXPECT_FALSE(IsOrdered(changes));
}

TEST(AttributeChanges, WhoReportsLastDecidesOnASlot)
{
  SparseVector<double> known;
  for (const double value : {0.0, 10.0, 20.0, 30.0}) known.push_back(value);
  AttributeChanges changes;
  ReportChanges(std::vector<std::uint32_t>{1, 2, 3}, std::vector<double>{10, 21, 31}, known, changes);
  EXPECT_THAT(changes.slots, ElementsAre(2, 3));
  // It leaves slot 2 as in the space, and does not change slot 3.
  ReportChanges(std::vector<std::uint32_t>{0, 1, 2}, std::vector<double>{0, 11, 20}, known, changes);
  AttributeOrder().Apply(changes);
  EXPECT_THAT(changes.slots, ElementsAre(1, 2, 3));
  EXPECT_THAT(changes.values, ElementsAre(11, 20, 31));
}

TEST(AttributeChanges, AreThoseAgainstTheSpaceAfterPendingChanges)
{
  SparseVector<double> known;
  for (const double value : {0.0, 10.0, 20.0, 30.0}) known.push_back(value);
  AttributeChanges pending, changes;
  pending.Add(1, 11);
  pending.Add(3, 31);
  changes.pending = &pending;
  // Slot 1 goes back to the value of the space, slot 2 stays, slot 3 keeps the pending value.
  ReportChanges(std::vector<std::uint32_t>{1, 2, 3}, std::vector<double>{10, 20, 31}, known, changes);
  EXPECT_THAT(changes.slots, ElementsAre(1));
  EXPECT_THAT(changes.values, ElementsAre(10));
  ReportChanges(std::vector<std::uint32_t>{0, 3}, std::vector<double>{1, 30}, known, changes);
  AttributeOrder().Apply(changes);
  EXPECT_THAT(changes.slots, ElementsAre(0, 1, 3));
  EXPECT_THAT(changes.values, ElementsAre(1, 10, 30));
  EXPECT_EQ(changes.pending, &pending);
}

TEST(AttributeChanges, OfRunsOfSlotsAreThoseOfSingleSlots)
{
  std::mt19937 random(2);
  for (int round = 0; round < 300; ++round)
  {
    // Robots have runs of slots, and some lie in pages that were never written.
    std::vector<std::uint32_t> slots;
    std::uint32_t next = 0;
    while (slots.size() < 60)
    {
      constexpr std::uint32_t kRuns[] = {1, 3, 12, 13, 27};
      next += random() % 5 == 0 ? 1000U : 1U + static_cast<std::uint32_t>(random() % 3);
      for (std::uint32_t k = kRuns[random() % 5]; k > 0; --k) slots.push_back(next++);
    }
    SparseVector<double> known;
    known.resize(next + 1);
    for (const std::uint32_t slot : slots)
      if (slot % 2000 < 900) known.Set(slot, static_cast<double>(random() % 3));
    std::vector<double> values;
    for (const std::uint32_t slot : slots) values.push_back(known[slot] + (random() % 30 == 0 ? 1 : 0));

    AttributeChanges changes, pending;
    if (round % 2 == 0)
      for (int k = 0; k < 3; ++k) changes.Add(slots[random() % slots.size()], 7);
    if (round % 3 == 0) pending.Add(slots[random() % slots.size()], 1);
    if (round % 3 == 0) changes.pending = &pending;
    AttributeChanges expected = changes;
    AttributeOrder().Apply(expected);
    const std::vector<std::uint32_t> before = expected.slots;
    for (std::size_t i = 0; i < slots.size(); ++i)
    {
      const bool is_pending = !pending.slots.empty() && pending.slots[0] == slots[i];
      const bool was_changed = std::ranges::find(before, slots[i]) != before.end();
      if (values[i] != (is_pending ? 1 : known[slots[i]]) || was_changed) expected.Add(slots[i], values[i]);
    }
    ReportChanges(slots, values, known, changes);
    EXPECT_EQ(changes.slots, expected.slots);
    EXPECT_EQ(changes.values, expected.values);
  }
}

}  // namespace
}  // namespace swarmanoid
