// Which parts of an experiment a branch may change in the middle of a run.
#include "launcher/branch_changes.h"

#include <gmock/gmock.h>

#include <functional>

#include "common/program/usage_error.h"
#include "tests/world/message_of.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

using testing::HasSubstr;

// "PATH: VALUE" of each change, with a star if it matters to the state; or the refusal.
std::string Changes(const std::string& before, const std::string& after)
{
  Experiment from, to;
  from.effective_xml = "<ahss-config>" + before + "</ahss-config>";
  to.effective_xml = "<ahss-config>" + after + "</ahss-config>";
  std::string text;
  try
  {
    for (const BranchChange& change : ChangesBetween(from, to))
      text += (text.empty() ? "" : "; ") + change.path + ": " + change.value + (change.matters ? " *" : "");
  }
  catch (const UsageError& error)
  {
    return std::string("refused ") + error.what();
  }
  return text;
}

TEST(BranchChanges, ArePathsWithTheOldAndTheNewValue)
{
  const std::string table = R"(<visualisations><text_render id="t" every="1"/></visualisations>)";
  EXPECT_EQ(Changes(table, table), "");
  EXPECT_EQ(Changes(table, R"(<visualisations><text_render id="t" every="2"/></visualisations>)"),
            "visualisations.t.every: 2 instead of 1");
  EXPECT_EQ(Changes(table, R"(<visualisations><text_render id="t"/></visualisations>)"),
            "visualisations.t.every: nothing instead of 1");
  EXPECT_EQ(Changes(table, R"(<visualisations><text_render id="t" every="1" file="a"/></visualisations>)"),
            "visualisations.t.file: a instead of nothing");
  EXPECT_EQ(Changes(table, R"(<visualisations><text_render id="u" every="1"/></visualisations>)"),
            "visualisations.t: left out; visualisations.u: new");
  EXPECT_EQ(Changes("", table), "visualisations: new");
  EXPECT_EQ(Changes(table, ""), "visualisations: left out");
  EXPECT_EQ(Changes("<framework><maxclock>10</maxclock></framework>", "<framework><maxclock>20</maxclock></framework>"),
            "framework.maxclock: 20 instead of 10");
}

TEST(BranchChanges, AreAllowedIfTheSavedStateFitsThem)
{
  struct Row
  {
    const char* before;
    const char* after;
    const char* change;
  };
  const Row rows[] = {
      {"<framework><seed>1</seed></framework>", "<framework><seed>2</seed></framework>",
       "framework.seed: 2 instead of 1 *"},
      {"<framework><name>a</name></framework>", "<framework><name>b</name></framework>",
       "framework.name: b instead of a"},
      {"<framework><folder>a</folder></framework>", "<framework><folder>b</folder></framework>",
       "framework.folder: b instead of a"},
      {R"(<controllers><c id="x"><parameters gain="1"/></c></controllers>)",
       R"(<controllers><c id="x"><parameters gain="2"/></c></controllers>)",
       "controllers.x.parameters.gain: 2 instead of 1 *"},
      {R"(<controllers><c id="x"><sensors><s range="1"/></sensors></c></controllers>)",
       R"(<controllers><c id="x"><sensors><s range="2"/></sensors></c></controllers>)",
       "controllers.x.sensors.s.range: 2 instead of 1 *"},
      {R"(<controllers><c id="x"><actuators><a noise="1"/></actuators></c></controllers>)",
       R"(<controllers><c id="x"><actuators><a noise="2"/></actuators></c></controllers>)",
       "controllers.x.actuators.a.noise: 2 instead of 1 *"},
      {R"(<engines><dynamics2d id="g" friction="1"/></engines>)",
       R"(<engines><dynamics2d id="g" friction="2"/></engines>)", "engines.g.friction: 2 instead of 1 *"},
      {R"(<experiment_functions><f id="f"><parameters goal="1"/></f></experiment_functions>)",
       R"(<experiment_functions><f id="f"><parameters goal="2"/></f></experiment_functions>)",
       "experiment_functions.f.parameters.goal: 2 instead of 1 *"}};
  for (const auto& [before, after, change] : rows) EXPECT_EQ(Changes(before, after), change);
}

