// An experiment that is edited: what each change writes, what is refused, and that all else stays, byte for byte.
#include "launcher/editor/edited_experiment.h"

#include <gmock/gmock.h>

#include <random>

#include "common/configuration/xml_reader.h"
#include "common/space/space.h"
#include "launcher/system/scratch_folder.h"
#include "simulation/register_all.h"
#include "simulation/simulator.h"
#include "test_folders.h"
#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

using testing::HasSubstr;

const std::string kConfigs = SWARMANOID_SOURCE_FOLDER "/configs";

// A file as a user has it, with {} in the place of a part.
std::string File(const std::string& entities)
{
  return "<?xml version=\"1.0\"?>\n<!-- mine -->\n<ahss-config>\n  <framework maxclock='10'/>  <!-- short -->\n"
         "  <arena size=\"4, 4, 1\" optimization='2D'>\n" +
         entities +
         "  </arena>\n  <engines><dummy_engine id='ground'/></engines>\n"
         "  <arena_physics><engine id='ground'><all/></engine></arena_physics>\n</ahss-config>\n";
}

const std::string kRobots =
    "    <footbot id=\"fb_1\">\n      <position>1, 1, 0</position> <!-- here -->\n    </footbot>\n"
    "    <footbot id='fb_2' position='2,1,0'/>\n";

const ElementPath kArena{1}, kFirst{1, 0}, kSecond{1, 1};

EditedExperiment Open(const std::string& text)
{
  RegisterBuiltins();
  return {text, "f.xml", kConfigs};
}

template <class Act>
std::string RefusalOf(Act act)
{
  return test::MessageOf<std::invalid_argument>(act);
}

TEST(EditedExperiment, OffersTheControllersOfSamplesWithTheirDevices)
{
  EditedExperiment experiment = Open(File(""));
  const ElementPath controllers = experiment.Add({}, "controllers", std::nullopt);
  const auto offered = experiment.FormAt(controllers).children;
  const auto found = std::ranges::find(offered, "footbot_diffusion", &ElementForm::Child::tag);
  ASSERT_NE(found, offered.end());
  EXPECT_THAT(found->description, HasSubstr("Library footbot_diffusion"));
  const ElementPath controller = experiment.Add(controllers, "footbot_diffusion", std::nullopt);
  const std::string id = experiment.NameOf(controller);
  EXPECT_EQ(id, "footbot_diffusion_1");
  const ElementPath second = experiment.Add(controllers, "footbot_diffusion", std::nullopt);
  EXPECT_EQ(experiment.NameOf(second), "footbot_diffusion_2");
  const ElementPath robot = experiment.Add(kArena, "footbot", Vector2(1, 1));
  EXPECT_EQ(TreeOf(experiment.NodeAt(robot)).Value("controller"), id);
  EXPECT_THAT(experiment.Mistakes(), testing::IsEmpty());
  ASSERT_NE(experiment.GetExperiment(), nullptr);
  EXPECT_EQ(experiment.GetExperiment()->controllers.size(), 2U);
  EXPECT_EQ(experiment.GetExperiment()->controllers[0].sensors.size(), 1U);
  while (experiment.Undo()) continue;
  EXPECT_EQ(experiment.Text(), File(""));
}

TEST(EditedExperiment, PlacesWithoutTouchingAnythingElse)
{
  EditedExperiment experiment = Open(File(kRobots));
  ASSERT_EQ(experiment.EntityPaths(), (std::vector<ElementPath>{kFirst, kSecond}));
  experiment.Place({{kFirst, Vector3(1.5, 0.25, 0), 90.0}, {kSecond, Vector3(2, 3, 0), std::nullopt}});
  EXPECT_EQ(
      experiment.Text(),
      File("    <footbot id=\"fb_1\">\n      <position>1.5, 0.25, 0</position> <!-- here -->\n"
           "      <orientation>0, 0, 90</orientation>\n    </footbot>\n    <footbot id='fb_2' position='2, 3, 0'/>\n"));
  ASSERT_NE(experiment.GetExperiment(), nullptr);
  EXPECT_EQ(experiment.GetExperiment()->entities[0].pose.position, Vector3(1.5, 0.25, 0));
  // Both are one step.
  EXPECT_EQ(*experiment.History().UndoName(), "place 2 entities");
  EXPECT_TRUE(experiment.Undo());
  EXPECT_EQ(experiment.Text(), File(kRobots));
  // A heading that is the same is not written.
  experiment.Place({{kFirst, std::nullopt, 360.0}});
  EXPECT_EQ(experiment.Text(), File(kRobots));
}

