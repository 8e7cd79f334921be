// docs/plugin_reference.md is generated from the tables of all plug-ins, those of the shipped controllers, kinds of
// entities and experiment functions too; no engine, device or renderer is needed. After a change of one, write it
// again:
//   SWARMANOID_WRITE_REFERENCE=1 build/bin/tests/unit_launcher --gtest_filter='PluginReference.*'
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "common/experiment/load_experiment.h"
#include "common/experiment/reference.h"
#include "common/plugin_descriptions/describe_builtins.h"
#include "common/plugins/plugin_library.h"
#include "launcher/plugin_text.h"
#include "simulation/register_all.h"
#include "test_folders.h"

namespace swarmanoid
{
namespace
{

void LoadAllPlugins()
{
  DescribeBuiltins();
  namespace fs = std::filesystem;
  const std::vector<std::string> folders = {SWARMANOID_BUILD_FOLDER "/lib/swarmanoid"};
  EXPECT_EQ(LoadPluginLibrary("ros2_controller", folders).error, "");
  for (const char* folder : {"controllers", "entities", "functions"})
    for (const auto& entry : fs::directory_iterator(fs::path(SWARMANOID_SOURCE_FOLDER) / "user" / folder))
    {
      const PluginLibrary& library = LoadPluginLibrary(entry.path().filename().string(), folders);
      EXPECT_EQ(library.error, "");
    }
}

TEST(PluginReference, TheCommittedPageIsThatOfTheTables)
{
  LoadAllPlugins();
  const std::string generated = PluginReference();
  const std::string path = SWARMANOID_SOURCE_FOLDER "/docs/plugin_reference.md";
  if (std::getenv("SWARMANOID_WRITE_REFERENCE") != nullptr) std::ofstream(path) << generated;
  std::ifstream file(path);
  const std::string committed{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  EXPECT_TRUE(committed == generated) << path << " is not up to date";
}

PluginDescription ARenderer()
{
  PluginDescription plugin;
  plugin.label = "plan_render";
  plugin.brief = "draws\ta plan";
  plugin.parameters = {{"every", ParameterType::kInteger, "ticks", "1", "Ticks between two plans.", 1, 1000},
                       {"file", ParameterType::kPath, "", std::nullopt, "The file.",
                        -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}};
  ParameterSpec format{"format", ParameterType::kChoice, "", "svg", "Its form."};
  format.choices = {"svg", "pdf"};
  plugin.parameters.push_back(format);
  return plugin;
}

TEST(PluginText, RowsOfProgramsHaveElevenFields)
{
  EXPECT_EQ(PluginRows(PluginKind::kRenderer, ARenderer()),
            "visualisation\tplan_render\t\t\t\t\t\t\t\t\tdraws a plan\n"
            "visualisation\tplan_render\t\tevery\twhole number\tticks\t1\t1\t1000\t\tTicks between two plans.\n"
            "visualisation\tplan_render\t\tfile\tfile name\t\trequired\t\t\t\tThe file.\n"
            "visualisation\tplan_render\t\tformat\tchoice\t\tsvg\t\t\tsvg, pdf\tIts form.\n");
}

TEST(PluginText, ObjectsOfProgramsHaveWhatIsKnown)
{
  const nlohmann::json json = PluginJson(PluginKind::kRenderer, ARenderer());
  EXPECT_EQ(json["kind"], "visualisation");
  EXPECT_EQ(json["label"], "plan_render");
  EXPECT_EQ(json["implementation"], "");
  EXPECT_FALSE(json.contains("columns"));
  EXPECT_EQ(json["parameters"][0], nlohmann::json::parse(R"({"name": "every", "type": "whole number", "unit": "ticks",
              "description": "Ticks between two plans.", "default": "1", "minimum": 1.0, "maximum": 1000.0})"));
  EXPECT_FALSE(json["parameters"][1].contains("default"));
  EXPECT_FALSE(json["parameters"][1].contains("minimum"));
  EXPECT_FALSE(json["parameters"][1].contains("maximum"));
  EXPECT_EQ(json["parameters"][2]["choices"], nlohmann::json({"svg", "pdf"}));
}

TEST(PluginText, PeopleReadATableOfParameters)
{
  PluginDescription plugin = ARenderer();
  plugin.brief = "draws a plan";
  EXPECT_EQ(PluginDetails(PluginKind::kRenderer, plugin),
            "visualisation plan_render\n  draws a plan\n"
            "    parameter  type          unit   default   range                 meaning\n"
            "    every      whole number  ticks  1         from 1 to 1000 ticks  Ticks between two plans.\n"
            "    file       file name            required                        The file.\n"
            "    format     svg, pdf             svg                             Its form.\n");
  plugin.parameters.clear();
  EXPECT_EQ(PluginDetails(PluginKind::kRenderer, plugin),
            "visualisation plan_render\n  draws a plan\n  no parameters\n");
  plugin.declares_parameters = false;
  EXPECT_EQ(PluginDetails(PluginKind::kRenderer, plugin),
            "visualisation plan_render\n  draws a plan\n  it declares no parameters: what its Init asks for decides\n");
  PluginDescription device;
  device.label = "my_sensor";
  device.implementation = "fast_my_sensor";
  device.brief = "senses";
  device.robots = {"footbot", "eyebot"};
  device.channel = "my_channel";
  EXPECT_EQ(PluginDetails(PluginKind::kSensor, device),
            "sensor my_sensor / fast_my_sensor\n  senses\n  for footbot, eyebot\n  needs my_channel of the engine\n"
            "  no parameters\n");
  EXPECT_EQ(PluginName(device), "my_sensor / fast_my_sensor");
  EXPECT_EQ(PluginName(plugin), "plan_render");
  PluginDescription engine;
  engine.label = "my_engine";
  engine.brief = "moves";
  engine.entity_tags = {"footbot"};
  engine.channels = {"a", "b"};
  EXPECT_EQ(PluginDetails(PluginKind::kEngine, engine),
            "physics engine my_engine\n  moves\n  simulates footbot\n  offers a, b\n  no parameters\n");
}

TEST(PluginText, ColumnsOfDevicesHaveNamesAndUnits)
{
  RegisterBuiltins();  // columns are those of the devices' code
  const PluginDescription* wheels =
      PluginCatalogue::Instance().Find(PluginKind::kActuator, "footbot_wheels", "dummy_footbot_wheels");
  const PluginDescription* proximity =
      PluginCatalogue::Instance().Find(PluginKind::kSensor, "footbot_proximity", "generic_footbot_proximity");
  ASSERT_TRUE(wheels != nullptr && proximity != nullptr);
  EXPECT_NE(PluginDetails(PluginKind::kActuator, *wheels).find("  takes left"), std::string::npos)
      << PluginDetails(PluginKind::kActuator, *wheels);
  const nlohmann::json left = PluginJson(PluginKind::kActuator, *wheels)["columns"][0];
  EXPECT_EQ(left["name"], "left");
  EXPECT_FALSE(left.contains("count"));
  EXPECT_NE(PluginDetails(PluginKind::kSensor, *proximity).find("0 … 23"), std::string::npos)
      << PluginDetails(PluginKind::kSensor, *proximity);
  EXPECT_EQ(PluginJson(PluginKind::kSensor, *proximity)["columns"][0]["count"], 24);
}

TEST(PluginText, TitlesAreOfSeveral)
{
  EXPECT_EQ(PluginKindTitle(PluginKind::kController), "Controllers");
  EXPECT_EQ(PluginKindTitle(PluginKind::kEngine), "Physics engines");
  EXPECT_EQ(PluginKindTitle(PluginKind::kExperimentFunctions), "Experiment functions");
}

TEST(PluginText, SettingsArePathsWithValueChoiceAndMeaning)
{
  DescribeBuiltins();
  const auto experiment = LoadExperimentFile(SWARMANOID_SOURCE_FOLDER "/configs/diffusion_10.xml").experiment;
  ASSERT_NE(experiment, nullptr);
  const nlohmann::json settings = SettingsJson(*experiment);
  std::map<std::string, nlohmann::json> by_path;
  for (const nlohmann::json& setting : settings) by_path[setting["path"]] = setting;
  EXPECT_EQ(by_path.size(), settings.size()) << "each path once";
  ASSERT_TRUE(by_path.contains("framework.seed"));
  EXPECT_EQ(by_path["framework.seed"]["value"], std::to_string(experiment->seed));
  EXPECT_NE(by_path["framework.seed"]["allowed"], "");
  EXPECT_NE(by_path["framework.seed"]["description"], "");
  const auto has = [&](const std::string& start)
  { return std::ranges::any_of(by_path, [&](const auto& setting) { return setting.first.starts_with(start); }); };
  EXPECT_TRUE(has("controllers.diffusion.actuators.footbot_wheels."));
  EXPECT_TRUE(has("controllers.diffusion.sensors."));
  EXPECT_TRUE(has("controllers.diffusion.parameters."));
  for (const EngineConfiguration& engine : experiment->engines)
    EXPECT_TRUE(has("engines." + engine.id + ".")) << engine.id;
  EXPECT_FALSE(has("arena."));
  EXPECT_FALSE(by_path.contains("engines." + experiment->engines.front().id + ".id"));
  const std::string row = SettingRows(*experiment).substr(0, SettingRows(*experiment).find('\n'));
  EXPECT_EQ(std::ranges::count(row, '\t'), 2) << row;
}

}  // namespace
}  // namespace swarmanoid
