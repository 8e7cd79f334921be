// Values of a configuration tree that were never read are found, at any place.
#include "common/configuration/configuration_reads.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "common/configuration/xml_reader.h"

namespace swarmanoid
{
namespace
{

// Returns "line:column name" of each.
std::vector<std::string> Unread(const std::string& text, const std::function<void(const TConfigurationTree&)>& read)
{
  const TConfigurationTree tree(ReadXml(text, "f.xml"));
  const auto reads = std::make_shared<ConfigurationReads>();
  read(tree.RecordedIn(reads));
  std::vector<std::string> found;
  for (const auto& one : reads->UnreadIn(*tree.Node()))
    found.push_back(std::to_string(one.location.line) + ":" + std::to_string(one.location.column) + " " + one.name);
  return found;
}

using Names = std::vector<std::string>;

TEST(ConfigurationReads, ElementsAndAttributesThatNobodyAskedForAreFound)
{
  EXPECT_EQ(Unread("<p a='1' b='2'>\n <c>3</c>\n <d>4</d></p>",
                   [](const TConfigurationTree& tree)
                   {
                     tree.GetNumber("a");
                     tree.GetNumber("c");
                     tree.GetNumber("absent", 1);
                   }),
            (Names{"1:10 b", "3:2 d"}));
}

TEST(ConfigurationReads, AllIsReadWhereAllWasAskedFor)
{
  EXPECT_EQ(Unread("<p a='1'><b>2</b><c d='3'><e>4</e></c></p>",
                   [](const TConfigurationTree& tree)
                   {
                     tree.HasAttribute("a");
                     tree.Value("b");
                     tree.Child("c").GetNumber("d");
                     tree.Child("c").Child("e").Text();
                   }),
            Names());
}

TEST(ConfigurationReads, WithinAnElementWhatWasNotAskedForIsFound)
{
  EXPECT_EQ(Unread("<p><gains kp='1' kj='2'><limit unit='m'>3</limit></gains></p>",
                   [](const TConfigurationTree& tree)
                   {
                     const TConfigurationTree gains = tree.Child("gains");
                     gains.GetNumber("kp");
                     gains.GetNumber("ki", 0);
                     gains.GetNumber("limit");
                   }),
            (Names{"1:18 kj", "1:32 unit"}));
}

TEST(ConfigurationReads, OfTwoElementsOfOneNameTheSecondIsNotReadByName)
{
  EXPECT_EQ(Unread("<p><a>1</a><a>2</a></p>", [](const TConfigurationTree& tree) { tree.GetNumber("a"); }),
            Names{"1:12 a"});
}

TEST(ConfigurationReads, AListIsReadByReadingItsElements)
{
  const auto read = [](const TConfigurationTree& tree)
  {
    for (const TConfigurationTree& child : tree.Children())
      if (child.Name() == "point") child.Text();
  };
  EXPECT_EQ(Unread("<p><point>1</point><point>2</point><pont>3</pont></p>", read), Names{"1:36 pont"});
  // The name of an empty element is its whole content.
  EXPECT_EQ(Unread("<p><loop/><point>2</point></p>", read), Names());
}

TEST(ConfigurationReads, ATextThatNobodyReadsIsFound)
{
  EXPECT_EQ(Unread("<p>fast<a>1</a></p>", [](const TConfigurationTree& tree) { tree.GetNumber("a"); }), Names{"1:1 "});
  EXPECT_EQ(Unread("<p>fast</p>", [](const TConfigurationTree& tree) { tree.Text(); }), Names());
}

TEST(ConfigurationReads, WhoeverTakesTheNodeReadsAllOfIt)
{
  EXPECT_EQ(Unread("<p a='1'>x<b><c/></b></p>", [](const TConfigurationTree& tree) { tree.Node(); }), Names());
}

TEST(ConfigurationReads, NamesWhatWasAskedForInstead)
{
  const TConfigurationTree tree(ReadXml("<p><velocty>1</velocty></p>", "f.xml"));
  const auto reads = std::make_shared<ConfigurationReads>();
  tree.RecordedIn(reads).GetNumber("velocity", 1);
  tree.RecordedIn(reads).GetNumber("alpha", 1);
  const auto unread = reads->UnreadIn(*tree.Node());
  ASSERT_EQ(unread.size(), 1U);
  EXPECT_EQ(unread[0].asked, (Names{"alpha", "velocity"}));
  EXPECT_EQ(unread[0].location.Text(), "f.xml:1:4");
}

TEST(ConfigurationReads, SeveralThreadsMayRead)
{
  std::string text = "<p>";
  for (int i = 0; i < 100; ++i) text += "<a" + std::to_string(i) + ">1</a" + std::to_string(i) + ">";
  EXPECT_EQ(Unread(text + "<b/></p>",
                   [](const TConfigurationTree& tree)
                   {
                     std::vector<std::thread> threads;
                     for (int t = 0; t < 4; ++t)
                       threads.emplace_back(
                           [&tree, t]
                           {
                             for (int i = t; i < 100; i += 4) tree.GetNumber("a" + std::to_string(i));
                           });
                     for (std::thread& thread : threads) thread.join();
                   }),
            Names{"1:1184 b"});
}

}  // namespace
}  // namespace swarmanoid