TEST(EditedExperiment, KeepsTheOtherAnglesOfAHeading)
{
  EditedExperiment experiment =
      Open(File("    <block id='b' size='1, 1, 1' position='2, 2, .5' orientation='0,10,20'/>\n"));
  const std::string before = experiment.Text();
  experiment.Place({{kFirst, std::nullopt, 20.0}});
  EXPECT_EQ(experiment.Text(), before) << "it has this heading";
  experiment.Place({{kFirst, std::nullopt, -30.0}});
  EXPECT_THAT(experiment.Text(), HasSubstr("orientation='0, 10, -30'"));
}

TEST(EditedExperiment, AddsWhatStandsOnTheFloorWithAFreeId)
{
  EditedExperiment experiment = Open(File(kRobots));
  EXPECT_EQ(experiment.Add(kArena, "footbot", Vector2(3, 3)), (ElementPath{1, 2}));
  EXPECT_THAT(experiment.Text(), HasSubstr("position='2,1,0'/>\n    <footbot id=\"fb_3\">\n      <position>3, 3, "
                                           "0</position>\n    </footbot>\n  </arena>"));
  EXPECT_EQ(*experiment.History().UndoName(), "add fb_3");
  experiment.Add(kArena, "block", Vector2(2, 3));
  EXPECT_THAT(experiment.Text(), HasSubstr("<block id=\"block_1\">\n      <position>2, 3, 0.25</position>"));
  experiment.Add(kArena, "cylindric_prey", Vector2(1, 3));
  experiment.Add(kArena, "nest", std::nullopt);
  EXPECT_TRUE(experiment.Mistakes().empty()) << experiment.Mistakes().front().Text();
  EXPECT_EQ(experiment.GetExperiment()->entities.size(), 6U);
  // Elements that the file cannot have there are refused.
  EXPECT_EQ(RefusalOf([&] { experiment.Add({0}, "footbot", std::nullopt); }), "<framework> takes no <footbot>");
  EXPECT_EQ(RefusalOf([&] { experiment.Add({}, "arena", std::nullopt); }), "<ahss-config> takes no further <arena>");
}

TEST(EditedExperiment, AddsSectionsControllersAndDevices)
{
  EditedExperiment experiment = Open(ReadTextFile(kConfigs + "/diffusion_10.xml"));
  const ElementPath controllers{1}, controller{1, 0}, sensors{1, 0, 1};
  ASSERT_EQ(experiment.NameOf(controller), "diffusion");
  experiment.Add(sensors, "footbot_light", std::nullopt);
  EXPECT_THAT(
      experiment.Text(),
      HasSubstr("</footbot_proximity>\n        <footbot_light>\n          <implementation>generic_footbot_light"));
  EXPECT_EQ(experiment.Add(controllers, "footbot_diffusion", std::nullopt), (ElementPath{1, 1}));
  EXPECT_EQ(experiment.NameOf({1, 1}), "diffusion_1");
  EXPECT_THAT(experiment.Mistakes(), testing::IsEmpty());
  experiment.Remove({{1, 1, 1}});
  experiment.Add({1, 1}, "sensors", std::nullopt);
  experiment.Add({}, "experiment_functions", std::nullopt);
  for (const Diagnostic& mistake : experiment.Mistakes()) EXPECT_THAT(mistake.message, HasSubstr("librar"));
  const ElementForm form = experiment.FormAt({1, 0, 2});
  ASSERT_TRUE(form.known);
  EXPECT_EQ(form.parameters.front().name, "velocity");
  while (experiment.Undo()) continue;
  EXPECT_EQ(experiment.Text(), ReadTextFile(kConfigs + "/diffusion_10.xml"));
}

