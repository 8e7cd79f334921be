// Access grants: what their keys depend on, when they end, and the text of their tokens.
#include "common/run/access/access_grant.h"
#include "common/bus/security/derived_key.h"

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

AccessGrant GrantUntil(std::int64_t ends) { return {"1a2b3c4d", GrantRole::kWatcher, ends}; }

AccessToken TokenOf(const AccessGrant& grant)
{
  return {grant, 77, "127.0.0.1", "", KeyOfByte(7), "two, with a comma"};
}

TEST(AccessGrants, TheKeyDependsOnTheRunAndOnEachPartOfTheShare)
{
  const AccessGrant grant = GrantUntil(kFarFuture);
  const auto key = [](const RunKey& run, const AccessGrant& of) { return ChannelOf(run, of).key.value(); };
  const RunKey reference = key(KeyOfByte(1), grant);
  EXPECT_EQ(key(KeyOfByte(1), grant), reference);
  EXPECT_NE(reference, KeyOfByte(1));
  EXPECT_NE(key(KeyOfByte(2), grant), reference);
  EXPECT_NE(key(KeyOfByte(1), {"1a2b3c4e", grant.role, grant.ends}), reference);
  EXPECT_NE(key(KeyOfByte(1), {grant.id, GrantRole::kOperator, grant.ends}), reference);
  // A holder who writes a later end into the token has the key of another grant.
  EXPECT_NE(key(KeyOfByte(1), GrantUntil(kFarFuture + 1)), reference);
  EXPECT_NE(key(KeyOfByte(1), GrantUntil(0)), reference);
}

TEST(AccessGrants, AnOpenViewHasNoKey)
{
  const GrantChannel channel = ChannelOf(KeyOfByte(1), {"1a2b3c4d", GrantRole::kOpenView, kFarFuture});
  EXPECT_FALSE(channel.key.has_value());
  EXPECT_EQ(channel.id, kOpenChannel);
}

TEST(AccessGrants, EndAtTheirSecondAndWithoutOneNever)
{
  EXPECT_FALSE(GrantUntil(0).HasEnded());
  EXPECT_FALSE(GrantUntil(kFarFuture).HasEnded());
  EXPECT_TRUE(GrantUntil(1).HasEnded());
  EXPECT_TRUE(GrantUntil(std::time(nullptr)).HasEnded()) << "the second of the end is over";
}

TEST(AccessGrants, TicketsComeBackFromTheirText)
{
  for (const GrantRole role : {GrantRole::kWatcher, GrantRole::kOperator})
  {
    AccessToken token = TokenOf({"1a2b3c4d", role, kFarFuture});
    const auto read = TokenOfText(TextOf(token));
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(read->grant.id, "1a2b3c4d");
    EXPECT_EQ(read->grant.role, role);
    EXPECT_EQ(read->grant.ends, kFarFuture);
    EXPECT_EQ(read->domain, 77);
    EXPECT_EQ(read->address, "127.0.0.1");
    EXPECT_EQ(read->key, KeyOfByte(7));
    EXPECT_EQ(read->experiment, "two, with a comma");
    EXPECT_EQ(read->discovery_server, "");
    token.discovery_server = "10.77.0.1:21900";
    const auto by_server = TokenOfText(TextOf(token));
    ASSERT_TRUE(by_server.has_value());
    EXPECT_EQ(by_server->discovery_server, "10.77.0.1:21900");
    EXPECT_EQ(by_server->address, "10.77.0.1");
  }
}

TEST(AccessGrants, ATicketThatHasEndedIsRefusedWithItsEnd)
{
  const auto complaint = [](std::int64_t ends) -> std::string
  {
    setenv(kTokenVariable, TextOf(TokenOf(GrantUntil(ends))).c_str(), 1);
    try
    {
      return TokenOfEnvironment().has_value() ? "" : "no ticket";
    }
    catch (const BusError& error)
    {
      return error.what();
    }
  };
  EXPECT_EQ(complaint(0), "");
  EXPECT_EQ(complaint(kFarFuture), "");
  EXPECT_THAT(complaint(1), HasSubstr("watcher grant 1a2b3c4d ended at 1970-01-01T00:00:01Z"));
  unsetenv(kTokenVariable);
}

}  // namespace
}  // namespace swarmanoid
