// Shares: what their keys depend on, when they end, and the text of their tickets.
#include "common/bus/security/share.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <ctime>

#include "tests/unit/bus/key_of_byte.h"

namespace swarmanoid
{
namespace
{

using test::KeyOfByte;
using testing::HasSubstr;

constexpr std::int64_t kFarFuture = 4'000'000'000;  // the year 2096

Share ShareUntil(std::int64_t ends) { return {"1a2b3c4d", ShareRole::kWatcher, ends}; }

ShareTicket TicketOf(const Share& share) { return {share, 77, "127.0.0.1", "", KeyOfByte(7), "two, with a comma"}; }

TEST(Shares, TheKeyDependsOnTheRunAndOnEachPartOfTheShare)
{
  const Share share = ShareUntil(kFarFuture);
  const auto key = [](const RunKey& run, const Share& of) { return ChannelOf(run, of).key.value(); };
  const RunKey reference = key(KeyOfByte(1), share);
  EXPECT_EQ(key(KeyOfByte(1), share), reference);
  EXPECT_NE(reference, KeyOfByte(1));
  EXPECT_NE(key(KeyOfByte(2), share), reference);
  EXPECT_NE(key(KeyOfByte(1), {"1a2b3c4e", share.role, share.ends}), reference);
  EXPECT_NE(key(KeyOfByte(1), {share.id, ShareRole::kOperator, share.ends}), reference);
  // A holder who writes a later end into the ticket has the key of another share.
  EXPECT_NE(key(KeyOfByte(1), ShareUntil(kFarFuture + 1)), reference);
  EXPECT_NE(key(KeyOfByte(1), ShareUntil(0)), reference);
}

TEST(Shares, AnOpenViewHasNoKey)
{
  const ShareChannel channel = ChannelOf(KeyOfByte(1), {"1a2b3c4d", ShareRole::kOpenView, kFarFuture});
  EXPECT_FALSE(channel.key.has_value());
  EXPECT_EQ(channel.id, kOpenChannel);
}

TEST(Shares, EndAtTheirSecondAndWithoutOneNever)
{
  EXPECT_FALSE(ShareUntil(0).HasEnded());
  EXPECT_FALSE(ShareUntil(kFarFuture).HasEnded());
  EXPECT_TRUE(ShareUntil(1).HasEnded());
  EXPECT_TRUE(ShareUntil(std::time(nullptr)).HasEnded()) << "the second of the end is over";
}

TEST(Shares, TicketsComeBackFromTheirText)
{
  for (const ShareRole role : {ShareRole::kWatcher, ShareRole::kOperator})
  {
    ShareTicket ticket = TicketOf({"1a2b3c4d", role, kFarFuture});
    const auto read = TicketOfText(TextOf(ticket));
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(read->share.id, "1a2b3c4d");
    EXPECT_EQ(read->share.role, role);
    EXPECT_EQ(read->share.ends, kFarFuture);
    EXPECT_EQ(read->domain, 77);
    EXPECT_EQ(read->address, "127.0.0.1");
    EXPECT_EQ(read->key, KeyOfByte(7));
    EXPECT_EQ(read->experiment, "two, with a comma");
  }
}

TEST(Shares, ATicketThatHasEndedIsRefusedWithItsEnd)
{
  const auto complaint = [](std::int64_t ends) -> std::string
  {
    setenv(kShareVariable, TextOf(TicketOf(ShareUntil(ends))).c_str(), 1);
    try
    {
      return TicketOfEnvironment().has_value() ? "" : "no ticket";
    }
    catch (const BusError& error)
    {
      return error.what();
    }
  };
  EXPECT_EQ(complaint(0), "");
  EXPECT_EQ(complaint(kFarFuture), "");
  EXPECT_THAT(complaint(1), HasSubstr("watcher share 1a2b3c4d ended at 1970-01-01T00:00:01Z"));
  unsetenv(kShareVariable);
}

}  // namespace
}  // namespace swarmanoid
