// The experiment that is run once more to be shown.
#include <gmock/gmock.h>

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "common/experiment/load_experiment.h"
#include "launcher/showing.h"
#include "launcher/system/command_process.h"
#include "launcher/system/network_namespace.h"
#include "launcher/system/scratch_folder.h"
#include "simulation/register_all.h"
#include "test_folders.h"
#include "tests/eventually.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr const char* kElement = R"(<text_render id="shown" file="shown.txt"/>)";

std::vector<std::string> Samples()
{
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(SWARMANOID_SOURCE_FOLDER "/configs"))
    if (entry.path().extension() == ".xml") files.push_back(entry.path());
  return files;
}

std::unique_ptr<Experiment> Loaded(const std::string& text)
{
  LoadedExperiment loaded = LoadExperimentText(text, "shown.xml", SWARMANOID_SOURCE_FOLDER "/configs");
  for (const Diagnostic& error : loaded.errors) ADD_FAILURE() << error.Text();
  return std::move(loaded.experiment);
}

TEST(Showing, TakesThePlaceOfTheVisualisationsOfEachSample)
{
  RegisterBuiltins();
  ASSERT_GT(Samples().size(), 10U);
  for (const std::string& file : Samples())
  {
    SCOPED_TRACE(file);
    const auto experiment = LoadExperimentFile(file).experiment;
    ASSERT_NE(experiment, nullptr);
    const auto shown = Loaded(WithVisualisation(experiment->effective_xml, kElement));
    ASSERT_NE(shown, nullptr);
    ASSERT_EQ(shown->visualisations.size(), 1U);
    EXPECT_EQ(shown->visualisations[0].id, "shown");
    EXPECT_EQ(shown->entities.size(), experiment->entities.size());
    EXPECT_EQ(shown->functions.size(), experiment->functions.size());
    EXPECT_EQ(shown->seed, experiment->seed);
  }
}

TEST(Showing, NeedsNoVisualisationsBefore)
{
  EXPECT_EQ(WithVisualisation("<ahss-config>\n</ahss-config>\n", "<a/>"),
            "<ahss-config>\n  <visualisations>\n    <a/>\n  </visualisations>\n</ahss-config>\n");
  EXPECT_EQ(WithVisualisation("<ahss-config>\n<visualisations/></ahss-config>\n", "<a/>"),
            "<ahss-config>\n  <visualisations>\n    <a/>\n  </visualisations>\n</ahss-config>\n");
}

TEST(Showing, AFilmHasFewerTicksOfMoreRobots)
{
  RegisterBuiltins();
  const auto few = LoadExperimentFile(SWARMANOID_SOURCE_FOLDER "/configs/prey_retrieval.xml").experiment;
  const auto many = LoadExperimentFile(SWARMANOID_SOURCE_FOLDER "/configs/diffusion_10000.xml").experiment;
  ASSERT_TRUE(few && many);
  EXPECT_EQ(TicksOfFilm(*few, 2251), 2251U);
  EXPECT_EQ(TicksOfFilm(*few, 0), few->max_clock);
  EXPECT_EQ(TicksOfFilm(*many, 0), std::min<std::uint64_t>(many->max_clock, 100));
}

TEST(Showing, WhatIsAskedForIsShownBesideTheFilesOwnVisualisationsOrInsteadOfThem)
{
  RegisterBuiltins();
  const auto ids = [](const Experiment& experiment)
  {
    std::string all;
    for (const RenderConfiguration& render : experiment.visualisations) all += render.tag + ":" + render.id + " ";
    return all;
  };
  for (const std::string own : {"", "<visualisations><text_render id='own'/></visualisations>"})
  {
    const auto experiment = Loaded("<ahss-config><arena size='1,1,1' optimization='2D'/>" + own + "</ahss-config>");
    ASSERT_NE(experiment, nullptr);
    const std::string asked = "web_render:shown text_render:shown_2 ";
    EXPECT_EQ(ids(*WithShown(*experiment, {"web", "text"}, true)), (own.empty() ? "" : "text_render:own ") + asked);
    EXPECT_EQ(ids(*WithShown(*experiment, {"web", "text"}, false)), asked)
        << "run --no-visualisers --show web --show text";
  }
}

TEST(Showing, ParametersOfAVisualisationFollowItsKind)
{
  RegisterBuiltins();
  const auto experiment = Loaded("<ahss-config><arena size='1,1,1' optimization='2D'/></ahss-config>");
  const auto shown = WithShown(*experiment, {"image video=a&b.webm  every=2", "web allow_control=false", "web"}, true);
  ASSERT_EQ(shown->visualisations.size(), 3U);
  const auto parameter = [&](std::size_t k, const char* name)
  { return TConfigurationTree(shown->visualisations[k].tree).Attribute(name); };
  EXPECT_EQ(parameter(0, "video"), "a&b.webm");
  EXPECT_EQ(parameter(0, "every"), "2");
  EXPECT_EQ(parameter(1, "allow_control"), "false");
  EXPECT_EQ(parameter(2, "allow_control"), "true");
  const auto mistake = [&](const std::string& words) -> std::string
  {
    try
    {
      WithShown(*experiment, {words}, true);
      return "none";
    }
    catch (const std::runtime_error& error)
    {
      return error.what();
    }
  };
  EXPECT_EQ(mistake("image film.webm"),
            "--show: 'film.webm' of 'image film.webm' must be NAME=VALUE, as in --show \"image video=film.webm\"");
  EXPECT_THAT(mistake("image vidio=film.webm"), testing::HasSubstr("did you mean 'video'"));
  EXPECT_THAT(mistake("  "), testing::HasSubstr("--show: there is no renderer"));
}

