// A robot is put together in an order that keeps it safe: libraries, controller and drivers are found and all
// parameters are checked before the first driver opens a device, so a mistake in a file moves nothing. Random numbers
// come from the same streams as in the simulator, by seed, id and step, so a controller draws the same numbers in both.
//
// The controller's Init runs when every sensor has a value (control_loop.cpp). Stopping is tried for each actuator,
// even if another one has failed; the destructor stops, too.
#include "real_robot/robot.h"

#include <fmt/format.h>
#include <algorithm>

#include "common/configuration/parameter_table.h"
#include "common/configuration/wording.h"
#include "common/control_interface/init_controller.h"
#include "common/logging/log.h"
#include "common/plugins/plugin_library.h"
#include "common/plugins/script_parameters.h"

namespace swarmanoid
{
namespace
{

// Every sensor driver has this parameter.
const ParameterSpec kTimeout{.name = "timeout_s",
                             .unit = "s",
                             .default_value = "1",
                             .description = "The robot stands while a source is silent for longer; 0: for ever.",
                             .minimum = 0};

std::vector<ParameterSpec> ParametersOf(const PluginDescription& description, bool is_sensor)
{
  std::vector<ParameterSpec> parameters = description.parameters;
  if (is_sensor) parameters.push_back(kTimeout);
  return parameters;
}

// Throws the first mistake in the parameters of a driver or controller.
void CheckParameters(const TConfigurationTree& tree, const std::vector<ParameterSpec>& specs, const std::string& owner,
                     const std::vector<std::string>& others)
{
  for (const ConfigurationError& mistake : MistakesIn(tree, specs, owner, others)) throw mistake;
}

void CheckDriverParameters(const RobotDevice& device, const std::vector<ParameterSpec>& specs)
{
  CheckParameters(device.tree, specs, "driver of <" + device.type + ">", {"driver"});
}

// Returns the drivers of a type of device, or the types that have drivers.
template <class Driver>
std::vector<std::string> DriversOf(const std::string& type)
{
  std::vector<std::string> names;
  for (const auto& [key, entry] : PluginRegistry<Driver>::Instance().Entries())
    if (key.first == type) names.push_back(key.second);
  return names;
}

template <class Driver>
std::vector<std::string> TypesWithDrivers(const std::string& kind)
{
  std::vector<std::string> types;
  for (const auto& [key, entry] : PluginRegistry<Driver>::Instance().Entries())
  {
    const auto& robots = entry.description.robots;
    if (!robots.empty() && std::ranges::find(robots, kind) == robots.end()) continue;
    if (types.empty() || types.back() != key.first) types.push_back(key.first);
  }
  return types;
}

template <class Driver>
const typename PluginRegistry<Driver>::Entry& ChooseDriver(const RobotDevice& device, const char* what,
                                                           const RobotConfiguration& robot)
{
  const std::vector<std::string> names = DriversOf<Driver>(device.type);
  if (names.empty())
  {
    const std::vector<std::string> types = TypesWithDrivers<Driver>(robot.kind);
    throw ConfigurationError(
        device.location,
        fmt::format("there is no driver for the {} <{}> in {}; {}s of a {} with a driver: {}{}", what, device.type,
                    Listed(robot.driver_libraries), what, robot.kind, Listed(types), DidYouMean(device.type, types)));
  }
  std::string name = device.driver;
  if (name.empty())
    name = names.size() == 1 || std::ranges::find(names, robot.preferred_driver) == names.end()
               ? names.front()
               : robot.preferred_driver;
  if (device.driver.empty() && names.size() > 1 && name != robot.preferred_driver)
    throw ConfigurationError(
        device.location,
        fmt::format("the {} <{}> has the drivers {}; choose one in the robot file: <{} driver=\"{}\"/>", what,
                    device.type, Listed(names), device.type, names.front()));
  const auto* entry = PluginRegistry<Driver>::Instance().Find(device.type, name);
  if (entry == nullptr)
    throw ConfigurationError(device.tree.ValueLocation("driver"),
                             fmt::format("there is no driver {} for the {} <{}>; there are: {}{}", Quoted(name), what,
                                         device.type, Listed(names), DidYouMean(name, names)));
  const auto& robots = entry->description.robots;
  if (!robots.empty() && std::ranges::find(robots, robot.kind) == robots.end())
    throw ConfigurationError(device.location, fmt::format("the {} <{}> is for {} only, and this robot is a {}", what,
                                                          device.type, Listed(robots), robot.kind));
  return *entry;
}

template <class Driver>
void PrintDrivers(const char* title, std::string& text)
{
  text += fmt::format("{}\n", title);
  for (const auto& [key, entry] : PluginRegistry<Driver>::Instance().Entries())
    text += fmt::format("  {:<48} {}\n", key.first + " / " + key.second, entry.description.brief);
}

using ControllerEntry = PluginRegistry<CCI_Controller>::Entry;

const ControllerEntry& FindController(const RobotConfiguration& configuration)
{
  if (configuration.controller_library.empty())
  {
    const auto* built_in = PluginRegistry<CCI_Controller>::Instance().Find(configuration.controller_tag);
    if (built_in != nullptr) return *built_in;
    throw ConfigurationError(
        configuration.location,
        fmt::format("the controller {} names no library; give the one that holds <{}>, as library=\"name\"",
                    Quoted(configuration.controller_id), configuration.controller_tag));
  }
  const PluginLibrary& library = LoadPluginLibrary(configuration.controller_library, configuration.controller_path);
  if (!library.error.empty()) throw ConfigurationError(configuration.library_location, library.error);
  const auto* entry = PluginRegistry<CCI_Controller>::Instance().Find(configuration.controller_tag);
  if (entry != nullptr) return *entry;
  std::vector<std::string> labels;
  for (const auto& [kind, label] : library.registrations.labels)
    if (kind == PluginKind::kController) labels.push_back(label);
  throw ConfigurationError(
      configuration.location,
      fmt::format("the library {} registers no controller <{}>; it registers: {}{}", library.path,
                  configuration.controller_tag, Listed(labels), DidYouMean(configuration.controller_tag, labels)));
}

// Returns the parameters as the simulator reads them: checked and complete if the controller declared them.
TConfigurationTree CheckedParameters(const RobotConfiguration& configuration, const PluginDescription& description)
{
  if (!description.declares_parameters) return configuration.parameters;
  const TConfigurationTree given = OrEmpty(configuration.parameters, "parameters", configuration.location);
  const auto parameters = ScriptParameters::Instance().TableOf(description, given, configuration.folder);
  CheckParameters(given, parameters, "controller <" + description.label + ">", {});
  return WithDefaults(given, parameters, configuration.folder);
}

}  // namespace

void LoadDriverLibraries(const RobotConfiguration& configuration)
{
  for (const std::string& name : configuration.driver_libraries)
  {
    const PluginLibrary& library = LoadPluginLibrary(name, configuration.driver_path);
    if (!library.error.empty()) throw ConfigurationError("drivers: " + library.error);
  }
}

std::string DriverList()
{
  std::string text;
  PrintDrivers<CSensorDriver>("Sensors", text);
  PrintDrivers<CActuatorDriver>("Actuators", text);
  return text;
}

Robot::Robot(RobotConfiguration configuration)
    : configuration_(std::move(configuration)), interface_(configuration_.id, configuration_.kind)
{
  LoadDriverLibraries(configuration_);
  controller_entry_ = &FindController(configuration_);
  configuration_.parameters = CheckedParameters(configuration_, controller_entry_->description);
  controller_ = controller_entry_->create();
  interface_.SetLog([](const CCI_Robot& robot, std::string_view text)
                    { LogInfo("step {}: {}", robot.GetTick(), text); });
  controller_->SetRobot(&interface_);

  // All choices are made first, so that a mistake is found before any device moves.
  std::vector<const PluginRegistry<CSensorDriver>::Entry*> sensor_entries;
  for (const RobotDevice& device : configuration_.sensors)
  {
    sensor_entries.push_back(&ChooseDriver<CSensorDriver>(device, "sensor", configuration_));
    CheckDriverParameters(device, ParametersOf(sensor_entries.back()->description, true));
  }
  std::vector<const PluginRegistry<CActuatorDriver>::Entry*> actuator_entries;
  for (const RobotDevice& device : configuration_.actuators)
  {
    actuator_entries.push_back(&ChooseDriver<CActuatorDriver>(device, "actuator", configuration_));
    CheckDriverParameters(device, ParametersOf(actuator_entries.back()->description, false));
  }

  const auto setup_of = [this](const RobotDevice& device, const std::vector<ParameterSpec>& specs)
  {
    return DriverSetup{Parameters(device.tree, specs), configuration_.id, configuration_.kind,
                       configuration_.name_space, configuration_.clock_tick_ms * 1e-3};
  };
  for (std::size_t k = 0; k < configuration_.sensors.size(); ++k)
  {
    const RobotDevice& device = configuration_.sensors[k];
    const std::vector<ParameterSpec> specs = ParametersOf(sensor_entries[k]->description, true);
    Sensor sensor{&device, sensor_entries[k]->description.implementation, sensor_entries[k]->create(), 0};
    const DriverSetup setup = setup_of(device, specs);
    sensor.timeout_s = setup.parameters.Number("timeout_s");
    sensor.driver->Init(setup);
    interface_.AddSensor(device.type, sensor.driver->Sensor());
    sensors_.push_back(std::move(sensor));
  }
  for (std::size_t k = 0; k < configuration_.actuators.size(); ++k)
  {
    const RobotDevice& device = configuration_.actuators[k];
    Actuator actuator{&device, actuator_entries[k]->description.implementation, actuator_entries[k]->create()};
    actuator.driver->Init(setup_of(device, actuator_entries[k]->description.parameters));
    interface_.AddActuator(device.type, actuator.driver->Actuator());
    actuators_.push_back(std::move(actuator));
  }
}

Robot::~Robot()
{
  try
  {
    End();
  }
  catch (const std::exception&)
  {
    // The robot is destroyed anyway. Callers that can report errors have called End before.
  }
}

void Robot::Poll()
{
  for (const Sensor& sensor : sensors_) sensor.driver->Poll();
}

std::string Robot::NotHeard() const
{
  for (const Sensor& sensor : sensors_)
    for (const DriverSource& source : sensor.driver->Sources())
      if (!source.heard)
        return fmt::format("sensor '{}': nothing heard from {} in {:.1f} s", sensor.device->type, source.name,
                           source.silence_s);
  return {};
}

std::string Robot::Silent() const
{
  for (const Sensor& sensor : sensors_)
  {
    if (sensor.timeout_s == 0) continue;
    for (const DriverSource& source : sensor.driver->Sources())
      if (source.silence_s > sensor.timeout_s)
        return fmt::format("sensor '{}': {} is silent for {:.1f} s", sensor.device->type, source.name,
                           source.silence_s);
  }
  return {};
}

void Robot::BeginStep(std::uint64_t step_stream)
{
  // Each robot of a swarm has its own random numbers. They are the same in each run, here and in the simulator.
  interface_.BeginStep(steps_, configuration_.clock_tick_ms * 1e-3,
                       {configuration_.seed, StreamName(configuration_.id), step_stream, steps_});
}

void Robot::Start()
{
  BeginStep(kInitStream);
  int result = CCI_Controller::RETURN_OK;
  started_ = true;
  try
  {
    result = InitController(*controller_, controller_entry_->description, configuration_.controller_id,
                            configuration_.parameters);
  }
  catch (const ConfigurationError&)
  {
    throw;  // a mistake in the file
  }
  catch (const std::exception& error)
  {
    throw RobotError(fmt::format("robot '{}': Init of controller '{}' failed: {}", configuration_.id,
                                 configuration_.controller_id, error.what()));
  }
  if (result != CCI_Controller::RETURN_OK)
    throw RobotError(fmt::format("robot '{}': Init of controller '{}' returned {}", configuration_.id,
                                 configuration_.controller_id, result));
}

void Robot::Tick()
{
  BeginStep(kControlStepStream);
  try
  {
    controller_->ControlStep();
  }
  catch (const std::exception& error)
  {
    throw RobotError(fmt::format("robot '{}': ControlStep {} failed: {}", configuration_.id, steps_, error.what()));
  }
  for (const Actuator& actuator : actuators_) actuator.driver->Push();
  ++steps_;
}

void Robot::Stop()
{
  // Each device is stopped, even if stopping another one fails.
  std::string failed;
  for (const Actuator& actuator : actuators_)
  {
    try
    {
      actuator.driver->Stop();
    }
    catch (const std::exception& error)
    {
      failed += fmt::format("{}actuator '{}' cannot be stopped: {}", failed.empty() ? "" : "; ", actuator.device->type,
                            error.what());
    }
  }
  if (!failed.empty()) throw DriverError(failed);
}

void Robot::End()
{
  if (ended_) return;
  ended_ = true;
  Stop();
  if (!started_) return;
  BeginStep(kDestroyStream);
  controller_->Destroy();
}

std::vector<std::string> Robot::Wiring() const
{
  std::vector<std::string> lines;
  const auto add = [&lines](const char* what, const std::string& type, const std::string& driver, const char* word,
                            const std::vector<std::string>& ends)
  {
    std::string line = fmt::format("{} {} by driver {}", what, type, driver);
    const std::size_t shown = std::min<std::size_t>(ends.size(), 3);
    for (std::size_t k = 0; k < shown; ++k) line += fmt::format("{}{}", k == 0 ? word : ", ", ends[k]);
    if (ends.size() > shown) line += fmt::format(" and {} more", ends.size() - shown);
    lines.push_back(std::move(line));
  };
  for (const Sensor& sensor : sensors_)
  {
    std::vector<std::string> sources;
    for (const DriverSource& source : sensor.driver->Sources()) sources.push_back(source.name);
    add("sensor", sensor.device->type, sensor.driver_name, " from ", sources);
  }
  for (const Actuator& actuator : actuators_)
    add("actuator", actuator.device->type, actuator.driver_name, " to ", actuator.driver->Sinks());
  return lines;
}

}  // namespace swarmanoid
