// Typed values of the configuration tree and of parameter tables.
#include "common/configuration/configuration_tree.h"

#include <gtest/gtest.h>

#include "common/configuration/parameter.h"
#include "common/configuration/wording.h"
#include "common/configuration/xml_reader.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

TConfigurationTree TreeOf(const std::string& text) { return TConfigurationTree(ReadXml(text, "f.xml")); }

template <class Call>
std::string ErrorThrownBy(Call call)
{
  return test::MessageOf<ConfigurationError>(call);
}

TEST(ConfigurationTree, ValuesAreAttributesOrElements)
{
  const auto tree = TreeOf("<a speed=' 3 '><turn> 4.5 </turn><on>yes</on><where>1 2,3</where></a>");
  EXPECT_EQ(tree.GetNumber("speed"), 3);
  EXPECT_EQ(tree.GetInteger("speed"), 3);
  EXPECT_EQ(tree.GetNumber("turn"), 4.5);
  EXPECT_TRUE(tree.GetBoolean("on", false));
  EXPECT_EQ(tree.GetVector3("where"), Vector3(1, 2, 3));
  EXPECT_EQ(tree.GetNumber("absent", 7), 7);
  EXPECT_EQ(tree.Child("absent").Child("deeper").GetText("x", "none"), "none");
}

TEST(ConfigurationTree, ErrorsHavePlaceAndCure)
{
  const auto tree = TreeOf("<a>\n <n>x</n></a>");
  EXPECT_EQ(ErrorThrownBy([&] { tree.GetNumber("n"); }), "f.xml:2:2: 'n' is 'x'; it must be a number");
  EXPECT_EQ(ErrorThrownBy([&] { tree.GetNumber("m"); }), "f.xml:1:1: <a> lacks the parameter 'm'");
  EXPECT_EQ(ErrorThrownBy([&] { tree.GetVector3("n", Vector3::Zero()); }),
            "f.xml:2:2: 'n' is 'x'; it must be three numbers \"x, y, z\"");
}

TEST(ConfigurationTree, ParsersTakeWholeTextsOnly)
{
  EXPECT_EQ(ParseNumber(" +1.5e3 "), 1500);
  EXPECT_EQ(ParseNumber(".25"), 0.25);
  for (const char* text : {"", "nan", "inf", "1e999", "1 2", "0x10", "1.5m", "+-1", "--1"})
    EXPECT_FALSE(ParseNumber(text)) << text;
  EXPECT_EQ(ParseInteger("-12"), -12);
  for (const char* text : {"", "1.0", "99999999999999999999"}) EXPECT_FALSE(ParseInteger(text)) << text;
  EXPECT_EQ(ParseNumbers("1, 2,3  4")->size(), 4U);
  for (const char* text : {"", "1,,2", "1,", ",1"}) EXPECT_FALSE(ParseNumbers(text)) << text;
  EXPECT_EQ(ParseColour("red"), 0xff0000U);
  EXPECT_EQ(ParseColour("#00ff80"), 0x00ff80U);
  EXPECT_EQ(ParseColour("1, 2, 3"), 0x010203U);
  for (const char* text : {"", "rot", "#00ff8", "#00ff8g", "1,2", "1,2,256", "0.5,0,0"})
    EXPECT_FALSE(ParseColour(text)) << text;
}

TEST(Parameters, FollowTheirTable)
{
  ParameterSpec radius;
  radius.name = "radius";
  radius.unit = "m";
  radius.minimum = 0;
  ParameterSpec view;
  view.name = "view_n";
  view.type = ParameterType::kVector3;
  ParameterSpec colour;
  colour.name = "colour";
  colour.type = ParameterType::kColour;
  colour.default_value = "blue";
  const std::vector<ParameterSpec> specs{radius, view, colour};
  const Parameters parameters(TreeOf("<a radius='-1' view_12='1,2,3'/>"), specs);
  EXPECT_EQ(ErrorThrownBy([&] { parameters.Number("radius"); }),
            "f.xml:1:4: 'radius' is -1 m; it must be at least 0 m");
  EXPECT_EQ(parameters.Vector3Of("view_12"), Vector3(1, 2, 3));
  EXPECT_FALSE(parameters.IsGiven("view_0"));
  EXPECT_EQ(parameters.Colour("colour"), 0x0000ffU);
  EXPECT_THROW(parameters.Number("other"), std::logic_error);
}

TEST(Wording, WordsStandBetweenSeparatorsWithoutBlanks)
{
  using Words = std::vector<std::string>;
  EXPECT_EQ(SplitWords(" a\tbc  d\r\n"), (Words{"a", "bc", "d"}));
  EXPECT_EQ(SplitWords("a b; c ;; d", ";"), (Words{"a b", "c", "d"}));
  EXPECT_EQ(SplitWords("a,b , c", ", "), (Words{"a", "b", "c"}));
  EXPECT_EQ(SplitWords(" \t"), Words());
  EXPECT_EQ(SplitWords(""), Words());
}

TEST(Wording, FindsNearNames)
{
  const std::vector<std::string> names{"position", "orientation", "controller"};
  EXPECT_EQ(NearestName("positon", names), "position");
  EXPECT_EQ(NearestName("Orientation", names), "orientation");
  EXPECT_EQ(NearestName("pos", names), "");
  EXPECT_EQ(NearestName("controllers", names), "controller");
  EXPECT_EQ(NearestName("wheels", names), "");
  EXPECT_EQ(Quoted(std::string(200, 'x')).size(), 65U);
}

}  // namespace
}  // namespace swarmanoid
