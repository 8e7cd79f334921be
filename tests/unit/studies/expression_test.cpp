// Conditions over the factors of a study.
#include "studies/design/expression.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tuple>

#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

const std::vector<std::string> kNames{"robots", "speed", "rule"};

bool Holds(const std::string& text)
{
  return Expression(text, kNames)
      .Holds(
          [](std::size_t name) -> ExpressionValue
          {
            if (name == 2) return std::string("still");
            return name == 0 ? 10.0 : 0.5;
          });
}

std::string ComplaintAbout(const std::string& text)
{
  return test::MessageOf<ExpressionError>([&] { Holds(text); });
}

TEST(StudyExpression, BindsAsInArithmetic)
{
  EXPECT_TRUE(Holds("robots * speed + 1 == 6"));
  EXPECT_TRUE(Holds("robots - 2 - 3 == 5")) << "from the left";
  EXPECT_TRUE(Holds("2 + 3 * 4 == 14"));
  EXPECT_TRUE(Holds("(2 + 3) * 4 == 20"));
  EXPECT_TRUE(Holds("-robots < -9.5 and 7 % 4 == 3 and -7 % 4 == -3"));
  EXPECT_TRUE(Holds("1e-3 * 1000 == 1 and robots/4 == 2.5"));
}

TEST(StudyExpression, CombinesConditions)
{
  EXPECT_TRUE(Holds("robots > 50 or speed == 0.5"));
  EXPECT_FALSE(Holds("robots > 50 and speed == 0.5"));
  EXPECT_TRUE(Holds("robots > 50 and speed == 0 or robots == 10")) << "and binds tighter than or";
  EXPECT_TRUE(Holds("not robots == 11")) << "not binds weaker than a comparison";
  EXPECT_TRUE(Holds("not robots % 5 and robots % 3")) << "0 is false, other numbers are true";
  EXPECT_FALSE(Holds("not (robots == 10 and rule == 'still')"));
  EXPECT_TRUE(Holds("rule != 'moving'"));
}

// `robots` is 10. Each comparison is evaluated with 10 below, equal to and above the other side.
TEST(StudyExpression, ComparisonsAtEqualityAndBesideIt)
{
  for (const auto& [comparison, below, equal, above] :
       {std::tuple("<", true, false, false), std::tuple("<=", true, true, false), std::tuple(">", false, false, true),
        std::tuple(">=", false, true, true), std::tuple("==", false, true, false), std::tuple("!=", true, false, true)})
  {
    EXPECT_EQ(Holds(fmt::format("robots {} 11", comparison)), below) << "10 " << comparison << " 11";
    EXPECT_EQ(Holds(fmt::format("robots {} 10", comparison)), equal) << "10 " << comparison << " 10";
    EXPECT_EQ(Holds(fmt::format("robots {} 9", comparison)), above) << "10 " << comparison << " 9";
  }
}

TEST(StudyExpression, SaysWhatIsWrong)
{
  EXPECT_THAT(ComplaintAbout("robot > 1"), testing::HasSubstr("there is no 'robot'"));
  EXPECT_THAT(ComplaintAbout("robot > 1"), testing::HasSubstr("did you mean 'robots'?"));
  EXPECT_THAT(ComplaintAbout("robots >"), testing::HasSubstr("is missing, at character 9"));
  EXPECT_THAT(ComplaintAbout("(robots > 1"), testing::HasSubstr("a ( has no )"));
  EXPECT_THAT(ComplaintAbout("robots 5"), testing::HasSubstr("'5' is not expected here"));
  EXPECT_THAT(ComplaintAbout("rule > 5"), testing::HasSubstr("'still' is a text; '>' takes numbers"));
  EXPECT_THAT(ComplaintAbout("rule == 'still"), testing::HasSubstr("no second '"));
  EXPECT_THAT(ComplaintAbout(""), testing::HasSubstr("is missing"));
  EXPECT_THAT(ComplaintAbout(std::string(5000, '(')), testing::HasSubstr("too many parentheses"));
}

}  // namespace
}  // namespace swarmanoid
