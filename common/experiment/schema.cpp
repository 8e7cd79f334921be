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
  element.description = "Settings of the run as a whole. It lasts maxclock ticks.";
  element.parameters = {
      {"clocktick", kInteger, "ms", "100",
       "The simulated time of one clock tick: the robots' control steps run once each tick.", 1, 3'600'000},
      {"ticks_per_second", kInteger, "1/s", "0",
       "In place of clocktick: the number of ticks in a second of simulated time, such as 30 or 60; 0: clocktick says "
       "it.",
       0, 1000},
      {"maxclock", kInteger, "ticks", "0",
       "The number of clock ticks after which the experiment ends; 0: it runs until it is stopped.", 0, 1e15},
      {"controller_path", kText, "", "",
       "Folders of controller libraries, separated by colons; a backslash at the end of a line continues it. Relative "
       "ones start at the folder of the experiment."},
      {"plugin_path", kText, "", "", "Folders of the libraries of other plug-ins, written like controller_path."},
      {"seed", kInteger, "", "1", "The seed of all random numbers: the same seed gives the same run, bit by bit.", 0,
       9e18},
      {"canonical_period", kInteger, "ticks", "100",
       "Ticks between two moments at which every engine drops what a saved state does not hold; checkpoints are "
       "possible at these. It is part of the result.",
       1, 1e9},
      {"ahead", kInteger, "ticks", "0",
       "Ticks from a control step to the one in which its commands act. 0: the same one. With 1 robots act on what "
       "they saw a tick before, and in a cluster controllers and engines work at the same time. It is part of the "
       "result.",
       0, 1},
      {"name", kText, "", "", "The name of the experiment; empty: the name of the file without its extension."},
      {"folder", kText, "", "", "The folder at which relative paths start; empty: the folder of the experiment file."},
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
      {"library", kText, "", "", "The library that registers it, looked for in plugin_path."},
      {"urdf", kText, "", "", "The URDF file of a robot on two wheels, in place of a library."},
  };
  element.plugin_element = {kind};
  return element;
}

ParameterSpec Library()
{
  return {"library", ParameterType::kText, "", "",
          "The library that registers it, looked for in plugin_path; empty: it is built in."};
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
          {"implementation", kText, "", std::nullopt, "The label of the implementation to use."},
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
          {"library", kText, "", "",
           "The library that holds it: x stands for libx.so or x.so in one of the folders of controller_path, or in "
           ".libs within it. Empty: the program itself holds it."},
          OneOf({"on_failure", kChoice, "", "abort",
                 "What comes of a robot whose controller throws or, in a cluster, crashes or does not return; abort: "
                 "the run ends; stop_robot: the robot stands still and is dark from then on; restart: its controller "
                 "is made again, with the state that it last had at a multiple of canonical_period."},
                {"abort", "stop_robot", "restart"}),
          {"time_budget_ms", kNumber, "ms", "0",
           "Processor time that one control step may take, otherwise the controller has failed; 0: any. Not with "
           "on_failure restart.",
           0, 1e6},
          {"parameters", kTree, "", "",
           "The parameters of the controller, given to its Init: those that it declared, or free content for one that "
           "declared none; what it never reads is refused."},
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
          {"subclock", kInteger, "", "1",
           "Steps of the engine in each clock tick: more find collisions more exactly and take longer.", 1, 10'000},
          {"split", kText, "", "1",
           "Regions that share the engine's work, each a process of its own in a cluster: a number (4), or columns and "
           "rows of a plane that is cut (2x2). It changes no bit of the results."},
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
      {"id", kText, "", std::nullopt,
       "An id, or a pattern: * stands for any characters, ? for one. fb_* are all that start with fb_."},
  };
  ElementSpec all;
  all.tags = {"all"};
  all.description = "All entities that the engine can simulate, or those of one kind.";
  all.repeatable = true;
  all.parameters = {
      {"kind", kText, "", "",
       "The tag of a kind (footbot, block …): only these; empty: all kinds that the engine knows."},
  };
  ElementSpec engine;
  engine.tags = {"engine"};
  engine.description = "The entities of one engine.";
  engine.repeatable = true;
  engine.parameters = {
      {"id", kText, "", std::nullopt, "The id of the engine."},
      {"volume", kText, "m", "",
       "The part of the space in which the engine moves entities, seen from above: x and y of the corners of a "
       "polygon; "
       "two corners are a rectangle. A semicolon separates polygons; one within another is a hole. Empty: everywhere."},
      Place({"heights", kVector2, "m", "-1e6, 1e6",
             "The heights (z) from and up to which the volume reaches. An entity is where its position is."})};
  engine.children = {entity, all};

  ElementSpec element;
  element.tags = {"arena_physics"};
  element.parameters = {
      OneOf({"outside", kChoice, "", "stop",
             "What happens to an entity that leaves the volumes of all engines that can move it: stop ends the "
             "run with an error that names it, keep leaves it to the engine that moved it."},
            {"stop", "keep"}),
  };
  element.description =
      "Which entities are in which engines. An entity may be in any number, zero included: the first engine of "
      "<engines> that "
      "lists it and whose volume has its position moves it, in the others it follows.";
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
          {"library", kText, "", "", "The library that registers them, looked for in plugin_path."},
      });
}

ElementSpec Faults()
{
  using enum ParameterType;
  ElementSpec fault;
  fault.tags = {"fault"};
  fault.description = "A fault of some robots. Faults of one device act in the order of the file.";
  fault.repeatable = true;
  fault.parameters = {
      Id("The name of the fault, in the log of events and for its random numbers; unique among the faults."),
      {"entities", kText, "", "*",
       "The robots: an id, or a pattern: * stands for any characters, ? for one. Only robots with the device count."},
      {"share", kNumber, "", "1",
       "The share of these robots that has the fault, drawn at random. A larger share includes the robots of a smaller "
       "one.",
       0, 1},
      {"from", kInteger, "ticks", "0", "The first tick of the fault.", 0, 1e15},
      {"to", kInteger, "ticks", "0", "The first tick after the fault; 0: it lasts to the end of the run.", 0, 1e15},
      {"device", kText, "", "all", "The tag of a sensor or actuator, or all."},
      OneOf({"side", kChoice, "", "both", "Which of them, for a tag that is both: a radio, range and bearing."},
            {"both", "sensor", "actuator"}),
      OneOf({"kind", kChoice, "", std::nullopt,
             "dead: numbers are 0 and lists empty; stuck: numbers stay; scale, bias and noise: numbers are multiplied "
             "by value, increased by it, or disturbed with this deviation; delay: value is the number of ticks; drop: "
             "value is the probability that the device misses a tick, or an entry of a list; off: the robot is "
             "switched off."},
            {"dead", "stuck", "scale", "bias", "noise", "delay", "drop", "off"}),
      Within({"value", kNumber, "", "0", "See kind. Not for dead, stuck and off."}, -1e6, 1e6),
  };
  ElementSpec element;
  element.tags = {"faults"};
  element.description = "Faults of the devices of robots, between the devices and the controllers.";
  element.children = {fault};
  return element;
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
        root.children = {Framework(),    EntityKinds(),    Controllers(),         Arena(), Engines(),
                         ArenaPhysics(), Visualisations(), ExperimentFunctions(), Faults()};
        return root;
      });
}

}  // namespace swarmanoid
