// Mistakes that a worker finds in an experiment have the line of the user's file.
#include "common/experiment/source_places.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/configuration/xml_reader.h"
#include "common/configuration/xml_writer.h"
#include "tests/unit/experiment/fake_plugins.h"

namespace swarmanoid
{
namespace
{

std::string PlacesOf(const ConfigurationNode& node)
{
  std::string text = node.name + " " + node.location.Text() + "\n";
  for (const auto& attribute : node.attributes) text += attribute.name + " " + attribute.location.Text() + "\n";
  for (const auto& child : node.children) text += PlacesOf(*child);
  return text;
}

constexpr const char* kText = R"(<ahss-config><framework
   clocktick='100'><maxclock>5</maxclock></framework>

  <arena size='1,1,1'   optimization='2D'/></ahss-config>)";

TEST(Places, GoWithTheTextThatIsWrittenAnew)
{
  const auto root = ReadXml(kText, "my folder/50%.xml");
  const std::string text = WriteXml(*root) + WritePlaces(*root);
  const auto again = ReadXmlWithPlaces(text, "other.xml");
  EXPECT_EQ(PlacesOf(*again), PlacesOf(*root));
  EXPECT_THAT(PlacesOf(*again), testing::HasSubstr("size my folder/50%.xml:4:10\n"));
  EXPECT_EQ(WriteXml(*again), WriteXml(*root));
}

TEST(Places, ThatDoNotFitAreLeftOut)
{
  const auto root = ReadXml(kText, "test.xml");
  const std::string places = WritePlaces(*root);
  for (std::string wrong : {places.substr(0, places.size() / 2) + "?>", std::string("<?swarmanoid-places | 7,1,1?>"),
                            std::string("<?swarmanoid-places a | 0,1,1?>"), std::string("<?swarmanoid-places ?>")})
  {
    const auto again = ReadXmlWithPlaces(WriteXml(*root) + wrong, "other.xml");
    EXPECT_THAT(again->location.Text(), testing::StartsWith("other.xml:")) << wrong;
  }
  EXPECT_EQ(ReadXmlWithPlaces(kText, "other.xml")->location.Text(), "other.xml:1:1");
}

TEST(Places, OfAWorkerAreThoseOfTheUserAndOfOptions)
{
  LoadOptions options;
  options.settings = {{"framework.seed", "3"}};
  const std::string text =
      "<ahss-config>\n\n<arena size='1,1,1' optimization='2D'><footbot id='fb'\n><position>0,0,0</position>"
      "<orientation>0,0,0</orientation></footbot></arena>\n</ahss-config>";
  const LoadedExperiment loaded = test::LoadText(text, options);
  ASSERT_TRUE(loaded.experiment) << test::ErrorsOf(text, options);
  const LoadedExperiment worker =
      LoadExperimentText(loaded.experiment->effective_xml + loaded.places, "copy.xml", "/", {});
  ASSERT_TRUE(worker.experiment);
  EXPECT_EQ(worker.experiment->entities[0].location.Text(), "test.xml:3:39");
  EXPECT_EQ(worker.experiment->effective_xml, loaded.experiment->effective_xml);
  const auto root = ReadXmlWithPlaces(loaded.experiment->effective_xml + loaded.places, "copy.xml");
  EXPECT_THAT(PlacesOf(*root), testing::HasSubstr("seed --set framework.seed\n"));
}

}  // namespace
}  // namespace swarmanoid
