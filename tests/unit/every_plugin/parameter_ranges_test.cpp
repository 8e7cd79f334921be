// Every number that an experiment or a study may give has a range, so that a slip of the pen is refused with its place
// and does not overflow somewhere later.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "common/experiment/load_experiment.h"
#include "common/experiment/schema.h"
#include "studies/design/study.h"
#include "tests/unit/every_plugin/small_scene.h"

namespace swarmanoid
{
namespace
{

void ExpectRanges(const std::string& owner, const std::vector<ParameterSpec>& parameters)
{
  for (const ParameterSpec& parameter : parameters)
  {
    const bool is_number = parameter.type == ParameterType::kInteger || parameter.type == ParameterType::kNumber ||
                           parameter.type == ParameterType::kVector2 || parameter.type == ParameterType::kVector3;
    if (!is_number) continue;
    EXPECT_TRUE(std::isfinite(parameter.minimum) && std::isfinite(parameter.maximum))
        << "the number '" << parameter.name << "' of " << owner << " has no range: give it a minimum and a maximum";
  }
}

void ExpectRangesBelow(const ElementSpec& element)
{
  ExpectRanges(element.tags.empty() ? "a plug-in" : "<" + element.Name() + ">", element.parameters);
  for (const ElementSpec& child : element.children) ExpectRangesBelow(child);
  for (const ElementSpec& plugin : element.plugin_element) ExpectRangesBelow(plugin);
}

TEST(ParameterRanges, EachNumberOfAPluginHasOne)
{
  RegisterEverything();
  for (const PluginKind kind : {PluginKind::kController, PluginKind::kActuator, PluginKind::kSensor,
                                PluginKind::kEngine, PluginKind::kRenderer, PluginKind::kExperimentFunctions})
    for (const PluginDescription* plugin : PluginCatalogue::Instance().Of(kind))
      ExpectRanges(NameOfPlugin(kind, plugin->label, plugin->implementation), plugin->parameters);
}

TEST(ParameterRanges, EachNumberOfExperimentsAndStudiesHasOne)
{
  RegisterEverything();
  ExpectRangesBelow(ExperimentSchema());
  ExpectRangesBelow(StudySchema());
}

std::string MistakesWith(const std::string& path, const std::string& value)
{
  RegisterEverything();
  LoadOptions options;
  options.settings = {{path, value}};
  std::string mistakes;
  for (const Diagnostic& error :
       LoadExperimentText("<ahss-config><framework><seed>1</seed></framework></ahss-config>", "e.xml", ".", options)
           .errors)
    mistakes += error.message + "\n";
  return mistakes;
}

TEST(ParameterRanges, AWholeNumberBeyondALimitIsRefusedHoweverNear)
{
  EXPECT_NE(MistakesWith("framework.seed", "9000000000000000001").find("9000000000000000001"), std::string::npos)
      << MistakesWith("framework.seed", "9000000000000000001");
  EXPECT_EQ(MistakesWith("framework.seed", "9000000000000000000").find("9000000000000000000"), std::string::npos);
}

}  // namespace
}  // namespace swarmanoid
