// Parameters of controllers and experiment functions that declared them are checked with the file, and complete in the
// experiment.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "common/configuration/xml_reader.h"
#include "common/experiment/element_form.h"
#include "common/plugins/script_parameters.h"
#include "tests/unit/experiment/fake_plugins.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid::test
{
namespace
{

using testing::HasSubstr;
using testing::MatchesRegex;

std::string File(const std::string& parameters, const std::string& functions = "")
{
  static const bool once = []
  {
    PluginCatalogue::Instance().Add(
        PluginKind::kController,
        {.label = "declared_walker",
         .parameters = {{.name = "velocity", .unit = "m/s", .default_value = "0.1", .minimum = 0, .maximum = 0.3},
                        {.name = "target", .type = ParameterType::kVector2},
                        {.name = "weights", .type = ParameterType::kPath, .default_value = ""}}});
    PluginCatalogue::Instance().Add(PluginKind::kExperimentFunctions, {.label = "declared_functions",
                                                                       .parameters = {{.name = "every",
                                                                                       .type = ParameterType::kInteger,
                                                                                       .unit = "ticks",
                                                                                       .default_value = "20",
                                                                                       .minimum = 1}}});
    return true;
  }();
  static_cast<void>(once);
  return ExperimentText{.controllers = "<declared_walker id='w'>" + parameters + "</declared_walker>",
                        .engines = "",
                        .functions = functions}
      .Text();
}

constexpr const char* kGoodParameters = "<parameters><target>1, 2</target></parameters>";

LoadOptions With(const std::string& path, const std::string& value)
{
  LoadOptions options;
  options.settings = {{path, value}};
  return options;
}

TEST(ControllerParameters, AreCompleteInTheExperiment)
{
  const auto loaded = LoadText(File("<parameters target='1, 2' weights='net.txt'/>", "<declared_functions id='f'/>"));
  ASSERT_TRUE(loaded.experiment) << ErrorsOf(File(kGoodParameters));
  const TConfigurationTree& tree = loaded.experiment->controllers.at(0).parameters;
  EXPECT_EQ(tree.GetNumber("velocity"), 0.1);
  EXPECT_EQ(tree.GetVector2("target"), Vector2(1, 2));
  EXPECT_EQ(tree.GetText("weights"), "/experiments/net.txt");
  EXPECT_EQ(loaded.experiment->functions.at(0).tree.GetInteger("every"), 20);
  // A reader of this text adds the defaults itself.
  EXPECT_EQ(loaded.experiment->effective_xml.find("velocity"), std::string::npos);
}

TEST(ControllerParameters, MistakesInThemAreMistakesOfTheFile)
{
  EXPECT_EQ(ErrorsOf(File("<parameters target='1, 2'><velocty>0.2</velocty></parameters>")),
            "test.xml:2:64: the controller <declared_walker> has no parameter 'velocty'; it has: velocity, target, "
            "weights; did you mean 'velocity'?\n");
  EXPECT_EQ(ErrorsOf(File("<parameters target='1, 2'><velocity>0.5</velocity></parameters>")),
            "test.xml:2:64: 'velocity' of the controller <declared_walker> is 0.5 m/s; it must be from 0 to 0.3 m/s\n");
}

TEST(ControllerParameters, RequiredOnesAreMissedWithoutTheElement)
{
  EXPECT_EQ(ErrorsOf(File("")),
            "test.xml:2:14: the controller <declared_walker> lacks the parameter 'target': two numbers \"x, y\"\n");
}

TEST(ControllerParameters, AreSetFromTheCommandLine)
{
  const auto changed = LoadText(File(kGoodParameters), With("controllers.w.parameters.velocity", "0.2"));
  ASSERT_TRUE(changed.experiment);
  EXPECT_EQ(changed.experiment->controllers.at(0).parameters.GetNumber("velocity"), 0.2);
  EXPECT_EQ(ErrorsOf(File(""), With("controllers.w.parameters.target", "1, 2")), "");
  EXPECT_EQ(ErrorsOf(File(kGoodParameters), With("controllers.w.parameters.target_distnce", "0.5")),
            "--set controllers.w.parameters.target_distnce: the controller <declared_walker> has no parameter "
            "'target_distnce'; it has: velocity, target, weights; did you mean 'target'?\n");
  EXPECT_EQ(
      ErrorsOf(File(kGoodParameters), With("controllers.w.parameters.velocity", "fast")),
      "--set controllers.w.parameters.velocity: 'velocity' of the controller <declared_walker> is 'fast'; it must "
      "be a number in m/s, from 0 to 0.3 m/s\n");
}

TEST(ControllerParameters, ThoseOfFunctionsLikewise)
{
  EXPECT_EQ(ErrorsOf(File(kGoodParameters, "<declared_functions id='f'><evry>5</evry></declared_functions>")),
            "test.xml:6:50: <declared_functions> has no element <evry>; allowed: id, library, every; did you mean "
            "'every'?\n");
  EXPECT_EQ(ErrorsOf(File(kGoodParameters, "<declared_functions id='f'/>"), With("experiment_functions.f.every", "0")),
            "--set experiment_functions.f.every: 'every' of <declared_functions> is 0 ticks; it must be at least 1 "
            "ticks\n");
  const auto changed =
      LoadText(File(kGoodParameters, "<declared_functions id='f'/>"), With("experiment_functions.f.every", "7"));
  ASSERT_TRUE(changed.experiment);
  EXPECT_EQ(changed.experiment->functions.at(0).tree.GetInteger("every"), 7);
}

TEST(ControllerParameters, OfAControllerThatDeclaresNothingAreLeftToIt)
{
  EXPECT_EQ(ErrorsOf(kChapter4, With("controllers.fc.parameters.anything", "x")), "");
}

const ConfigurationNode* ChildOf(const ConfigurationNode& element, const std::string& name)
{
  const auto found = std::ranges::find(element.children, name, [](const auto& child) { return child->name; });
  return found == element.children.end() ? nullptr : found->get();
}

// The script "good.lua" declares a speed, and "bad.lua" has a mistake.
std::vector<ParameterSpec> DeclaredIn(const TConfigurationTree& parameters, const std::string& folder)
{
  const std::string script = parameters.Value("script").value_or("");
  if (script == "bad.lua") throw ConfigurationError(parameters.ValueLocation("script"), "bad.lua:7: no Lua");
  EXPECT_EQ(folder, "/experiments");
  return {{.name = "speed", .unit = "m/s", .default_value = "0.1", .minimum = 0, .maximum = 0.3}};
}

TEST(ControllerParameters, AScriptDeclaresMoreOfThem)
{
  RegisterFakePlugins();
  PluginCatalogue::Instance().Add(
      PluginKind::kController, {.label = "scripted", .parameters = {{.name = "script", .type = ParameterType::kPath}}});
  ScriptParameters::Instance().Add("scripted", DeclaredIn);
  const auto file = [](const std::string& parameters)
  {
    return ExperimentText{.controllers = "<scripted id='s'><parameters " + parameters + "/></scripted>", .engines = ""}
        .Text();
  };

  const LoadedExperiment loaded = LoadText(file("script='good.lua'"));
  ASSERT_TRUE(loaded.errors.empty()) << loaded.errors.front().Text();
  const TConfigurationTree& tree = loaded.experiment->controllers.at(0).parameters;
  EXPECT_EQ(tree.GetNumber("speed"), 0.1);
  EXPECT_EQ(tree.GetText("script"), "/experiments/good.lua");
  EXPECT_THAT(ErrorsOf(file("script='good.lua' speed='0.5'")),
              HasSubstr("'speed' of the controller <scripted> is 0.5 m/s"));
  EXPECT_THAT(ErrorsOf(file("script='good.lua' sped='0.2'")),
              HasSubstr("it has: script, speed; did you mean 'speed'?"));

  // The editor's form of <parameters> has them, too. A mistake of the script leaves those of the table.
  for (const auto& [script, names] :
       std::map<std::string, std::vector<std::string>>{{"good.lua", {"script", "speed"}}, {"bad.lua", {"script"}}})
  {
    const auto root = ReadXml(file("script='" + script + "'"), "/experiments/test.xml");
    std::vector<const ConfigurationNode*> path{root.get()};
    for (const char* name : {"controllers", "scripted", "parameters"}) path.push_back(ChildOf(*path.back(), name));
    std::vector<std::string> offered;
    for (const ParameterSpec& parameter : FormOf(path).parameters) offered.push_back(parameter.name);
    EXPECT_EQ(offered, names) << script;
  }
  EXPECT_THAT(ErrorsOf(file("script='bad.lua' sped='0.2'")),
              MatchesRegex("test.xml:[0-9]+:[0-9]+: bad.lua:7: no Lua\n"));
}

}  // namespace
}  // namespace swarmanoid::test
