// Datagrams of discovery that need not go again so soon.
#include "common/bus/security/discovery_pace.h"

#include <gtest/gtest.h>

#include <string>

#include "rtps_datagrams.h"

namespace swarmanoid::test
{
namespace
{

using namespace std::chrono_literals;

std::string WhatMayBeLeftOut(const std::string& datagram, bool spreads = false)
{
  return DiscoveryPace::WhatMayBeLeftOut(datagram, spreads);
}

std::string HeartbeatOf(const std::string& writer, unsigned last, unsigned count)
{
  return RtpsSubmessage(0x07, 0, kUnknown + writer + SequenceNumber(1) + SequenceNumber(last) + Word(count));
}
std::string To(const std::string& prefix) { return RtpsSubmessage(0x0e, 0, prefix); }

const std::string kAnnouncement =
    RtpsHeader() + RtpsSubmessage(0x09, 0, Word(1) + Word(2)) + Data(kTellsParticipants, kHasData, "this process");

TEST(DatagramsThatMayBeLeftOut, AreAnnouncementsAsAWhole)
{
  EXPECT_EQ(WhatMayBeLeftOut(kAnnouncement), kAnnouncement);
  EXPECT_EQ(WhatMayBeLeftOut(RtpsHeader() + Data(kTellsTheirWriters, kHasData, "this process")), "");
  EXPECT_EQ(WhatMayBeLeftOut(RtpsHeader() + Data(kUserWriter, kHasData, "this process")), "");
  EXPECT_EQ(WhatMayBeLeftOut(RtpsHeader()), "");
  EXPECT_EQ(WhatMayBeLeftOut(RtpsHeader() + To("the stranger") + Data(kTellsParticipants, kHasData, "x")), "");
}

TEST(DatagramsThatMayBeLeftOut, AreHeartbeatsToAllWithoutTheirCount)
{
  const auto of = [](unsigned last, unsigned count)
  { return RtpsHeader() + HeartbeatOf(kTellsTheirWriters, last, count); };
  EXPECT_NE(WhatMayBeLeftOut(of(3, 1)), "");
  EXPECT_EQ(WhatMayBeLeftOut(of(3, 1)), WhatMayBeLeftOut(of(3, 2)));
  EXPECT_NE(WhatMayBeLeftOut(of(3, 1)), WhatMayBeLeftOut(of(4, 1)));
  EXPECT_NE(WhatMayBeLeftOut(of(3, 1)), WhatMayBeLeftOut(RtpsHeader() + HeartbeatOf(kTellsLiveliness, 3, 1)));
  EXPECT_NE(WhatMayBeLeftOut(RtpsHeader() + To(std::string(12, '\0')) + HeartbeatOf(kTellsTheirWriters, 3, 1)), "");
  EXPECT_EQ(WhatMayBeLeftOut(RtpsHeader() + To("the stranger") + HeartbeatOf(kTellsTheirWriters, 3, 1)), "")
      << "an answer to one process";
  EXPECT_NE(WhatMayBeLeftOut(of(3, 1), true), "");
  EXPECT_NE(WhatMayBeLeftOut(RtpsHeader() + HeartbeatOf(kUserWriter, 3, 1), false), "");
  EXPECT_EQ(WhatMayBeLeftOut(RtpsHeader() + HeartbeatOf(kUserWriter, 3, 1), true), "") << "it finds what was lost";
  EXPECT_EQ(WhatMayBeLeftOut(of(3, 1) + Data(kTellsTheirWriters, kHasData, "a writer")), "") << "data would be lost";
  EXPECT_EQ(WhatMayBeLeftOut(of(3, 1).substr(0, 40)), "");
}

struct WhatWasSaid : testing::Test
{
  DiscoveryPace pace;
  DiscoveryPace::Clock::time_point now{};
  int socket = 0, another_socket = 0;

  bool IsEarly(const std::string& what, std::uint64_t address) { return pace.IsEarly(what, {&socket, address}, now); }
  // Says something so often that only the pace allows more.
  void Say(const std::string& what, std::uint64_t address)
  {
    for (unsigned time = 0; time < DiscoveryPace::kFirst; ++time) EXPECT_FALSE(IsEarly(what, address));
  }
};

TEST_F(WhatWasSaid, GoesToAnAddressOnceInAWhile)
{
  Say("here", 1);
  now += 100ms;
  EXPECT_TRUE(IsEarly("here", 1));
  now += 49ms;
  EXPECT_TRUE(IsEarly("here", 1)) << "what was left out prolonged the time";
  now += 1ms;
  EXPECT_FALSE(IsEarly("here", 1));
  now += 100ms;
  EXPECT_TRUE(IsEarly("here", 1));
}

TEST_F(WhatWasSaid, GoesToANewProcessAtOnce)
{
  Say("here", 1);
  EXPECT_TRUE(IsEarly("here", 1));
  EXPECT_FALSE(IsEarly("here", 2));
  EXPECT_FALSE(pace.IsEarly("here", {&another_socket, 1}, now)) << "the first socket may not reach it";
}

TEST_F(WhatWasSaid, GoesAtOnceIfItIsNew)
{
  Say("here", 1);
  EXPECT_FALSE(IsEarly("gone", 1));
  EXPECT_TRUE(IsEarly("here", 1));
}

TEST_F(WhatWasSaid, IsRememberedAsLongAsItMatters)
{
  constexpr std::uint64_t kMany = 3'000;
  for (std::uint64_t address = 0; address < kMany; ++address) Say("here", address);
  for (std::uint64_t address = 0; address < kMany; ++address) EXPECT_TRUE(IsEarly("here", address));
  now += 150ms;
  for (std::uint64_t address = 0; address < kMany; ++address) Say("there", address);
  for (std::uint64_t address = 0; address < kMany; ++address) EXPECT_TRUE(IsEarly("there", address));
}

}  // namespace
}  // namespace swarmanoid::test