TEST(BranchChanges, AreRefusedWithTheReason)
{
  struct Row
  {
    const char* before;
    const char* after;
    const char* path;
    const char* reason;
  };
  const Row rows[] = {
      {"<framework><ticks_per_second>10</ticks_per_second></framework>",
       "<framework><ticks_per_second>20</ticks_per_second></framework>", "framework.ticks_per_second",
       "the same for a whole run"},
      {R"(<controllers><c id="x" library="a"/></controllers>)", R"(<controllers><c id="x" library="b"/></controllers>)",
       "controllers.x.library", "which code steps the robots"},
      {R"(<controllers><c id="x"/></controllers>)", "<controllers/>", "controllers.x", "which code steps the robots"},
      {R"(<controllers><c id="x"><sensors><s implementation="a"/></sensors></c></controllers>)",
       R"(<controllers><c id="x"><sensors><s implementation="b"/></sensors></c></controllers>)",
       "controllers.x.sensors.s.implementation", "built with these devices"},
      {R"(<controllers><c id="x"><sensors/></c></controllers>)",
       R"(<controllers><c id="x"><sensors><s/></sensors></c></controllers>)", "controllers.x.sensors.s",
       "built with these devices"},
      {R"(<controllers><c id="x"><actuators><a/></actuators></c></controllers>)",
       R"(<controllers><c id="x"><actuators/></c></controllers>)", "controllers.x.actuators.a",
       "built with these devices"},
      {R"(<engines><dynamics2d id="g"/></engines>)", R"(<engines><dynamics2d id="h"/></engines>)", "engines.g",
       "what an engine remembers"},
      {"", "<engines/>", "engines", "what an engine remembers"},
      {R"(<experiment_functions><f id="f" library="a"/></experiment_functions>)",
       R"(<experiment_functions><f id="f" library="b"/></experiment_functions>)", "experiment_functions.f.library",
       "of their code"},
      {"<experiment_functions/>", R"(<experiment_functions><f id="f"/></experiment_functions>)",
       "experiment_functions.f", "of their code"},
      {R"(<arena size="1,1,1"/>)", R"(<arena size="2,1,1"/>)", "arena.size", "part of the state"},
      {R"(<other a="1"/>)", R"(<other a="2"/>)", "other.a", "the same for a whole run"}};
  for (const auto& [before, after, path, reason] : rows)
  {
    EXPECT_THAT(Changes(before, after), HasSubstr(std::string("--branch: ") + path + " cannot change")) << before;
    EXPECT_THAT(Changes(before, after), HasSubstr(reason)) << before;
  }
}

TEST(BranchChanges, LeaveWhatCannotMoveWhereItIs)
{
  const auto make = []
  {
    Experiment experiment;
    experiment.effective_xml = "<ahss-config/>";
    test::Add(experiment, test::Entity(EntityKind::kFootbot, "fb", {1, 1, 0}));
    test::Add(experiment, test::Entity(EntityKind::kWall, "wall", {2, 2, 0.5}, {1, 0.1, 1}, false));
    return experiment;
  };
  const auto refused = [&](const std::function<void(Experiment&)>& change)
  {
    Experiment after = make();
    change(after);
    const Experiment before = make();
    return test::MessageOf<UsageError>([&] { ChangesBetween(before, after); });
  };
  EXPECT_TRUE(ChangesBetween(make(), make()).empty());
  Experiment moved = make();
  moved.entities[0].pose.position.x() = 1.5;  // its pose is in the saved state
  EXPECT_TRUE(ChangesBetween(make(), moved).empty());
  EXPECT_THAT(refused([](Experiment& e) { e.entities[1].pose.position.x() = 1.5; }),
              HasSubstr("'wall' is another one"));
  EXPECT_THAT(refused([](Experiment& e) { e.entities[1].pose.orientation = QuaternionFromYaw(1); }),
              HasSubstr("'wall'"));
  EXPECT_THAT(refused([](Experiment& e) { e.entities[1].size.x() = 2; }), HasSubstr("'wall'"));
  EXPECT_THAT(refused([](Experiment& e) { e.entities[1].mass_kg = 2; }), HasSubstr("'wall'"));
  EXPECT_THAT(refused([](Experiment& e) { e.entities[1].movable = true; }), HasSubstr("'wall'"));
  EXPECT_THAT(refused([](Experiment& e) { e.entities[0].id = "other"; }), HasSubstr("'other'"));
  EXPECT_THAT(refused([](Experiment& e) { e.entities[0].kind = EntityKind::kEyebot; }), HasSubstr("'fb'"));
  EXPECT_THAT(refused([](Experiment& e) { e.entities.pop_back(); }), HasSubstr("'wall'"));
  EXPECT_THAT(refused([](Experiment& e) { test::Add(e, test::Entity(EntityKind::kFootbot, "more")); }),
              HasSubstr("'more'"));
}

}  // namespace
}  // namespace swarmanoid
