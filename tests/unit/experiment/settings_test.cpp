// --set PATH=VALUE.
#include <gmock/gmock.h>

#include "tests/unit/experiment/fake_plugins.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid::test
{
namespace
{

LoadOptions With(const std::string& path, const std::string& value)
{
  LoadOptions options;
  options.settings = {{path, value}};
  return options;
}

std::unique_ptr<Experiment> Changed(const std::string& path, const std::string& value)
{
  EXPECT_EQ(ErrorsOf(kChapter4, With(path, value)), "");
  LoadedExperiment loaded = LoadText(kChapter4, With(path, value));
  return loaded.experiment ? std::move(loaded.experiment) : std::make_unique<Experiment>();
}

TEST(Settings, ReplaceValues)
{
  EXPECT_EQ(Changed("framework.maxclock", "7")->max_clock, 7U);
  EXPECT_EQ(Changed("arena.size", "20,20,5")->arena_size, Vector3(20, 20, 5));
  EXPECT_EQ(Changed("arena.footbot[fb].position", "1,2,0")->entities.at(0).pose.position, Vector3(1, 2, 0));
  EXPECT_EQ(Changed("arena.fb.position", "1,2,0")->entities.at(0).pose.position, Vector3(1, 2, 0));
  EXPECT_EQ(Changed("arena.footbot.position", "1,2,0")->entities.at(0).pose.position, Vector3(1, 2, 0));
  EXPECT_EQ(
      Changed("controllers.fc.parameters.wheels_speed", "3")->controllers.at(0).parameters.GetNumber("wheels_speed"),
      3);
  EXPECT_EQ(Changed("engines.dummy_engine[1].distance", "2")->engines.at(1).tree.GetNumber("distance"), 2);
  EXPECT_EQ(Changed("visualisations.text_world.precision", "4")->visualisations.at(0).tree.GetInteger("precision"), 4);
}

TEST(Settings, AddWhatTheFileLeavesOut)
{
  EXPECT_EQ(Changed("framework.seed", "42")->seed, 42U);
  EXPECT_EQ(Changed("controllers.fc.parameters.gain", "2")->controllers.at(0).parameters.GetNumber("gain"), 2);
  const LoadedExperiment loaded = LoadText(ExperimentText().Text(), With("framework.seed", "9"));
  ASSERT_TRUE(loaded.experiment);
  EXPECT_EQ(loaded.experiment->seed, 9U);
}

TEST(Settings, StandInTheEffectiveText)
{
  const auto experiment = Changed("framework.maxclock", "7");
  const LoadedExperiment again = LoadText(experiment->effective_xml);
  ASSERT_TRUE(again.experiment);
  EXPECT_EQ(again.experiment->max_clock, 7U);
}

TEST(Settings, RefuseWhatNoFileCanHold)
{
  for (const std::string value : {"a\1b", "a\xff", "\xc0\xaf"})
  {
    EXPECT_THAT(
        ErrorsOf(kChapter4, With("visualisations.text_world.file", value)),
        testing::MatchesRegex("--set visualisations.text_world.file: '.*' holds bytes that are not UTF-8 text, or "
                              "control characters\n"));
  }
  EXPECT_EQ(Changed("visualisations.text_world.file", " <ä>\t&\n\"b\" ")->visualisations.at(0).tree.GetText("file"),
            "<ä>\t&\n\"b\"");
  for (const std::string name : {"a b", "1", "a/><b", "a b='1'", "a="})
  {
    EXPECT_EQ(ErrorsOf(kChapter4, With("controllers.fc.parameters." + name, "1")),
              "--set controllers.fc.parameters." + name + ": '" + name + "' is no name of a parameter\n");
  }
}

TEST(Settings, TwoOfOneValueAreRefusedHoweverTheyAreSpelled)
{
  const auto complaint = [](const std::string& one, const std::string& other)
  {
    LoadOptions options;
    options.settings = {{one, "1,2,0"}, {other, "1,3,0"}};
    return ErrorsOf(kChapter4, options);
  };
  // By id, by tag and id, by tag alone and by number: all are the position of the only footbot.
  const std::vector<std::string> spellings{"arena.fb.position", "arena.footbot[fb].position", "arena.footbot.position",
                                           "arena.footbot[0].position", "arena[0].fb.position"};
  for (const std::string& one : spellings)
    for (const std::string& other : spellings)
      EXPECT_EQ(complaint(one, other), "--set " + other + ": '" + other + "' is set already, by --set " + one +
                                           "; leave one of the two out\n");
  // An attribute, a value that the file leaves out, and one in an element that the file leaves out.
  for (const std::string path : {"arena.size", "framework.seed", "controllers.fc.parameters.gain"})
    EXPECT_THAT(complaint(path, path), testing::HasSubstr("'" + path + "' is set already"));
  EXPECT_EQ(complaint("arena.fb.position", "arena.eb.position"), "");
}

TEST(Settings, MistakesNameThePath)
{
  EXPECT_EQ(ErrorsOf(kChapter4, With("framework.maxclok", "7")),
            "--set framework.maxclok: <framework> has no element <maxclok>; allowed: clocktick, ticks_per_second, "
            "maxclock, controller_path, "
            "plugin_path, seed, canonical_period, ahead, name, folder; did you mean 'maxclock'?\n");
  EXPECT_EQ(ErrorsOf(kChapter4, With("framework.maxclock", "x")),
            "--set framework.maxclock: 'maxclock' of <framework> is 'x'; it must be a whole number in ticks, from 0 to "
            "1000000000000000 ticks\n");
  EXPECT_EQ(ErrorsOf(kChapter4, With("arena.footbot[f].position", "1,1,0")),
            "--set arena.footbot[f].position: <arena> holds no 'footbot[f]'; it holds: fb, eb, obstacle, cp, size, "
            "optimization\n");
  EXPECT_EQ(ErrorsOf(kChapter4, With("engines.dummy_engine.distance", "1")),
            "--set engines.dummy_engine.distance: 2 elements of <engines> fit 'dummy_engine'; write tag[id] or, for "
            "those without "
            "an id, tag[0], tag[1] …\n");
  EXPECT_EQ(ErrorsOf(kChapter4, With("arena.fb", "1")),
            "--set arena.fb: <footbot> holds elements, not a value; go on with one of: position, orientation, "
            "controller, id\n");
  EXPECT_EQ(ErrorsOf(kChapter4, With("framework..x", "1")),
            "--set framework..x: the path has an empty step; write for example framework.maxclock=100\n");
  EXPECT_EQ(ErrorsOf(kChapter4, With("", "1")),
            "--set : the path has an empty step; write for example framework.maxclock=100\n");
}

}  // namespace
}  // namespace swarmanoid::test
