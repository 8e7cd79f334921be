// The committed reference page and XML schema are those that the table gives.
#include <gtest/gtest.h>

#include "common/configuration/xml_reader.h"
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

TEST(Reference, SchemaIsUpToDate) { EXPECT_TRUE(ReadTextFile(kDocs + "experiment.xsd") == ExperimentXsd()) << kCure; }

TEST(Reference, SchemaIsWellFormed) { EXPECT_EQ(ReadXml(ExperimentXsd(), "experiment.xsd")->name, "xs:schema"); }

TEST(Reference, PluginPageNamesWhatIsRegistered)
{
  RegisterFakePlugins();
  const std::string page = PluginReference();
  EXPECT_NE(page.find("### `<footbot_wheels>`, implementation `dummy_footbot_wheels`"), std::string::npos);
  EXPECT_NE(page.find("| `perpendicular_axis` | x, y, z |"), std::string::npos);
}

}  // namespace
}  // namespace swarmanoid::test