TEST(EditedExperiment, ShowsWhatIsWrongAndWhere)
{
  EditedExperiment experiment = Open(File(kRobots));
  EXPECT_TRUE(experiment.Mistakes().empty());
  experiment.Place({{kSecond, Vector3(1.05, 1, 0), std::nullopt}});
  ASSERT_EQ(experiment.Mistakes().size(), 1U);
  EXPECT_EQ(experiment.Mistakes().front().location.Text(), "f.xml:9:24");
  EXPECT_EQ(experiment.PathAt(experiment.Mistakes().front().location), kSecond);
  // It is drawn at its position all the same.
  EXPECT_EQ(experiment.GetExperiment()->entities[1].pose.position, Vector3(1.05, 1, 0));
  EXPECT_EQ(CSwarmanoidSpace(*experiment.GetExperiment()).Size(), 2U);
  experiment.SetValue(kSecond, "controller", "none");
  EXPECT_EQ(experiment.Mistakes().size(), 2U);
  experiment.SetValue(kSecond, "controller", std::nullopt);
  EXPECT_EQ(experiment.Mistakes().size(), 1U);
}

TEST(EditedExperiment, RefusesWhatDoesNotFitAndChangesNothing)
{
  EditedExperiment experiment = Open(File(kRobots));
  const auto refused = [&](auto act, const std::string& why)
  {
    EXPECT_THAT(RefusalOf([&] { act(experiment); }), HasSubstr(why));
    EXPECT_EQ(experiment.Text(), File(kRobots));
    EXPECT_EQ(experiment.History().UndoName(), nullptr);
  };
  refused([](auto& e) { e.SetValue({1, 7}, "id", "x"); }, "not there any more");
  refused([](auto& e) { e.SetValue(kFirst, "colour", "red"); }, "fb_1 has no parameter 'colour'");
  refused([](auto& e) { e.SetValue(kFirst, "id", "\x01"); }, "nothing is changed");
  refused([](auto& e) { e.Rewrite(kFirst, "<footbot/></arena>"); }, "the new text");
  refused([](auto& e) { e.Rewrite(kFirst, "<footbot/><footbot/>"); }, "the new text");
  refused([](auto& e) { e.Rewrite({}, "<other/>"); }, "must be one element, <ahss-config>");
  refused([](auto& e) { e.Remove({kArena}); }, "<arena> cannot be removed");
  refused([](auto& e) { e.Remove({kFirst, kFirst}); }, "do not fit together");
  refused([](auto& e) { e.Place({{{0}, Vector3::Zero(), std::nullopt}}); }, "<framework> has no place");
  EXPECT_THROW(ParsePath("1/x"), std::invalid_argument);
  EXPECT_EQ(ParsePath("1/12"), (ElementPath{1, 12}));
  EXPECT_EQ(PathText({1, 12}), "1/12");
  EXPECT_THROW(Open("<ahss-config>"), ConfigurationError);
}

TEST(EditedExperiment, WritesOutADistributionWhereItStands)
{
  EditedExperiment experiment = Open(ReadTextFile(kConfigs + "/diffusion_10.xml"));
  const std::string before = experiment.Text();
  const ElementPath& robot = experiment.EntityPaths().back();
  ASSERT_TRUE(experiment.IsDistributed(robot));
  EXPECT_THAT(RefusalOf(
                  [&] {
                    experiment.Place({{robot, Vector3(1, 1, 0), std::nullopt}});
                  }),
              HasSubstr("is placed by the <distribute> in line"));
  EXPECT_THAT(RefusalOf([&] { experiment.Remove({robot}); }), HasSubstr("is one of many"));
  std::vector<Pose> poses;
  for (const EntityConfiguration& entity : experiment.GetExperiment()->entities) poses.push_back(entity.pose);

  experiment.WriteOut({robot.begin(), robot.end() - 1});
  EXPECT_TRUE(experiment.Mistakes().empty());
  const auto& entities = experiment.GetExperiment()->entities;
  ASSERT_EQ(entities.size(), poses.size());
  for (std::size_t e = 0; e < poses.size(); ++e)
  {
    EXPECT_EQ(entities[e].pose.position, poses[e].position) << entities[e].id;
    EXPECT_LT(entities[e].pose.orientation.angularDistance(poses[e].orientation), 1e-9);
    EXPECT_FALSE(experiment.IsDistributed(experiment.EntityPaths()[e]));
  }
  EXPECT_THAT(experiment.Text(),
              HasSubstr("    <footbot id=\"fb_0\">\n      <controller>diffusion</controller>\n      <position>"));
  // The text before and after it is unchanged.
  const std::size_t begin = before.find("<distribute"), behind = before.size() - before.find("</distribute>") - 13;
  EXPECT_EQ(experiment.Text().substr(0, begin), before.substr(0, begin));
  EXPECT_EQ(experiment.Text().substr(experiment.Text().size() - behind), before.substr(before.size() - behind));
  EXPECT_TRUE(experiment.Undo());
  EXPECT_EQ(experiment.Text(), before);
}

