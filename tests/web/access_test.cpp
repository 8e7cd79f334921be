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
  EXPECT_TRUE(IsOwnOrigin("https://localhost:8080", "localhost:8080", true));
  EXPECT_FALSE(IsOwnOrigin("http://localhost:8080", "localhost:8080", true));
  EXPECT_FALSE(IsOwnOrigin("null", "localhost:8080"));
}

// It is test case 2 of RFC 4231.
TEST(WebAccess, AProofIsTheHmacOfTheChallengeUnderTheToken)
{
  EXPECT_EQ(ProofOf("Jefe", "what do ya want for nothing?"),
            "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843");
}

TEST(WebAccess, OnlyWhoHasTheWholeTokenProvesIt)
{
  Visitors visitors({true, "0123456789abcdef"});
  const std::string challenge = visitors.Join(1);
  EXPECT_FALSE(visitors.MayControl(1));
  for (const char* token : {"0123456789abcdee", "0123456789abcde", ""})
    EXPECT_EQ(visitors.Prove(1, ProofOf(token, challenge)), Authority::kWrongToken) << token;
  // The token itself proves nothing, nor does the beginning of a proof.
  const std::string proof = ProofOf("0123456789abcdef", challenge);
  for (const std::string& wrong : {std::string("0123456789abcdef"), std::string(), proof.substr(0, 63)})
    EXPECT_EQ(visitors.Prove(1, wrong), Authority::kWrongToken) << wrong;
  EXPECT_FALSE(visitors.MayControl(1));
  EXPECT_EQ(visitors.Prove(1, proof), Authority::kControl);
  EXPECT_TRUE(visitors.MayControl(1));

  // The answer of one client is no answer for another one, nor for the same client when it comes again.
  EXPECT_NE(visitors.Join(2), challenge);
  EXPECT_EQ(visitors.Prove(2, proof), Authority::kWrongToken);
  EXPECT_FALSE(visitors.MayControl(2));
  visitors.Leave(1);
  EXPECT_FALSE(visitors.MayControl(1));
  visitors.Join(1);
  EXPECT_EQ(visitors.Prove(1, proof), Authority::kWrongToken);
}

TEST(WebAccess, NoProofHelpsIfNobodyMayControl)
{
  Visitors watched({false, "0123456789abcdef"}), without({true, ""});
  EXPECT_EQ(watched.Prove(1, ProofOf("0123456789abcdef", watched.Join(1))), Authority::kReadOnly);
  EXPECT_EQ(without.Prove(1, ProofOf("", without.Join(1))), Authority::kReadOnly);
  EXPECT_FALSE(watched.MayControl(1));
  EXPECT_FALSE(without.MayControl(1));
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
