// Datagrams of RTPS that are joined are what readers of any make take apart again.
#include "real_robot/drivers/ros2/joined_datagrams.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>

namespace swarmanoid::ros2
{
namespace
{

using Bytes = std::vector<unsigned char>;

constexpr unsigned char kTimestamp = 0x09;
constexpr unsigned char kDestination = 0x0e;
constexpr unsigned char kData = 0x15;
constexpr unsigned char kStatistics = 0x80;

Bytes Header(unsigned char participant = 1)
{
  Bytes header;
  for (const char letter : {'R', 'T', 'P', 'S'}) header.push_back(static_cast<unsigned char>(letter));
  while (header.size() < 20) header.push_back(participant);
  return header;
}

// Little-endian, so many bytes behind its own header.
void Add(Bytes& datagram, unsigned char kind, std::size_t length, unsigned char filling = 0)
{
  for (const std::size_t byte : {std::size_t{kind}, std::size_t{1}, length, length >> 8U})
    datagram.push_back(static_cast<unsigned char>(byte));
  for (std::size_t i = 0; i < length; ++i) datagram.push_back(filling);
}

Bytes Message(unsigned char filling, std::size_t length = 40, bool has_statistics = true)
{
  Bytes datagram = Header();
  Add(datagram, kDestination, 12, 7);
  Add(datagram, kTimestamp, 8);
  Add(datagram, kData, length, filling);
  if (has_statistics) Add(datagram, kStatistics, 56);
  return datagram;
}

// Kind and first byte of each, as a reader goes through them.
std::vector<std::pair<int, int>> SubmessagesOf(const Bytes& datagram)
{
  std::vector<std::pair<int, int>> found;
  std::size_t at = 20;
  while (at + 4 <= datagram.size())
  {
    const std::size_t length = datagram[at + 2] | static_cast<std::size_t>(datagram[at + 3]) << 8U;
    found.emplace_back(datagram[at], length == 0 ? -1 : datagram[at + 4]);
    at += 4 + length;
  }
  EXPECT_EQ(at, datagram.size());
  return found;
}

TEST(JoinedDatagrams, SubmessagesOfAllFollowOneAnotherBehindOneHeader)
{
  Bytes datagram = Message(1);
  ASSERT_TRUE(Join(datagram, Message(2), 1'400));
  ASSERT_TRUE(Join(datagram, Message(3, 80), 1'400));
  const std::vector<std::pair<int, int>> own{{kDestination, 7}, {kTimestamp, 0}};
  std::vector<std::pair<int, int>> expected;
  for (int filling = 1; filling <= 3; ++filling)
  {
    // The time and destination of the datagram before no longer apply.
    if (filling > 1) expected.emplace_back(kTimestamp, -1);
    if (filling > 1) expected.emplace_back(kDestination, 0);
    for (const auto& submessage : own) expected.push_back(submessage);
    expected.emplace_back(kData, filling);
  }
  // Fast DDS looks for it at the end.
  expected.emplace_back(kStatistics, 0);
  EXPECT_EQ(SubmessagesOf(datagram), expected);
  EXPECT_TRUE(std::equal(datagram.begin(), datagram.begin() + 20, Header().begin()));
}

TEST(JoinedDatagrams, NoDatagramIsLongerThanItMayBe)
{
  Bytes datagram = Message(1, 40, false);
  const std::size_t before = datagram.size();
  const std::size_t after = before + 20 + before - 20;
  EXPECT_FALSE(Join(datagram, Message(2, 40, false), after - 1));
  EXPECT_EQ(datagram, Message(1, 40, false));
  EXPECT_TRUE(Join(datagram, Message(2, 40, false), after));
  EXPECT_EQ(datagram.size(), after);
}

TEST(JoinedDatagrams, WhatCannotBeJoinedIsLeft)
{
  const Bytes first = Message(1);
  const auto is_refused = [&](const Bytes& before, const Bytes& next)
  {
    Bytes datagram = before;
    return !Join(datagram, next, 10'000) && datagram == before;
  };
  Bytes of_another = Header(2);
  Add(of_another, kData, 40);
  Add(of_another, kStatistics, 56);
  EXPECT_TRUE(is_refused(first, of_another));
  EXPECT_TRUE(is_refused(first, Message(2, 40, false))) << "statistics at one end alone";
  EXPECT_TRUE(is_refused(first, Bytes{'R', 'T'}));
  // A last submessage that extends to the end states no length, and nothing may follow it.
  Bytes endless = Header();
  Add(endless, kData, 0);
  endless.resize(endless.size() + 40);
  EXPECT_TRUE(is_refused(Message(1, 40, false), endless));
  EXPECT_TRUE(is_refused(endless, Message(1, 40, false)));
  Bytes odd = Header();
  Add(odd, kData, 10);
  EXPECT_TRUE(is_refused(odd, Message(1, 40, false)));
}

}  // namespace
}  // namespace swarmanoid::ros2
