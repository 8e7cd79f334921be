// Which entities an engine gets by patterns of their ids.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/unit/experiment/fake_plugins.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid::test
{
namespace
{

std::string Fitting(const std::string& pattern)
{
  ExperimentText experiment{.size = "90,9,2", .physics = "<engine id='e'><entity id='" + pattern + "'/></engine>"};
  int x = 0;
  for (const char* id : {"fb_1", "fb_2", "fb_12", "fb", "b.x:y-z", "a_fb_1"})
    experiment.arena += fmt::format("<block id='{}' position='{}, 1, 1' size='1, 1, 1'/>", id, x += 3);
  const std::string text = experiment.Text();
  const LoadedExperiment loaded = LoadText(text);
  if (!loaded.experiment) return ErrorsOf(text);
  std::string ids;
  for (const std::uint32_t entity : loaded.experiment->engines.at(0).entities)
    ids += (ids.empty() ? "" : " ") + loaded.experiment->entities.at(entity).id;
  return ids;
}

TEST(ArenaPhysics, TakesTheEntitiesWhoseIdsFitAPattern)
{
  EXPECT_EQ(Fitting("fb_*"), "fb_1 fb_2 fb_12");
  EXPECT_EQ(Fitting("fb_?"), "fb_1 fb_2");
  EXPECT_EQ(Fitting("fb*"), "fb_1 fb_2 fb_12 fb");
  EXPECT_EQ(Fitting("*_1"), "fb_1 a_fb_1");
  EXPECT_EQ(Fitting("*fb*1*"), "fb_1 fb_12 a_fb_1");
  EXPECT_EQ(Fitting("?.?:*-z"), "b.x:y-z");
  EXPECT_EQ(Fitting("**"), "fb_1 fb_2 fb_12 fb b.x:y-z a_fb_1");
  EXPECT_EQ(Fitting("f?"), "fb");
}

TEST(ArenaPhysics, KnowsNoOtherSignsInPatterns)
{
  for (const char* pattern : {"fb_[12]*", "fb_[!3]*", "fb\\_*", "FB_*", "[*", "fb_*\\"})
    EXPECT_NE(Fitting(pattern).find("no entity fits '" + std::string(pattern) + "'"), std::string::npos) << pattern;
}

TEST(ArenaPhysics, FindsOutQuicklyThatNoIdFitsALongPattern)
{
  std::string pattern;
  for (int k = 0; k < 5000; ++k) pattern += "*?b*";
  EXPECT_NE(Fitting(pattern + "q").find("no entity fits"), std::string::npos);
}

// Processes with a part of an engine's world read the experiment in this way, with any number of entities.
TEST(ArenaPhysics, EnginesMayBeReadAlone)
{
  const std::string text =
      ExperimentText{.framework = "<clocktick>50</clocktick>",
                     .arena = "<block id='b' size='no'/>",
                     .engines = "<dummy_engine id='e'><subclock>3</subclock></dummy_engine><dummy_engine id='f'/>",
                     .physics = "<engine id='e'><entity id='nobody'/></engine>"}
          .Text();
  LoadOptions options;
  options.engines_alone = true;
  const LoadedExperiment loaded = LoadText(text, options);
  ASSERT_EQ(ErrorsOf(text, options), "");
  EXPECT_EQ(loaded.experiment->clock_tick_ms, 50U);
  ASSERT_EQ(loaded.experiment->engines.size(), 2U);
  EXPECT_EQ(loaded.experiment->engines[0].id, "e");
  EXPECT_EQ(loaded.experiment->engines[0].tag, "dummy_engine");
  EXPECT_EQ(loaded.experiment->engines[0].subclock, 3);
  EXPECT_TRUE(loaded.experiment->entities.empty());
  EXPECT_NE(ErrorsOf(text), "");
}

}  // namespace
}  // namespace swarmanoid::test
