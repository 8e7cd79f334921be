// A table of parameters finds what is wrong in a file, and fills in what the file leaves out.
#include "common/configuration/parameter_table.h"

#include <gtest/gtest.h>

#include "common/configuration/xml_reader.h"

namespace swarmanoid
{
namespace
{

const std::vector<ParameterSpec> kTable = {
    {.name = "velocity", .unit = "m/s", .default_value = "0.1", .minimum = 0, .maximum = 0.3},
    {.name = "steps", .type = ParameterType::kInteger},
    {.name = "mode", .type = ParameterType::kChoice, .default_value = "calm", .choices = {"calm", "wild"}},
    {.name = "weights", .type = ParameterType::kPath, .default_value = ""},
    {.name = "limit", .default_value = ""},
    {.name = "path", .type = ParameterType::kTree, .default_value = ""},
    {.name = "view_n", .type = ParameterType::kVector3, .default_value = "0, 0, 1"}};

TConfigurationTree Tree(const std::string& text) { return TConfigurationTree(ReadXml(text, "f.xml")); }

std::string Mistakes(const std::string& content)
{
  std::string text;
  for (const ConfigurationError& mistake :
       MistakesIn(Tree("<parameters " + content + "</parameters>"), kTable, "controller <walker>"))
    text += std::string(mistake.what()) + "\n";
  return text;
}

TEST(ParameterTable, WhatIsRightIsNoMistake)
{
  EXPECT_EQ(Mistakes("steps='3'><velocity>0.3</velocity><path><a b='c'/></path><view_12>1, 2, 3</view_12>"), "");
}

TEST(ParameterTable, AMisspeltNameIsFoundWithTheNearest)
{
  EXPECT_EQ(Mistakes("steps='3'><velocty>0.3</velocty>"),
            "f.xml:1:23: the controller <walker> has no parameter 'velocty'; it has: velocity, steps, mode, weights, "
            "limit, path, view_n; did you mean 'velocity'?\n");
}

TEST(ParameterTable, WrongValuesAreFoundWithWhatIsAllowed)
{
  EXPECT_EQ(Mistakes("steps='3.5'>"),
            "f.xml:1:13: 'steps' of the controller <walker> is '3.5'; it must be a whole number\n");
  EXPECT_EQ(Mistakes("steps='3'><velocity>fast</velocity>"),
            "f.xml:1:23: 'velocity' of the controller <walker> is 'fast'; it must be a number in m/s, from 0 to 0.3 "
            "m/s\n");
  EXPECT_EQ(Mistakes("steps='3'><velocity>20 cm/s</velocity>"),
            "f.xml:1:23: 'velocity' of the controller <walker> is '20 cm/s'; it must be a number in m/s, from 0 to 0.3 "
            "m/s\n");
  EXPECT_EQ(Mistakes("steps='3'><velocity>0.5</velocity>"),
            "f.xml:1:23: 'velocity' of the controller <walker> is 0.5 m/s; it must be from 0 to 0.3 m/s\n");
  EXPECT_EQ(Mistakes("steps='3'><mode>wlid</mode>"),
            "f.xml:1:23: 'mode' of the controller <walker> is 'wlid'; it must be one of calm, wild; did you mean "
            "'wild'?\n");
}

TEST(ParameterTable, TheBordersOfARangeBelongToIt)
{
  for (const char* velocity : {"0", "0.3"})
    EXPECT_EQ(Mistakes(std::string("steps='3'><velocity>") + velocity + "</velocity>"), "") << velocity;
  for (const char* velocity : {"-1e-9", "0.3000001"})
    EXPECT_NE(Mistakes(std::string("steps='3'><velocity>") + velocity + "</velocity>"), "") << velocity;
}

TEST(ParameterTable, WhatIsRequiredMustBeThere)
{
  EXPECT_EQ(Mistakes(">"), "f.xml:1:1: the controller <walker> lacks the parameter 'steps': a whole number\n");
}

TEST(ParameterTable, EachIsGivenOnceAndAsAValue)
{
  EXPECT_EQ(Mistakes("steps='3'><steps>4</steps>"),
            "f.xml:1:23: 'steps' of the controller <walker> is given a second time; the first is f.xml:1:13\n");
  EXPECT_EQ(Mistakes("steps='3'><velocity unit='cm/s'>20</velocity>"),
            "f.xml:1:33: <velocity> holds a value only: a number in m/s, from 0 to 0.3 m/s\n");
  EXPECT_EQ(Mistakes("steps='3' path='a'>"), "f.xml:1:23: 'path' must be written as an element, <path>…</path>\n");
  EXPECT_EQ(Mistakes("steps='3'>fast"),
            "f.xml:1:1: <parameters> holds the text 'fast', where only elements are allowed\n");
}

TEST(ParameterTable, AllMistakesAreFoundAtOnce)
{
  EXPECT_EQ(MistakesIn(Tree("<parameters stps='3'><velocity>x</velocity></parameters>"), kTable, "x").size(), 3U);
}

TEST(ParameterTable, DefaultsAreFilledIn)
{
  const auto tree = WithDefaults(Tree("<parameters mode='wild' steps='3'/>"), kTable, "/experiments");
  EXPECT_EQ(tree.GetNumber("velocity"), 0.1);
  EXPECT_EQ(tree.GetInteger("steps"), 3);
  EXPECT_EQ(tree.GetText("mode"), "wild");
  EXPECT_EQ(tree.GetText("weights"), "");
  // "" is no number, so there is no default.
  EXPECT_FALSE(tree.Value("limit"));
}

TEST(ParameterTable, PathsStartAtTheFolderOfTheExperiment)
{
  EXPECT_EQ(WithDefaults(Tree("<parameters weights='../net.txt'/>"), kTable, "/a/b").GetText("weights"), "/a/net.txt");
  EXPECT_EQ(
      WithDefaults(Tree("<parameters><weights> net.txt </weights></parameters>"), kTable, "/a/b").GetText("weights"),
      "/a/b/net.txt");
  EXPECT_EQ(WithDefaults(Tree("<parameters weights='/net.txt'/>"), kTable, "/a/b").GetText("weights"), "/net.txt");
}

TEST(ParameterTable, ATableThatContradictsItselfIsRefused)
{
  EXPECT_EQ(MistakeInTable(kTable), "");
  EXPECT_EQ(MistakeInTable({{.name = "a", .default_value = "2", .maximum = 1}}),
            "the default of its parameter 'a' is 2; it must be at most 1");
  EXPECT_EQ(MistakeInTable({{.name = "a"}, {.name = "a"}}), "its parameter 'a' is declared twice");
  EXPECT_EQ(MistakeInTable({{.name = "a b"}}), "its parameter 'a b' has a name that cannot stand in a file");
  EXPECT_EQ(MistakeInTable({{.name = "a", .type = ParameterType::kChoice}}), "its parameter 'a' has no choices");
  EXPECT_EQ(MistakeInTable({{.name = "a", .minimum = 2, .maximum = 1}}),
            "its parameter 'a' has the least value 2 and the largest 1");
}

}  // namespace
}  // namespace swarmanoid