TEST(EditedExperiment, StartsAsARunDoes)
{
  for (const char* name : {"diffusion_10", "prey_retrieval", "rough_terrain"})
  {
    const EditedExperiment experiment = [&]
    {
      RegisterBuiltins();
      return EditedExperiment(ReadTextFile(kConfigs + "/" + name + ".xml"), kConfigs + "/" + name + ".xml", kConfigs);
    }();
    ASSERT_NE(experiment.GetExperiment(), nullptr);
    SimulatorOptions options;
    options.visualisations = false;
    const test::TemporaryFolder folder;
    options.output_folder = folder.Path();
    const auto run = ReadExperiment(kConfigs + "/" + name + ".xml");
    const CSimulator simulator(*run, options);
    EXPECT_EQ(CSwarmanoidSpace(*experiment.GetExperiment()).Hash(), simulator.GetSpace().Hash()) << name;
  }
}

// Whatever a hand does to the samples: undone, every byte is as before, and each step changes a part of the text.
TEST(EditedExperiment, TakesBackRandomChangesOfTheSamples)
{
  std::mt19937 random(7);
  const auto draw = [&](std::size_t below) { return std::uniform_int_distribution<std::size_t>(0, below - 1)(random); };
  int changes = 0;
  for (const char* name :
       {"prey_retrieval", "three_engines", "sound_seekers", "sample_footbot", "epuck_mixed", "handbot_shelf"})
  {
    const std::string before = ReadTextFile(kConfigs + "/" + name + ".xml");
    EditedExperiment experiment = Open(before);
    std::vector<std::string> states{before};
    for (int step = 0; step < 12; ++step)
    {
      SCOPED_TRACE(std::string(name) + ", step " + std::to_string(step));
      const auto& paths = experiment.EntityPaths();
      if (paths.empty()) break;
      const ElementPath path = paths[draw(paths.size())];
      const std::size_t count = experiment.GetExperiment()->entities.size();
      const bool distributed = experiment.IsDistributed(path);
      const std::size_t what = draw(3);
      const std::string refusal = RefusalOf(
          [&]
          {
            if (what == 0)
              experiment.Place({{path, Vector3(0.1 * static_cast<double>(draw(30)), 0.5, 0), double(draw(360))}});
            if (what == 1) experiment.Remove({path});
            if (what == 2) experiment.Add({path.begin(), path.begin() + 1}, experiment.At(path).name, Vector2(1, 1));
          });
      EXPECT_EQ(refusal.empty(), !distributed || what == 2) << refusal;
      if (!refusal.empty()) continue;
      ++changes;
      ASSERT_NE(experiment.GetExperiment(), nullptr);
      EXPECT_EQ(experiment.GetExperiment()->entities.size(), count + what / 2 - (what == 1 ? 1 : 0));
      if (experiment.Text() != states.back()) states.push_back(experiment.Text());
    }
    for (std::size_t i = states.size(); i-- > 0;)
    {
      EXPECT_EQ(experiment.Text(), states[i]);
      EXPECT_EQ(experiment.Undo(), i > 0);
    }
    EXPECT_EQ(experiment.Text(), before);
  }
  EXPECT_GT(changes, 30);
}

}  // namespace
}  // namespace swarmanoid