TEST(Showing, APageIsForSessionsWithADisplayOrABrowser)
{
  const char* const names[] = {"DISPLAY", "WAYLAND_DISPLAY", "BROWSER"};
  for (const char* name : names) unsetenv(name);
  EXPECT_EQ(KindForSession(), ShowingKind::kFilm);
  for (const char* name : names)
  {
    setenv(name, "", 1);
    EXPECT_EQ(KindForSession(), ShowingKind::kFilm) << name;
    setenv(name, ":1", 1);
    EXPECT_EQ(KindForSession(), ShowingKind::kPage) << name;
    unsetenv(name);
  }
}

TEST(Showing, PathsAreShortInTheCurrentFolder)
{
  EXPECT_EQ(ShortPath(fs::current_path() / "run" / "film.mp4"), "run/film.mp4");
  EXPECT_EQ(ShortPath("/usr/share/film.mp4"), "/usr/share/film.mp4");
}

TEST(Showing, TablesAreNoPictures)
{
  Experiment experiment;
  EXPECT_FALSE(HasPictures(experiment));
  experiment.visualisations.resize(1);
  experiment.visualisations[0].tag = "text_render";
  EXPECT_FALSE(HasPictures(experiment));
  experiment.visualisations.resize(2);
  experiment.visualisations[1].tag = "web_render";
  EXPECT_TRUE(HasPictures(experiment));
}

TEST(Showing, AFilmHasAtMostThreeHundredThousandRobotTicksAndAtLeastAHundredTicks)
{
  Experiment experiment;
  EXPECT_EQ(TicksOfFilm(experiment, 0), 300'000U);
  experiment.entities.resize(300);
  for (EntityConfiguration& entity : experiment.entities) entity.kind = EntityKind::kFootbot;
  EXPECT_EQ(TicksOfFilm(experiment, 0), 1000U);
  experiment.max_clock = 700;
  EXPECT_EQ(TicksOfFilm(experiment, 0), 700U);
  EXPECT_EQ(TicksOfFilm(experiment, 5), 5U);
  EXPECT_EQ(TicksOfFilm(experiment, 5000), 1000U);
  experiment.entities.resize(30'000, experiment.entities[0]);
  EXPECT_EQ(TicksOfFilm(experiment, 5000), 100U);
  for (EntityConfiguration& entity : experiment.entities) entity.kind = EntityKind::kBlock;
  EXPECT_EQ(TicksOfFilm(experiment, 5000), 5000U) << "blocks cost nothing";
}

TEST(CommandProcess, HasTheExitCodeAndTheErrorsOfItsProgram)
{
  const test::TemporaryFolder folder;
  const std::string errors = folder / "errors";
  CommandProcess failed({"sh", "-c", "echo one >&2; echo two >&2; exit 3"}, errors);
  EXPECT_EQ(failed.Wait(), 3);
  EXPECT_TRUE(failed.Ended());
  EXPECT_EQ(failed.Wait(), 3);
  EXPECT_EQ(FirstLineOf(errors), "one");
  EXPECT_EQ(FirstLineOf(folder / "none"), "");
  EXPECT_EQ(CommandProcess({"sh", "-c", "kill -9 $$"}, errors).Wait(), 4) << "a failed process";
  EXPECT_EQ(FirstLineOf(errors), "") << "the file begins again";
  CommandProcess good({"true"}, errors);
  EXPECT_TRUE(test::Eventually([&] { return good.Ended(); }));
  EXPECT_EQ(good.Wait(), 0);
  EXPECT_THROW(CommandProcess({"sh"}, folder / "missing" / "errors"), std::runtime_error);
}

TEST(CommandProcess, AloneReactsToCtrlC)
{
  {
    const InterruptsLeftToHelper interrupts;
    EXPECT_EQ(std::raise(SIGINT), 0);
  }
  const auto before = std::signal(SIGINT, SIG_DFL);
  std::signal(SIGINT, before);
  EXPECT_NE(before, SIG_IGN);
}

TEST(ScratchFolder, IsRemovedWithItsContent)
{
  std::string path;
  {
    const ScratchFolder folder;
    path = folder.Path();
    std::ofstream(path + "/file") << "content";
    EXPECT_TRUE(fs::exists(path + "/file"));
    EXPECT_NE(ScratchFolder().Path(), path);
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(NetworkNamespace, IsThatOfThisProcess)
{
  EXPECT_FALSE(IsInAnotherNetwork(getpid()));
  EXPECT_NO_THROW(EnterNetworkOf(getpid()));
}

}  // namespace
}  // namespace swarmanoid
