#include "visualiser/web/access.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace swarmanoid
{
namespace
{

TEST(WebAccess, HostsThatSomebodysNamesCouldPointHereAreUnknown)
{
  for (const char* host : {"localhost", "LocalHost:8080", "127.0.0.1", "127.0.0.1:80", "192.168.1.7:8080", "[::1]:80"})
    EXPECT_TRUE(IsKnownHost(host)) << host;
  for (const char* host :
       {"", ":80", "evil.example", "evil.example:8080", "localhost.evil.example", "127.0.0.1.evil.example",
        "localhost:", "localhost:80x", "[::1", "[evil]:80", "127.0.0.1:80:80", "user@127.0.0.1"})
    EXPECT_FALSE(IsKnownHost(host)) << host;
}

TEST(WebAccess, OnlyPagesOfTheServerItselfHaveItsOrigin)
{
  EXPECT_TRUE(IsOwnOrigin("", "localhost:80"));
  EXPECT_TRUE(IsOwnOrigin("http://localhost:8080", "localhost:8080"));
  EXPECT_TRUE(IsOwnOrigin("http://LOCALHOST:8080", "localhost:8080"));
  EXPECT_FALSE(IsOwnOrigin("http://localhost:8081", "localhost:8080"));
  EXPECT_FALSE(IsOwnOrigin("http://evil.example", "localhost:8080"));
  EXPECT_FALSE(IsOwnOrigin("https://localhost:8080", "localhost:8080"));
  EXPECT_FALSE(IsOwnOrigin("null", "localhost:8080"));
}

TEST(WebAccess, ValuesOfAQueryAreFoundByTheirWholeName)
{
  EXPECT_EQ(PathOf("/stream?token=abc"), "/stream");
  EXPECT_EQ(QueryValue("/stream?a=1&token=abc&b=2", "token"), "abc");
  EXPECT_EQ(QueryValue("/stream?mytoken=abc", "token"), "");
  EXPECT_EQ(QueryValue("/stream?token", "token"), "");
  EXPECT_EQ(QueryValue("/stream", "token"), "");
}

TEST(WebAccess, OnlyTheWholeTokenGivesControl)
{
  const AccessRules rules{true, "0123456789abcdef"};
  EXPECT_EQ(AuthorityOf(rules, "0123456789abcdef"), Authority::kControl);
  EXPECT_EQ(AuthorityOf(rules, "0123456789abcdee"), Authority::kWrongToken);
  EXPECT_EQ(AuthorityOf(rules, "0123456789abcde"), Authority::kWrongToken);
  EXPECT_EQ(AuthorityOf(rules, ""), Authority::kReadOnly);
  EXPECT_EQ(AuthorityOf({true, ""}, ""), Authority::kReadOnly);
  EXPECT_EQ(AuthorityOf({false, "0123456789abcdef"}, "0123456789abcdef"), Authority::kReadOnly);
}

TEST(WebAccess, TokensAreLongAndNeverTheSame)
{
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) tokens.insert(MakeToken());
  EXPECT_EQ(tokens.size(), 100u);
  for (const std::string& token : tokens) EXPECT_THAT(token, testing::MatchesRegex("[0-9a-f]{32}"));
}

}  // namespace
}  // namespace swarmanoid
