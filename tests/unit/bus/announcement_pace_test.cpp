// Announcements of processes that need not be sent again so soon.
#include "common/bus/dds/announcement_pace.h"

#include <gtest/gtest.h>

#include <string>

#include "rtps_datagrams.h"

namespace swarmanoid::test
{
namespace
{

using namespace std::chrono_literals;

const std::string kAnnouncement =
    RtpsHeader() + RtpsSubmessage(0x09, 0, Word(1) + Word(2)) + Data(kTellsParticipants, kHasData, "this process");

struct Announcements : testing::Test
{
  AnnouncementPace pace;
  AnnouncementPace::Clock::time_point now{};
  int socket = 0, another_socket = 0;

  bool IsEarly(const std::string& announcement, std::uint64_t address)
  {
    return IsEarlyBy(socket, announcement, address);
  }
  bool IsEarlyBy(const int& by, const std::string& announcement, std::uint64_t address)
  {
    return pace.IsEarly(announcement, {&by, address}, now);
  }
};

TEST_F(Announcements, AreKnownByTheirWriter)
{
  EXPECT_TRUE(AnnouncementPace::IsAnnouncement(kAnnouncement));
  EXPECT_FALSE(AnnouncementPace::IsAnnouncement(RtpsHeader() + Data(kTellsTheirWriters, kHasData, "this process")));
  EXPECT_FALSE(AnnouncementPace::IsAnnouncement(RtpsHeader() + Data(kUserWriter, kHasData, "this process")));
  EXPECT_FALSE(AnnouncementPace::IsAnnouncement(RtpsHeader()));
}

TEST_F(Announcements, GoToAnAddressOnceInAWhile)
{
  EXPECT_FALSE(IsEarly(kAnnouncement, 1));
  now += 100ms;
  EXPECT_TRUE(IsEarly(kAnnouncement, 1));
  now += 99ms;
  EXPECT_TRUE(IsEarly(kAnnouncement, 1)) << "what was left out prolonged the time";
  now += 1ms;
  EXPECT_FALSE(IsEarly(kAnnouncement, 1));
  now += 100ms;
  EXPECT_TRUE(IsEarly(kAnnouncement, 1));
}

TEST_F(Announcements, GoToANewProcessAtOnce)
{
  EXPECT_FALSE(IsEarly(kAnnouncement, 1));
  EXPECT_FALSE(IsEarly(kAnnouncement, 2));
  EXPECT_FALSE(IsEarlyBy(another_socket, kAnnouncement, 1)) << "the first socket may not reach it";
  EXPECT_TRUE(IsEarly(kAnnouncement, 2));
}

TEST_F(Announcements, GoAtOnceIfTheyHaveChanged)
{
  EXPECT_FALSE(IsEarly(kAnnouncement, 1));
  const std::string end = RtpsHeader() + Data(kTellsParticipants, kHasKey, "gone");
  EXPECT_FALSE(IsEarly(end, 1));
  EXPECT_FALSE(IsEarly(kAnnouncement, 1));
}

}  // namespace
}  // namespace swarmanoid::test
