#include "common/experiment/schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "common/experiment/schema_parts.h"

namespace swarmanoid
{
namespace
{

ElementSpec Framework()
{
  using enum ParameterType;
  ElementSpec element;
  element.tags = {"framework"};
  element.description = "Settings of the run as a whole. It lasts clocktick times maxclock milliseconds.";
  element.parameters = {
      InRange(Optional(kInteger, "clocktick", "ms", "100",
                       "The simulated time of one clock tick: the robots' control steps run once each tick."),
              1, 3'600'000),
      InRange(Optional(kInteger, "maxclock", "ticks", "0",
                       "The number of clock ticks after which the experiment ends; 0: it runs until it is stopped."),
              0, 1e15),
      Optional(kText, "controller_path", "", "",
               "Folders of controller libraries, separated by colons; a backslash at the end of a line continues it. "
               "Relative ones start at the folder of the experiment."),
      Optional(kText, "plugin_path", "", "",
               "Folders of the libraries of other plug-ins, written like controller_path."),
      InRange(Optional(kInteger, "seed", "", "1",
                       "The seed of all random numbers: the same seed gives the same run, bit by bit."),
              0, 9e18),
      InRange(Optional(kInteger, "canonical_period", "ticks", "100",
                       "Ticks between two moments at which every engine drops what a saved state does not hold; "
                       "checkpoints are possible at these. It is part of the result."),
              1, 1e9),
      InRange(Optional(kInteger, "ahead", "ticks", "0",
                       "Ticks from a control step to the one in which its commands act. 0: the same one. With 1 robots "
                       "act on what they saw a tick before, and in a cluster controllers and engines work at the same "
                       "time. It is part of the result."),
              0, 1),
      Optional(kText, "name", "", "", "The name of the experiment; empty: the name of the file without its extension."),
      Optional(kText, "folder", "", "",
               "The folder at which relative paths start; empty: the folder of the experiment file."),
  };
  return element;
}

ElementSpec EntityKinds()
{
  using enum ParameterType;
  ElementSpec element;
  element.tags = {"entity_kinds"};
  element.description =
      "Kinds of robots and objects that libraries of users, or URDF files, add to those of the simulator.";
  element.plugins = PluginKind::kEntityKind;
  ElementSpec kind;
  kind.description = "One kind: its tag is that of its entities in <arena>.";
  kind.parameters = {
      Optional(kText, "library", "", "", "The library that registers it, looked for in plugin_path."),
      Optional(kText, "urdf", "", "", "The URDF file of a robot on two wheels, in place of a library."),
  };
  element.plugin_element = {kind};
  return element;
}

ParameterSpec Library()
{
  return Optional(ParameterType::kText, "library", "", "",
                  "The library that registers it, looked for in plugin_path; empty: it is built in.");
}

// Returns the element for a list of plug-ins of one kind. Each plug-in has its own tag; `plugin_element` holds their
// common parameters.
ElementSpec PluginList(const char* tag, PluginKind kind, const char* description, std::string of_each,
                       std::vector<ParameterSpec> parameters)
{
  ElementSpec element;
  element.tags = {tag};
  element.description = description;
  element.plugins = kind;
  ElementSpec each;
  each.description = std::move(of_each);
  each.parameters = std::move(parameters);
  element.plugin_element = {each};
  return element;
}

ElementSpec DeviceList(const char* tag, PluginKind kind, const char* description)
{
  using enum ParameterType;
  return PluginList(
      tag, kind, description,
      fmt::format("One {}: its tag is the type. Its implementation decides which further parameters it has.",
                  PluginKindName(kind)),
      {
          Required(kText, "implementation", "", "The label of the implementation to use."),
          Library(),
      });
}

ElementSpec Controllers()
{
  using enum ParameterType;
  ElementSpec element = PluginList(
      "controllers", PluginKind::kController,
      "The controllers of the robots. The same controller may stand here several times with different ids and "
      "parameters.",
      "One controller: its tag is the label under which REGISTER_CONTROLLER made it known.",
      {
          Id("The name by which robots refer to it; unique among the controllers."),
          Optional(
              kText, "library", "", "",
              "The library that holds it: x stands for libx.so or x.so in one of the folders of controller_path, or "
              "in .libs "
              "within it. Empty: the program itself holds it."),
          OneOf(Optional(kChoice, "on_failure", "", "abort",
                         "What comes of a robot whose controller throws or, in a cluster, crashes or does not return; "
                         "abort: the run ends; stop_robot: the robot stands still and is dark from then on; restart: "
                         "its controller is made anew, with the state that it last had at a multiple of "
                         "canonical_period."),
                {"abort", "stop_robot", "restart"}),
          InRange(Optional(kNumber, "time_budget_ms", "ms", "0",
                           "Processor time that one control step may take, otherwise the controller has failed; 0: "
                           "any. Not with on_failure restart."),
                  0, 1e6),
          Optional(kTree, "parameters", "", "",
                   "The parameters of the controller, given to its Init: those that it declared, or free content for "
                   "one that "
                   "declared none; what it never reads is refused."),
      });
  element.plugin_element[0].children = {
      DeviceList("actuators", PluginKind::kActuator, "The actuators that the controller may use; no other ones exist."),
      DeviceList("sensors", PluginKind::kSensor, "The sensors that the controller may use; no other ones exist."),
  };
  return element;
}

ElementSpec Engines()
{
  using enum ParameterType;
  return PluginList(
      "engines", PluginKind::kEngine, "The physics engines. Each is a closed world and, in a cluster, a process.",
      "One engine: its tag is its type, which decides which further parameters it has.",
      {
          Id("The name by which <arena_physics> refers to it; unique among the engines."),
          InRange(
              Optional(kInteger, "subclock", "", "1",
                       "Steps of the engine in each clock tick: more find collisions more exactly and take longer."),
              1, 10'000),
          Optional(kText, "split", "", "1",
                   "Regions into which a plane is cut, each computed by a process of its own in a cluster: a number "
                   "(4), or columns and rows (2x2). It changes no bit of the results."),
          Library(),
      });
}

ElementSpec ArenaPhysics()
{
  using enum ParameterType;
  ElementSpec entity;
  entity.tags = {"entity"};
  entity.description = "Entities of the engine, by id.";
  entity.repeatable = true;
  entity.parameters = {
      Required(kText, "id", "",
               "An id, or a pattern: * stands for any characters, ? for one. fb_* are all that start with fb_."),
  };
  ElementSpec all;
  all.tags = {"all"};
  all.description = "All entities that the engine can simulate, or those of one kind.";
  all.repeatable = true;
  all.parameters = {
      Optional(kText, "kind", "", "",
               "The tag of a kind (footbot, block …): only these; empty: all kinds that the engine knows."),
  };
  ElementSpec engine;
  engine.tags = {"engine"};
  engine.description = "The entities of one engine.";
  engine.repeatable = true;
  engine.parameters = {Required(kText, "id", "", "The id of the engine.")};
  engine.children = {entity, all};

  ElementSpec element;
  element.tags = {"arena_physics"};
  element.description =
      "Which entities are in which engines. An entity may be in any number, zero included: the first engine of "
      "<engines> that "
      "lists it moves it, in the others it follows.";
  element.children = {engine};
  return element;
}

ElementSpec Visualisations()
{
  return PluginList("visualisations", PluginKind::kRenderer,
                    "What shows or records the experiment. The run waits for each of them at every tick.",
                    "One visualisation: its tag is its type, which decides which further parameters it has.",
                    {
                        Id("The name of the visualisation; unique among them."),
                        Library(),
                    });
}

ElementSpec ExperimentFunctions()
{
  using enum ParameterType;
  return PluginList(
      "experiment_functions", PluginKind::kExperimentFunctions,
      "Code around the steps of the experiment, run by the space server: it measures, changes the world, and decides "
      "when the experiment is over.",
      "One set of functions: its tag is the one they are registered with.",
      {
          Id("The name of the functions; unique among them."),
          Optional(kText, "library", "", "", "The library that registers them, looked for in plugin_path."),
      });
}

}  // namespace

bool ElementSpec::HasTag(const std::string& tag) const
{
  return std::find(tags.begin(), tags.end(), tag) != tags.end();
}

const ElementSpec* ElementSpec::FindChild(const std::string& tag) const
{
  for (const ElementSpec& child : children)
  {
    if (child.HasTag(tag)) return &child;
  }
  return nullptr;
}

const ElementSpec& ElementSpec::Child(const std::string& tag) const
{
  if (const ElementSpec* child = FindChild(tag)) return *child;
  throw std::logic_error("no element <" + tag + "> in the table of <" + (tags.empty() ? "a plug-in" : Name()) + ">");
}

const ElementSpec& ExperimentSchema()
{
  static PerTable<ElementSpec> schema;
  return schema.Get(
      []
      {
        ElementSpec root;
        root.tags = {"ahss-config"};
        root.description = "An experiment.";
        root.required = true;
        root.children = {Framework(), EntityKinds(),  Controllers(),    Arena(),
                         Engines(),   ArenaPhysics(), Visualisations(), ExperimentFunctions()};
        return root;
      });
}

}  // namespace swarmanoid
