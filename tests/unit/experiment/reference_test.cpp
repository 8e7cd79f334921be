// The committed reference page is that which the table gives; pages and schema name the plug-ins.
#include <gtest/gtest.h>

#include "common/configuration/xml_reader.h"
#include "common/configuration/xml_writer.h"
#include "common/experiment/reference.h"
#include "test_folders.h"
#include "tests/unit/experiment/fake_plugins.h"

namespace swarmanoid::test
{
namespace
{

const std::string kDocs = SWARMANOID_SOURCE_FOLDER "/docs/";
constexpr const char* kCure = "run build/bin/write_experiment_reference docs and commit what it writes";

TEST(Reference, PageIsUpToDate)
{
  EXPECT_TRUE(ReadTextFile(kDocs + "experiment_reference.md") == ExperimentReference()) << kCure;
}

TEST(Reference, SchemaIsWellFormed) { EXPECT_EQ(ReadXml(ExperimentXsd(), "experiment.xsd")->name, "xs:schema"); }

TEST(Reference, SchemaNamesPluginsAndTheParametersOfControllers)
{
  RegisterFakePlugins();
  static const bool added = PluginCatalogue::Instance().Add(
      PluginKind::kController,
      {.label = "schema_walker",
       .brief = "walks",
       .parameters = {
           {.name = "velocity", .unit = "m/s", .default_value = "0.1", .description = "Forward.", .maximum = 0.3}}});
  ASSERT_TRUE(added);
  const auto schema = ReadXml(ExperimentXsd(), "experiment.xsd");
  const auto element = [&](const std::string& name) -> std::string
  {
    for (const auto& child : schema->children)
      if (TConfigurationTree(child).Attribute("name") == name) return WriteXml(*child);
    return {};
  };
  const std::string walker = element("schema_walker");
  EXPECT_NE(walker.find("<xs:element name=\"velocity\">"), std::string::npos) << walker;
  EXPECT_NE(walker.find("Forward. In m/s. Default: 0.1."), std::string::npos) << walker;
  EXPECT_NE(walker.find("<xs:maxInclusive value=\"0.3\"/>"), std::string::npos) << walker;
  // One that declares nothing may hold anything.
  EXPECT_NE(element("footbot_sample_controller").find("name=\"parameters\" type=\"xs:anyType\""), std::string::npos);
  EXPECT_NE(element("footbot_wheels").find("<xs:enumeration value=\"dummy_footbot_wheels\"/>"), std::string::npos);
}

TEST(Reference, CellsOfTablesAreShort)
{
  const auto split = [](const std::string& description)
  {
    TableNotes notes;
    const std::string cell = notes.Cell({.name = "size", .description = description});
    return std::pair(cell, notes.List());
  };
  const std::string nine = "one two three four five six seven eight nine";
  EXPECT_EQ(split(nine + ", " + nine), std::pair(nine + ", " + nine, std::string()));
  EXPECT_EQ(split(nine + ". A | b. " + nine + " " + nine),
            std::pair(nine + ". A \\| b.", "\n* `size`: " + nine + " " + nine + "\n"));
  EXPECT_EQ(split(nine + "; " + nine + " " + nine), std::pair(nine, "\n* `size`: " + nine + " " + nine + "\n"));
  // The end of a list of characters is no end of a sentence.
  EXPECT_EQ(split(nine + ". Letters and _ . : - " + nine + " " + nine),
            std::pair(nine + ".", "\n* `size`: Letters and _ . : - " + nine + " " + nine + "\n"));
  const std::string long_one = nine + " " + nine + " " + nine;
  EXPECT_EQ(split(long_one), std::pair(std::string("see below"), "\n* `size`: " + long_one + "\n"));
}

TEST(Reference, PluginPageNamesWhatIsRegistered)
{
  RegisterFakePlugins();
  const std::string page = PluginReference();
  EXPECT_NE(page.find("### `<footbot_wheels>`, implementation `dummy_footbot_wheels`"), std::string::npos);
  EXPECT_NE(page.find("| `perpendicular_axis` | x, y, z |"), std::string::npos);
}

}  // namespace
}  // namespace swarmanoid::test
