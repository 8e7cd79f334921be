// Every experiment function and every metric that the simulator ships, where there is nothing, or one thing, to look
// at.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "common/experiment/battery_model.h"
#include "common/experiment/schema.h"
#include "common/space/space.h"
#include "studies/metrics/recorder.h"
#include "tests/unit/every_plugin/small_scene.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

std::string Robot(const std::string& id = "robot")
{
  return EntityElement(EntityKind::kFootbot, id, kRobotX_m, kRobotY_m, "c");
}

std::string Nest(double x) { return EntityElement(EntityKind::kGroundPatch, "nest", x, kRobotY_m); }

std::string Prey(const std::string& id, double x)
{
  return EntityElement(EntityKind::kCylindricPrey, id, x, kRobotY_m);
}

// The parameters without a default of each experiment function, and the arenas in which it runs.
struct FunctionScenes
{
  std::string attributes;
  std::vector<std::string> arenas;
};

const std::map<std::string, FunctionScenes>& ScenesOfFunctions()
{
  static const std::string waiting = Waiting(EntityKind::kCylindricPrey, "prey");
  static const std::map<std::string, FunctionScenes> scenes = {
      {"drawn_swarm",
       {"",
        {"", Robot(), Robot() + EntityElement(EntityKind::kFootbot, "second", kFarX_m, 1),
         Waiting(EntityKind::kFootbot, "robot", "c")}}},
      {"prey_retrieval_goal",
       {" preys='prey' nest='nest'", {Nest(kFarX_m) + Prey("prey", 8), Robot() + Nest(kFarX_m) + Prey("prey", 8)}}},
      {"prey_supply",
       {" preys='prey' nest='nest' every='2'", {Nest(kFarX_m) + waiting, Robot() + Nest(kFarX_m) + waiting}}},
      {"two_bridges",
       {" wipe_at='2'",
        {"<floor_field id='trail'/>", "<floor_field id='trail'/>" + Robot(),
         "<floor_field id='trail'/>" + Waiting(EntityKind::kFootbot, "robot", "c")}}}};
  return scenes;
}

TEST(SimplestScenes, EachExperimentFunctionRunsAndDrawsWithAndWithoutARobot)
{
  RegisterEverything();
  const test::TemporaryFolder folder;
  for (const PluginDescription* functions : PluginCatalogue::Instance().Of(PluginKind::kExperimentFunctions))
  {
    const auto found = ScenesOfFunctions().find(functions->label);
    if (found == ScenesOfFunctions().end())
    {
      ADD_FAILURE() << "add the smallest scenes of the experiment functions '" << functions->label
                    << "' to ScenesOfFunctions";
      continue;
    }
    for (const std::string& arena : found->second.arenas)
    {
      SCOPED_TRACE(functions->label + " in " + arena);
      SmallScene scene;
      scene.arena = arena;
      scene.functions = fmt::format("<{} id='f'{}/>", functions->label, found->second.attributes);
      // Their drawings are made for a renderer that looks at each tick.
      scene.renderers = "<text_render id='v' file='v.txt'/>";
      const std::unique_ptr<Experiment> experiment = Read(scene);
      ASSERT_NE(experiment, nullptr);
      SimulatorOptions options;
      options.threads = 1;
      options.output_folder = folder.Path();
      RunScene(*experiment, options);
    }
  }
}

// The parameters without a default of each metric, and those of which it needs one.
const std::map<std::string, std::string>& ParametersOfMetrics()
{
  static const std::map<std::string, std::string> attributes = {{"time_to_region", " centre='4,4' radius='1'"},
                                                                {"in_region", " centre='4,4' radius='1'"},
                                                                {"attribute", " name='report'"},
                                                                {"published", " name='probe' by='controllers'"},
                                                                {"largest_cluster", " range='1'"},
                                                                {"coverage", " cell='1'"}};
  return attributes;
}

std::string MetricElement(const ElementSpec& metric)
{
  const auto given = ParametersOfMetrics().find(metric.Name());
  const std::string attributes = given == ParametersOfMetrics().end() ? "" : given->second;
  for (const ParameterSpec& parameter : metric.parameters)
    EXPECT_TRUE(parameter.default_value || parameter.name == "id" ||
                attributes.find(" " + parameter.name + "=") != std::string::npos)
        << "the parameter '" << parameter.name << "' of the metric <" << metric.Name()
        << "> has no default: add its value to ParametersOfMetrics";
  return fmt::format("<{0} id='{0}'{1}/>", metric.Name(), attributes);
}

// Measures a scene. A metric may refuse a scene without robots by a message, and so may that of published numbers if no
// robot makes a step.
void Measure(const ElementSpec& metric, const std::string& arena, bool has_steps = true)
{
  SCOPED_TRACE("metric " + metric.Name() + " in " + arena);
  const LoadedStudy loaded = LoadStudyText(
      "<study experiment='e.xml'><metrics every='1'>" + MetricElement(metric) + "</metrics></study>", "s.xml", ".");
  for (const Diagnostic& error : loaded.errors) ADD_FAILURE() << error.Text();
  if (loaded.study == nullptr) return;
  const PluginDescription* report = PluginCatalogue::Instance().Find(PluginKind::kActuator, "report", "generic_report");
  SmallScene scene;
  scene.devices.actuators.push_back(report);
  scene.devices.sensors.push_back(PluginCatalogue::Instance().Find(PluginKind::kSensor, "battery", kEnergyBattery));
  scene.arena = arena;
  const std::unique_ptr<Experiment> experiment = Read(scene);
  ASSERT_NE(experiment, nullptr);
  std::unique_ptr<Recorder> recorder;
  try
  {
    recorder = std::make_unique<Recorder>(*loaded.study, *experiment);
  }
  catch (const ConfigurationError& error)
  {
    EXPECT_TRUE(experiment->entities.empty()) << "it refuses a scene with a robot: " << error.what();
    EXPECT_NE(std::string(error.what()), "");
    return;
  }
  RunScene(*experiment, {}, [&](CSimulator& simulator) { recorder->Look(simulator); });
  try
  {
    const RunSamples samples = recorder->Take();
    EXPECT_EQ(samples.values.size(), samples.ticks.size() * MetricColumns(*loaded.study).size());
    for (const double value : samples.values) EXPECT_FALSE(std::isinf(value));
  }
  catch (const ConfigurationError& error)
  {
    EXPECT_TRUE(!has_steps && metric.Name() == "published") << error.what();
  }
}

TEST(SimplestScenes, EachMetricMeasuresOneRobotAndRefusesNone)
{
  RegisterEverything();
  for (const ElementSpec& metric : StudySchema().Child("metrics").children)
  {
    Measure(metric, "");
    Measure(metric, Robot());
    Measure(metric, Robot() + EntityElement(EntityKind::kFootbot, "second", kFarX_m, kRobotY_m, "c"));
    Measure(metric, Waiting(EntityKind::kFootbot, "robot", "c"), false);
  }
}

}  // namespace
}  // namespace swarmanoid
