// Every renderer that is registered, of nothing, of one entity, and of one entity of each kind.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "test_folders.h"
#include "tests/unit/every_plugin/small_scene.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

// Needs an X server.
bool HasWindow(const PluginDescription& renderer)
{
  return std::any_of(renderer.parameters.begin(), renderer.parameters.end(),
                     [](const ParameterSpec& parameter) { return parameter.name == "window_size"; });
}

bool IsBuilt(const PluginDescription& renderer)
{
  return renderer.label == "text_render" ||
         std::filesystem::exists(
             fmt::format(SWARMANOID_BUILD_FOLDER "/lib/swarmanoid/libswarmanoid_{}.so", renderer.label));
}

std::string RendererElement(const PluginDescription& renderer)
{
  for (const ParameterSpec& parameter : renderer.parameters)
    EXPECT_TRUE(parameter.default_value || IsNumbered(parameter))
        << "the parameter '" << parameter.name << "' of <" << renderer.label << "> has no default: give it one, or its "
        << "value here";
  // A free port, since others may use the default one.
  const bool listens =
      std::ranges::any_of(renderer.parameters, [](const ParameterSpec& parameter) { return parameter.name == "port"; });
  return fmt::format("<{} id='shown'{}/>", renderer.label, listens ? " port='0'" : "");
}

void DrawSimplestScenes(bool with_window)
{
  RegisterEverything();
  const test::TemporaryFolder folder;
  for (const PluginDescription* renderer : PluginCatalogue::Instance().Of(PluginKind::kRenderer))
  {
    if (HasWindow(*renderer) != with_window || !IsBuilt(*renderer)) continue;
    std::vector<std::string> arenas = {"", Waiting(EntityKind::kFootbot, "late")};
    std::string all;
    double x = 1;
    for (const EntityKind kind : AllKinds())
    {
      arenas.push_back(EntityElement(kind, "one", kRobotX_m, kRobotY_m));
      all += EntityElement(kind, std::string(TagName(kind)), x += 1, kRobotY_m);
    }
    arenas.push_back(all);
    // A window takes long to open.
    if (with_window) arenas = {arenas.front(), arenas[2], arenas.back()};
    for (const std::string& arena : arenas)
    {
      SCOPED_TRACE(fmt::format("{} of '{}'", renderer->label, arena));
      const std::unique_ptr<Experiment> experiment =
          Read(SmallScene{.devices = {}, .arena = arena, .renderers = RendererElement(*renderer), .ticks = 2});
      ASSERT_NE(experiment, nullptr);
      SimulatorOptions options;
      options.threads = 1;
      options.output_folder = folder.Path();
      RunScene(*experiment, options);
    }
  }
}

TEST(SimplestScenes, EachRendererDrawsNothingAndOneEntityOfEachKind) { DrawSimplestScenes(false); }

// tests/window runs this on an X server without a screen.
TEST(SimplestScenes, EachWindowDrawsNothingAndOneEntityOfEachKind)
{
  if (std::getenv("DISPLAY") == nullptr) GTEST_SKIP() << "there is no X server";
  DrawSimplestScenes(true);
}

}  // namespace
}  // namespace swarmanoid
