#include "common/bus/membership/tick_gate.h"

#include <gmock/gmock.h>

#include "common/bus/bus.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

using Verdict = TickGate::Verdict;

TEST(TickGate, CompletesWhenEveryPartIsHereInWhateverOrder)
{
  TickGate gate({{"a"}, {"b"}, {"c"}});
  EXPECT_FALSE(gate.Arrived(2, 0));
  EXPECT_FALSE(gate.Arrived(0, 0));
  EXPECT_THAT(gate.Missing(), testing::ElementsAre("b"));
  EXPECT_TRUE(gate.Arrived(1, 0));
  gate.Next();
  EXPECT_EQ(gate.Tick(), 1U);
  EXPECT_EQ(gate.Missing().size(), 3U);
}

TEST(TickGate, WaitsAgainForWhoeverIsReplacedAndHearsTheOldOneNoMore)
{
  TickGate gate({{"engine"}, {"host"}, {"engine"}});
  gate.StartAt(7);
  EXPECT_FALSE(gate.IsReplaced(0, 0));
  gate.Arrived(0, 7);
  gate.Arrived(2, 7);
  gate.Withdraw("engine", 1);
  gate.Withdraw("engine", 1);
  EXPECT_TRUE(gate.IsReplaced(2, 0)) << "it was still on its way";
  EXPECT_FALSE(gate.Arrived(1, 7));
  EXPECT_THAT(gate.Missing(), testing::ElementsAre("engine", "engine"));
  EXPECT_FALSE(gate.IsReplaced(0, 2));
  EXPECT_TRUE(gate.IsReplaced(0, 1)) << "it comes back";
  EXPECT_FALSE(gate.IsReplaced(1, 0));
  EXPECT_FALSE(gate.Arrived(0, 7));
  EXPECT_TRUE(gate.Arrived(2, 7));
}

TEST(TickGate, KnowsRepetitions)
{
  TickGate gate({{"a"}, {"b"}});
  EXPECT_EQ(gate.Offer(0, 0), Verdict::kExpected);
  gate.Arrived(0, 0);
  EXPECT_EQ(gate.Offer(0, 0), Verdict::kDrop);
  gate.Arrived(1, 0);
  gate.Next();
  EXPECT_EQ(gate.Offer(0, 0), Verdict::kBefore);
  gate.Arrived(0, 1);
  gate.Arrived(1, 1);
  gate.Next();
  EXPECT_EQ(gate.Offer(0, 0), Verdict::kDrop);
}

TEST(TickGate, APartThatComesAgainDoesNotStandForAnother)
{
  TickGate gate({{"a"}, {"b"}, {"c", true}});
  for (int time = 0; time < 3; ++time) EXPECT_FALSE(gate.Arrived(0, 0));
  EXPECT_FALSE(gate.Complete());
  EXPECT_THAT(gate.Missing(), testing::ElementsAre("b", "c"));
  gate.Arrived(1, 0);
  for (int time = 0; time < 2; ++time) EXPECT_FALSE(gate.Arrived(2, 1));
  EXPECT_TRUE(gate.Arrived(2, 0));
  gate.Next();
  EXPECT_THAT(gate.Missing(), testing::ElementsAre("a", "b"));
}

TEST(TickGate, ATickThatCannotFollowIsAnErrorWithBothNumbers)
{
  TickGate gate({{"space server"}});
  gate.Arrived(0, 0);
  gate.Next();
  EXPECT_THAT(
      test::MessageOf<BusError>([&] { gate.Offer(0, 17); }),
      testing::AllOf(testing::HasSubstr("17"), testing::HasSubstr("tick 1 "), testing::HasSubstr("space server")));
}

TEST(TickGate, AnIndependentSenderMayBeOneTickAhead)
{
  TickGate gate({{"state"}, {"frame", true}});
  gate.Arrived(1, 0);
  EXPECT_EQ(gate.Offer(1, 1), Verdict::kExpected);
  gate.Arrived(1, 1);
  EXPECT_EQ(gate.Offer(1, 1), Verdict::kDrop);
  EXPECT_THROW(gate.Offer(1, 2), BusError);
  EXPECT_TRUE(gate.Arrived(0, 0));
  gate.Next();
  EXPECT_THAT(gate.Missing(), testing::ElementsAre("state"));
  EXPECT_TRUE(gate.Arrived(0, 1));
}

TEST(TickGate, WhatCameATickEarlyHasToComeAgainFromWhoeverReplacesItsSender)
{
  TickGate gate({{"engine"}, {"host", true}});
  EXPECT_TRUE(gate.MayLead(1) && !gate.MayLead(0));
  gate.Arrived(1, 0);
  gate.Arrived(1, 1);
  gate.Withdraw("host", 1);
  EXPECT_EQ(gate.Offer(1, 0), Verdict::kExpected);
  EXPECT_EQ(gate.Offer(1, 1), Verdict::kExpected);
  gate.Arrived(1, 0);
  EXPECT_TRUE(gate.Arrived(0, 0));
  gate.Next();
  EXPECT_THAT(gate.Missing(), testing::ElementsAre("engine", "host"));
}

TEST(JoinedNames, AreCountedIfTheyAreMany)
{
  std::vector<std::string> names;
  EXPECT_EQ(Joined(names), "");
  names = {"a"};
  EXPECT_EQ(Joined(names), "a");
  names = {"a", "b", "c", "d", "e", "f", "g"};
  EXPECT_EQ(Joined(names), "a, b, c, d, e, f, g");
  names.emplace_back("h");
  EXPECT_EQ(Joined(names), "a, b, c, d, e, f and 2 others");
}

}  // namespace
}  // namespace swarmanoid
