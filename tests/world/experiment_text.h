// The text of an experiment file, in which a test writes only what matters to it.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/experiment/load_experiment.h"

namespace swarmanoid::test
{

// Returns the elements of devices. A device is named by its implementation, and perhaps attributes after it:
// "generic_footbot_light noise_kind='none'". The tag is the implementation without its first word.
inline std::string Devices(const std::vector<std::string>& devices)
{
  std::string elements;
  for (const std::string& device : devices)
  {
    const std::size_t end = std::min(device.find(' '), device.size());
    const std::string implementation = device.substr(0, end);
    elements += "<" + implementation.substr(implementation.find('_') + 1) + " implementation='" + implementation + "'" +
                device.substr(end) + "/>";
  }
  return elements;
}

struct ControllerText
{
  std::string tag;
  std::string id = "c";
  std::vector<std::string> actuators{}, sensors{};
  std::string parameters{};  // content of <parameters>
  std::string attributes{};  // further attributes beside the id
};

inline std::string Controller(const ControllerText& controller)
{
  const auto element = [](const std::string& name, const std::string& content)
  { return content.empty() ? "" : "<" + name + ">" + content + "</" + name + ">"; };
  return "<" + controller.tag + " id='" + controller.id + "' " + controller.attributes + ">" +
         element("actuators", Devices(controller.actuators)) + element("sensors", Devices(controller.sensors)) +
         element("parameters", controller.parameters) + "</" + controller.tag + ">";
}

// The strings are the content of the elements with these names. An empty section is left out.
struct ExperimentText
{
  std::string framework{};
  std::string kinds{};
  std::string controllers{};
  std::string size = "10,10,3";
  std::string optimization = "2D";
  std::string arena{};
  std::string engines = "<dummy_engine id='e'/>";
  std::string physics = "<engine id='e'><all/></engine>";
  std::string functions{};
  std::string visualisations{};
  std::string faults{};

  // Each section but the framework begins a line, and so does the content of the arena.
  std::string Text() const
  {
    const auto section = [](const std::string& name, const std::string& content)
    { return content.empty() ? "" : "<" + name + ">" + content + "</" + name + ">\n"; };
    return "<ahss-config>" + (framework.empty() ? "\n" : section("framework", framework)) +
           section("entity_kinds", kinds) + section("controllers", controllers) + "<arena size='" + size +
           "' optimization='" + optimization + "'>\n" + arena + "\n</arena>\n" +
           (engines.empty() ? "" : section("engines", engines) + section("arena_physics", physics)) +
           section("experiment_functions", functions) + section("visualisations", visualisations) +
           section("faults", faults) + "</ahss-config>\n";
  }

  // Returns the experiment. If the text has mistakes, the test fails with them, and the result is null.
  std::unique_ptr<Experiment> Load(const std::string& folder = ".", const std::string& file = "test.xml",
                                   const LoadOptions& options = {}) const
  {
    LoadedExperiment loaded = LoadExperimentText(Text(), file, folder, options);
    for (const Diagnostic& error : loaded.errors) ADD_FAILURE() << error.Text() << "\n" << Text();
    return std::move(loaded.experiment);
  }
};

}  // namespace swarmanoid::test
