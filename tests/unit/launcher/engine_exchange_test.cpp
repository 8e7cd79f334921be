// `swarmanoid check FILE --engine NAME`: what another engine changes for an experiment.
#include "launcher/command/engine_exchange.h"

#include <gmock/gmock.h>

#include "common/control_interface/ci_controller.h"
#include "common/plugin_descriptions/describe_builtins.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid
{
namespace
{

using testing::Contains;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

class CAnyController : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }
  void ControlStep() override {}
};
REGISTER_CONTROLLER(CAnyController, "engine_exchange_any")

EngineExchange Exchange(const std::string& from, const std::string& to, const std::vector<std::string>& sensors = {})
{
  DescribeBuiltins();
  const std::string text =
      test::ExperimentText{
          .controllers = test::Controller({.tag = "engine_exchange_any",
                                           .id = "c",
                                           .actuators = {"dummy_footbot_wheels", "dummy_footbot_turret"},
                                           .sensors = sensors}),
          .arena =
              "<footbot id='robot' position='1,1,0' controller='c'/>\n"
              "<cylindric_prey id='prey' position='2,2,0' radius='0.1' height='0.1' mass='1'/>",
          .engines = from}
          .Text();
  LoadedExperiment loaded = LoadExperimentText(text, "e.xml", "/");
  for (const Diagnostic& error : loaded.errors) ADD_FAILURE() << error.Text();
  return loaded.experiment ? ExchangeEngines(*loaded.experiment, loaded.places, to) : EngineExchange();
}

std::vector<std::string> TextsOf(const std::vector<Diagnostic>& diagnostics)
{
  std::vector<std::string> texts;
  for (const Diagnostic& diagnostic : diagnostics) texts.push_back(diagnostic.Text());
  return texts;
}

TEST(EngineExchange, NamesDevicesParametersAndEntitiesWithTheirPlaces)
{
  const EngineExchange exchange = Exchange("<dynamics2d id='e' restitution='0.5'/>", "kinematics2d");
  EXPECT_THAT(TextsOf(exchange.errors), IsEmpty());
  const std::vector<std::string> changes = TextsOf(exchange.changes);
  EXPECT_THAT(changes,
              Contains(HasSubstr("`footbot_turret`: locked while the gripper holds; with dynamics2d: turns a load")));
  EXPECT_THAT(changes, Contains(HasSubstr("'restitution' is no parameter of kinematics2d, and is left out")));
  EXPECT_THAT(changes, Contains(HasSubstr("the mass of the cylindric_prey 'prey' has no effect")));
  EXPECT_THAT(changes, Each(HasSubstr("e.xml:")));
  EXPECT_THAT(changes, Not(Contains(HasSubstr("footbot_gripper")))) << "no robot has one";
}

TEST(EngineExchange, NamesWhatTheOtherEngineRefuses)
{
  const EngineExchange exchange = Exchange("<dynamics2d id='e'/>", "kinematics2d", {"engine_footbot_accelerometer"});
  ASSERT_THAT(exchange.errors, SizeIs(1));
  EXPECT_THAT(exchange.errors[0].message, HasSubstr("footbot_accelerometer"));
}

TEST(EngineExchange, TheSameEngineChangesNothing)
{
  for (const char* engine : {"kinematics2d", "dummy_engine"})
    EXPECT_THAT(Exchange("<dummy_engine id='e'/>", engine).changes, IsEmpty());
}

}  // namespace
}  // namespace swarmanoid
