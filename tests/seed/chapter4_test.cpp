// The experiment of the documentation's listings, put together from the printed parts, runs; its text output has the
// form of the printed figure.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "common/control_interface/footbot/ci_footbot_wheels_actuator.h"
#include "common/experiment/load_experiment.h"
#include "simulation/register_all.h"
#include "simulation/simulator.h"
#include "tests/results/held_hash.h"
#include "tests/world/temporary_folder.h"
#include "visualiser/render.h"

namespace swarmanoid
{
namespace
{

class SeedChapter4 : public testing::Test
{
protected:
  SeedChapter4() { RegisterBuiltins(); }

  std::unique_ptr<Experiment> Load(const std::string& text) const
  {
    LoadOptions options;
    options.settings = {{"framework.controller_path", SEED_CONTROLLERS}};
    LoadedExperiment loaded = LoadExperimentText(text, "chapter4.xml", folder_.Path(), options);
    for (const Diagnostic& error : loaded.errors) ADD_FAILURE() << error.Text();
    return std::move(loaded.experiment);
  }

  const test::TemporaryFolder folder_;
};

// Returns the listing without its window, which needs a display.
std::string WithoutWindow(std::string text)
{
  const std::string end = "</opengl_render>";
  const std::size_t first = text.find("<opengl_render");
  const std::size_t last = text.find(end);
  return first == std::string::npos ? text : text.erase(first, last + end.size() - first);
}

TEST_F(SeedChapter4, TheExperimentIsValidAsPrinted)
{
  if (PluginRegistry<CRender>::Instance().Find("opengl_render") == nullptr) GTEST_SKIP() << "no opengl_render here";
  EXPECT_TRUE(Load(test::TextOf(CHAPTER4_XML)));
}

TEST_F(SeedChapter4, TheExperimentRuns)
{
  const auto experiment = Load(WithoutWindow(test::TextOf(CHAPTER4_XML)));
  ASSERT_TRUE(experiment);
  SimulatorOptions options;
  options.output_folder = folder_.Path();
  CSimulator simulator(*experiment, options);
  const CSwarmanoidSpace& space = simulator.GetSpace();
  for (int tick = 0; tick < 10; ++tick) ASSERT_TRUE(simulator.Step());

  // One second at the speed of <wheels_speed>, in the direction of <orientation>.
  const double way = 10 * CCI_FootBotWheelsActuator::WHEEL_RADIUS_M;
  const Vector3 footbot = space.FindEntity("fb")->GetPosition();
  EXPECT_NEAR(footbot.x(), 9 + way * std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(footbot.y(), 9 + way * std::sqrt(0.5), 1e-9);
  EXPECT_EQ(space.FindEntity("eb")->GetPosition(), Vector3(5, 5, 1));
  EXPECT_EQ(space.FindEntity("cp")->GetPosition(), Vector3(8, 8, 0));

  while (simulator.Step()) continue;
  const RunSummary summary = simulator.Finish();
  EXPECT_EQ(summary.ticks, 500U);
  EXPECT_EQ(summary.hash, test::HeldHash("seed_chapter4")) << fmt::format("{:016x}", summary.hash);
  const std::string table = folder_.Read("experiment_output.txt");
  EXPECT_NE(table.find("\n0\t\tFootbot\tfb\t9\t9\t0\t0\t0\t45\n"), std::string::npos);
  EXPECT_NE(table.find("\n500\t\tBlock\tobstacle\t5\t5\t0.25\t0\t0\t0\n"), std::string::npos);
}

// Byte for byte: the lines of the figure.
TEST_F(SeedChapter4, TheTextVisualizationWritesTheTableOfTheFigure)
{
  std::istringstream figure(test::TextOf(FIGURE_3_11));
  std::string entities;
  std::string expected;
  for (std::string line; std::getline(figure, line);)
  {
    std::istringstream cells(line);
    std::string clock, type, id, x, y, z, alpha, beta, gamma;
    if (!(cells >> clock >> type >> id >> x >> y >> z >> alpha >> beta >> gamma) || clock != "10") continue;
    std::string tag = type;
    tag[0] = static_cast<char>(std::tolower(tag[0]));
    entities +=
        fmt::format("<{0} id=\"{1}\"><position>{2},{3},{4}</position><orientation>{5},{6},{7}</orientation>{8}</{0}>\n",
                    tag, id, x, y, z, alpha, beta, gamma, tag == "block" ? "<size>.1,.1,.1</size>" : "");
    expected += line + "\n";
  }
  ASSERT_NE(expected, "");
  const auto experiment = Load(fmt::format(R"(<ahss-config>
    <framework><clocktick>100</clocktick><maxclock>10</maxclock></framework>
    <arena size="10,10,3" optimization="3D">{}</arena>
    <engines/><arena_physics/>
    <visualisations><text_render id="t"><file>figure.txt</file><precision>3</precision></text_render></visualisations>
    </ahss-config>)",
                                           entities));
  ASSERT_TRUE(experiment);
  SimulatorOptions options;
  options.output_folder = folder_.Path();
  CSimulator simulator(*experiment, options);
  while (simulator.Step()) continue;
  simulator.Finish();
  const std::string table = folder_.Read("figure.txt");
  EXPECT_EQ(table.substr(0, table.find('\n')), "#\tclock\tEntity type\tEntity id\tX\tY\tZ\tAlpha\tBeta\tGamma");
  EXPECT_EQ(table.substr(table.find("\n10\t") + 1), expected);
}

}  // namespace
}  // namespace swarmanoid
