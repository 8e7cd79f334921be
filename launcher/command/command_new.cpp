// `swarmanoid new`: makes user directories, and in them plug-ins of each kind with experiments.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "common/errors/exit_codes.h"
#include "launcher/command/sub_command.h"
#include "launcher/templates/new_files.h"

namespace swarmanoid
{
namespace
{

constexpr const char* kNameRule = ": small letters, digits and '_'";

void AddBehaviorController(CLI::App& verb, int& exit_code)
{
  auto names = std::make_shared<BehaviorControllerNames>();
  CLI::App* command = verb.add_subcommand(
      "behavior-controller", "A controller made of behaviours, its root behaviour, and an experiment with it");
  command->add_option("NAME", names->name, std::string("Name of the controller") + kNameRule)->required();
  command->add_option("--robot", names->robot, "footbot, handbot or eyebot")->capture_default_str();
  command->add_option("--class", names->class_name, "Class of the controller (default: CName)");
  command->add_option("--behavior", names->behavior,
                      "Files of the root behaviour, without ending (default: bt_ROBOT_NAME)");
  command->add_option("--behavior-class", names->behavior_class, "Class of the root behaviour (default: CBTRobotName)");
  command->add_flag("!--no-experiment", names->experiment, "Make no experiment file");
  command->footer("Example:\n  swarmanoid new behavior-controller sky_watch --robot eyebot");
  command->callback(
      [names, &exit_code]
      {
        NewBehaviorController(*names);
        exit_code = kExitDone;
      });
}

void AddBehavior(CLI::App& verb, int& exit_code)
{
  auto names = std::make_shared<BehaviorNames>();
  CLI::App* command = verb.add_subcommand("behavior", "A behaviour, in the folder of a behaviour controller");
  command->add_option("NAME", names->name, std::string("Its files, without ending") + kNameRule)->required();
  command->add_option("--class", names->class_name, "Its class (default: CBTName)");
  command->add_option("--controller", names->controller,
                      "The behaviour controller that it is for (default: the one in this folder)");
  command->add_option("--robot", names->robot, "The robot that it is for; it is that of the controller in any case");
  command->footer("Example:\n  swarmanoid new behavior bt_footbot_stop --controller wall_follower");
  command->callback(
      [names, &exit_code]
      {
        NewBehavior(*names);
        exit_code = kExitDone;
      });
}

void AddTerrain(CLI::App& verb, int& exit_code)
{
  struct Options
  {
    std::string name;
    std::vector<double> size{2, 2};
    RoughTerrain terrain;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command =
      verb.add_subcommand("terrain", "Rough ground with holes (an OctoMap file), and an experiment on it");
  command->add_option("NAME", options->name, std::string("Name of the terrain") + kNameRule)->required();
  RoughTerrain& terrain = options->terrain;
  command->add_option("--size", options->size, "X,Y: edges in metres")
      ->delimiter(',')
      ->expected(2)
      ->capture_default_str();
  command
      ->add_option("--resolution", terrain.resolution,
                   "Edge of a cell in metres: the height of the steps that wheels meet")
      ->capture_default_str();
  command->add_option("--roughness", terrain.roughness, "From the lowest ground to the highest, in metres")
      ->capture_default_str();
  command->add_option("--holes", terrain.holes, "Number of round holes")->capture_default_str();
  command->add_option("--depth", terrain.depth, "Of the holes, in metres")->capture_default_str();
  command->add_option("--seed", terrain.seed, "The same seed and numbers make the same file")->capture_default_str();
  command->footer(
      "Examples:\n"
      "  swarmanoid new terrain moor\n"
      "  swarmanoid new terrain moon --size 4,3 --resolution 0.01 --roughness 0.08 --holes 10 --seed 7");
  command->callback(
      [options, &exit_code]
      {
        options->terrain.size = {options->size[0], options->size[1]};
        NewTerrain(options->name, options->terrain);
        exit_code = kExitDone;
      });
}

void AddNewCommand(CLI::App& app, int& exit_code)
{
  CLI::App* verb = app.add_subcommand("new", "Make a user directory, and controllers and experiments to start from");
  verb->footer(
      "Examples:\n"
      "  swarmanoid new user my_robots && cd my_robots\n"
      "  swarmanoid new behavior-controller wall_follower\n"
      "  swarmanoid new controller from_scratch\n"
      "  swarmanoid new lua avoid\n"
      "  swarmanoid new python evade\n"
      "  swarmanoid new device compass\n"
      "  swarmanoid new entity rover\n"
      "  swarmanoid new engine gliding\n"
      "  swarmanoid new renderer plan\n"
      "  swarmanoid new terrain moor --size 3,2 --seed 7\n"
      "  swarmanoid new experiment first_try");

  auto name = std::make_shared<std::string>();
  const auto add = [&](const char* what, const char* about, const char* argument, const std::string& argument_about,
                       const char* example, void (*make)(const std::string&))
  {
    CLI::App* command = verb->add_subcommand(what, about);
    command->add_option(argument, *name, argument_about)->required();
    command->footer(std::string("Example:\n  swarmanoid new ") + example);
    command->callback(
        [name, make, &exit_code]
        {
          make(*name);
          exit_code = kExitDone;
        });
  };
  add("user", "A directory for your own controllers and experiments", "DIRECTORY", "The directory to make",
      "user my_robots", NewUserDirectory);
  AddBehaviorController(*verb, exit_code);
  AddBehavior(*verb, exit_code);
  AddTerrain(*verb, exit_code);
  add("controller", "A footbot controller in one class, and an experiment with it", "NAME",
      std::string("Name of the controller") + kNameRule, "controller wall_follower", NewController);
  add("lua", "A foot-bot controller in Lua, and an experiment with it", "NAME",
      std::string("Name of the controller") + kNameRule, "lua avoid", NewLua);
  add("python", "A foot-bot controller in Python, and an experiment with it", "NAME",
      std::string("Name of the controller") + kNameRule, "python evade", NewPython);
  add("device", "A sensor, a controller that uses it, and an experiment with them", "NAME",
      std::string("Name of the sensor") + kNameRule, "device compass", NewDevice);
  add("entity", "A kind of robot, a controller of it, and an experiment with them", "NAME",
      std::string("Name of the kind") + kNameRule, "entity rover", NewEntity);
  add("functions", "Experiment functions, which measure and decide the end, and an experiment with them", "NAME",
      std::string("Name of the functions") + kNameRule, "functions spreading", NewFunctions);
  add("engine", "A physics engine, and an experiment with it", "NAME", std::string("Name of the engine") + kNameRule,
      "engine gliding", NewEngine);
  add("renderer", "A visualisation, and an experiment with it", "NAME",
      std::string("Name of the visualisation") + kNameRule, "renderer plan", NewRenderer);
  add("experiment", "An experiment file with a few robots in a walled arena", "NAME",
      std::string("Name of the experiment") + kNameRule, "experiment first_try", NewExperiment);

  verb->require_subcommand(1);
}

const RegisterSubCommand kNew(16, "new", AddNewCommand);

}  // namespace
}  // namespace swarmanoid
