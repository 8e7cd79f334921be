// The listings of the documentation's chapter 4 are read as printed.
#include <gtest/gtest.h>

#include "common/math/elementary.h"
#include "tests/unit/experiment/fake_plugins.h"

namespace swarmanoid::test
{
namespace
{

TEST(Chapter4, ListingIsAccepted) { EXPECT_EQ(ErrorsOf(kChapter4), ""); }

TEST(Chapter4, ValuesAreThoseOfTheListing)
{
  const LoadedExperiment loaded = LoadText(kChapter4);
  ASSERT_TRUE(loaded.experiment);
  const Experiment& experiment = *loaded.experiment;
  EXPECT_EQ(experiment.name, "test");
  EXPECT_EQ(experiment.clock_tick_ms, 100U);
  EXPECT_EQ(experiment.max_clock, 500U);
  EXPECT_EQ(experiment.controller_path.at(0),
            "/path/to/swarmanoid_dev/user/pincy/simulation_build/controllers/mycontroller1/.libs");
  EXPECT_EQ(experiment.controller_path.at(1),
            "/path/to/swarmanoid_dev/user/pincy/simulation_build/controllers/mycontroller2/.libs");
  EXPECT_EQ(experiment.controller_path.at(2), "/experiments");
  EXPECT_EQ(experiment.arena_size, Vector3(10, 10, 3));
  EXPECT_EQ(experiment.optimization, SpaceOptimization::k2D);

  const ControllerConfiguration* controller = experiment.FindController("fc");
  ASSERT_NE(controller, nullptr);
  EXPECT_EQ(controller->tag, "footbot_sample_controller");
  EXPECT_EQ(controller->library, "footbot_sample_controller");
  ASSERT_EQ(controller->actuators.size(), 2U);
  EXPECT_EQ(controller->actuators[0].implementation, "dummy_footbot_wheels");
  ASSERT_EQ(controller->sensors.size(), 2U);
  EXPECT_EQ(controller->sensors[1].type, "footbot_proximity");
  EXPECT_EQ(controller->sensors[1].implementation, "generic_footbot_polynomial_proximity");
  EXPECT_EQ(controller->parameters.GetNumber("wheels_speed"), 10);

  ASSERT_EQ(experiment.entities.size(), 4U);
  const EntityConfiguration& footbot = experiment.entities[0];
  EXPECT_EQ(footbot.kind, EntityKind::kFootbot);
  EXPECT_EQ(footbot.controller, "fc");
  EXPECT_TRUE(footbot.movable);
  EXPECT_NEAR(RadiansToDegrees(YawOf(footbot.pose.orientation)), 45, 1e-12);
  EXPECT_EQ(experiment.entities[2].size, Vector3(.5, .05, .5));
  EXPECT_FALSE(experiment.entities[2].movable);
  EXPECT_EQ(experiment.entities[3].kind, EntityKind::kCylindricPrey);
  EXPECT_EQ(experiment.entities[3].size, Vector3(0.1, 0.1, 0.1));

  ASSERT_EQ(experiment.engines.size(), 2U);
  EXPECT_EQ(experiment.engines[0].id, "ground");
  EXPECT_EQ(experiment.engines[0].entities, (std::vector<std::uint32_t>{0, 2, 3}));
  EXPECT_EQ(experiment.engines[1].id, "sky");
  EXPECT_EQ(experiment.engines[1].entities, (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(experiment.engines[1].tree.GetNumber("distance"), 1);
  ASSERT_EQ(experiment.visualisations.size(), 2U);
  EXPECT_EQ(experiment.visualisations[1].tree.GetVector3("camera_view_XYZ_1"), Vector3(6.2875, 3.33551, 1.25));
}

TEST(Chapter4, EffectiveTextGivesTheSameExperiment)
{
  const LoadedExperiment first = LoadText(kChapter4);
  ASSERT_TRUE(first.experiment);
  RegisterFakePlugins();
  LoadOptions options;
  options.check_files = false;
  const LoadedExperiment second =
      LoadExperimentText(first.experiment->effective_xml, "elsewhere/copy.xml", "/elsewhere", options);
  ASSERT_TRUE(second.experiment) << second.errors.front().Text();
  EXPECT_EQ(second.experiment->effective_xml, first.experiment->effective_xml);
  EXPECT_EQ(second.experiment->name, "test");
  EXPECT_EQ(second.experiment->folder, "/experiments");
  EXPECT_EQ(second.experiment->controller_path, first.experiment->controller_path);
  ASSERT_EQ(second.experiment->entities.size(), first.experiment->entities.size());
  for (std::size_t i = 0; i < first.experiment->entities.size(); ++i)
  {
    EXPECT_EQ(second.experiment->entities[i].pose.position, first.experiment->entities[i].pose.position);
  }
}

}  // namespace
}  // namespace swarmanoid::test
