// docs/plugin_reference.md is generated from the tables of all plug-ins, those of the shipped controllers, kinds of
// entities and experiment functions too; no engine, device or renderer is needed. After a change of one, write it
// again:
//   SWARMANOID_WRITE_REFERENCE=1 build/bin/tests/unit_launcher --gtest_filter='PluginReference.*'
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "common/experiment/reference.h"
#include "common/plugin_descriptions/describe_builtins.h"
#include "common/plugins/plugin_library.h"
#include "test_folders.h"

namespace swarmanoid
{
namespace
{

void LoadAllPlugins()
{
  DescribeBuiltins();
  namespace fs = std::filesystem;
  const std::vector<std::string> folders = {SWARMANOID_BUILD_FOLDER "/lib/swarmanoid"};
  EXPECT_EQ(LoadPluginLibrary("ros2_controller", folders).error, "");
  for (const char* folder : {"controllers", "entities", "functions"})
    for (const auto& entry : fs::directory_iterator(fs::path(SWARMANOID_SOURCE_FOLDER) / "user" / folder))
    {
      const PluginLibrary& library = LoadPluginLibrary(entry.path().filename().string(), folders);
      EXPECT_EQ(library.error, "");
    }
}

TEST(PluginReference, TheCommittedPageIsThatOfTheTables)
{
  LoadAllPlugins();
  const std::string generated = PluginReference();
  const std::string path = SWARMANOID_SOURCE_FOLDER "/docs/plugin_reference.md";
  if (std::getenv("SWARMANOID_WRITE_REFERENCE") != nullptr) std::ofstream(path) << generated;
  std::ifstream file(path);
  const std::string committed{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  EXPECT_TRUE(committed == generated) << path << " is not up to date";
}

}  // namespace
}  // namespace swarmanoid
