// Slots ascend and occur once, in any order in which devices and engines add them.
#include "common/messages/attribute_changes.h"

#include <gmock/gmock.h>

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

}  // namespace
}  // namespace swarmanoid
