// docs/plugin_reference.md is generated from the tables of all plug-ins. After a change of one, write it anew:
//   SWARMANOID_WRITE_REFERENCE=1 build/bin/tests/unit_launcher --gtest_filter='PluginReference.*'
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "common/experiment/reference.h"
#include "controller_host/device.h"
#include "engine_worker/engine_worker.h"
#include "test_folders.h"
#include "visualiser/render.h"

namespace swarmanoid
{
namespace
{

TEST(PluginReference, TheCommittedPageIsThatOfTheTables)
{
  RegisterBuiltinEngines();
  RegisterBuiltinDevices();
  RegisterBuiltinRenderers();
  const std::string path = std::string(SWARMANOID_SOURCE_FOLDER) + "/docs/plugin_reference.md";
  if (std::getenv("SWARMANOID_WRITE_REFERENCE") != nullptr) std::ofstream(path) << PluginReference();
  std::ifstream file(path);
  const std::string page{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  EXPECT_EQ(page, PluginReference());
}

}  // namespace
}  // namespace swarmanoid
