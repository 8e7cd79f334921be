#include "tests/unit/every_plugin/small_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "common/control_interface/ci_controller.h"
#include "common/control_interface/ci_publish.h"
#include "common/experiment/load_experiment.h"
#include "common/plugins/plugin_library.h"
#include "common/space/space.h"
#include "simulation/register_all.h"
#include "test_folders.h"
#include "tests/world/experiment_text.h"

namespace swarmanoid
{
namespace
{

std::set<std::string>& Mistakes()
{
  static std::set<std::string> mistakes;
  return mistakes;
}

// Reads every sensor, and sets every actuator, by their declared columns.
class CSimplestScenesProbe : public CCI_Controller
{
public:
  int Init(const TConfigurationTree) override { return RETURN_OK; }

  void ControlStep() override
  {
    for (const std::string& type : GetRobot()->SensorTypes()) Read(type, *GetRobot()->GetSensor(type));
    const std::vector<std::string> actuators = GetRobot()->ActuatorTypes();
    for (const std::string& type : actuators) Tell(type, *GetRobot()->GetActuator(type));
    if (std::ranges::find(actuators, "report") != actuators.end()) Publish(*GetRobot(), {{"probe", 1}});
  }
  bool HasState() const override { return true; }

private:
  void Complain(const std::string& device, const std::string& what) const
  {
    Mistakes().insert(fmt::format("{} of the {}: {}", device, GetRobot()->GetKind(), what));
  }

  void Check(const std::string& device, const CCI_Column& column, double value) const
  {
    if (std::isnan(value) || (std::isinf(value) && !column.may_be_infinite))
      Complain(device, fmt::format("'{}' is {}", column.name, value));
    if (value < column.minimum || value > column.maximum)
      Complain(device,
               fmt::format("'{}' is {}, outside of {} to {}", column.name, value, column.minimum, column.maximum));
    const bool is_whole = value == std::floor(value);
    if ((column.unit == "colour" && !(is_whole && value >= 0 && value <= 0xffffff)) ||
        (column.unit == "yes/no" && value != 0 && value != 1))
      Complain(device, fmt::format("'{}' is {}, which is no {}", column.name, value, column.unit));
  }

  void Read(const std::string& type, const CCI_Sensor& sensor) const
  {
    const std::string device = "sensor " + type;
    const std::vector<CCI_Column> columns = sensor.Columns();
    const std::vector<CCI_Column> rows = sensor.Rows();
    if (columns.empty() && rows.empty()) Complain(device, "it states neither Columns nor Rows");
    std::vector<double> values;
    sensor.ReadColumns(values);
    if (values.size() != columns.size())
      return Complain(device, fmt::format("{} columns and {} numbers", columns.size(), values.size()));
    for (std::size_t i = 0; i < values.size(); ++i) Check(device, columns[i], values[i]);
    values.clear();
    sensor.ReadRows(values);
    if (rows.empty() ? !values.empty() : values.size() % rows.size() != 0)
      return Complain(device, fmt::format("{} numbers in rows of {}", values.size(), rows.size()));
    for (std::size_t i = 0; i < values.size(); ++i) Check(device, rows[i % rows.size()], values[i]);
    std::vector<std::string> ids;
    sensor.ReadRowIds(ids);
    if (!ids.empty() && ids.size() * rows.size() != values.size())
      Complain(device, fmt::format("{} ids of {} rows", ids.size(), values.size() / rows.size()));
    std::vector<CCI_Reading> readings;
    sensor.Describe(readings);
    for (const CCI_Reading& reading : readings)
      if (!std::isfinite(reading.value))
        Complain(device, fmt::format("Describe: '{}' is {}", reading.name, reading.value));
  }

  // Sets the middle of each range first, and then its end. Columns without a range get about 1.
  void Tell(const std::string& type, CCI_Actuator& actuator) const
  {
    const std::string device = "actuator " + type;
    const std::vector<CCI_Column> columns = actuator.Columns();
    if (columns.empty()) return Complain(device, "it states no Columns");
    std::vector<double> values;
    for (const CCI_Column& column : columns)
    {
      const double low = std::max(column.minimum, -1.0);
      const double high = std::isfinite(column.maximum) ? column.maximum : 1;
      const bool is_whole = column.unit == "colour" || column.unit == "yes/no";
      const double middle = is_whole ? high : 0.3 * low + 0.7 * high;
      values.push_back(GetRobot()->GetTick() < kTicks / 2 ? middle : high);
    }
    actuator.SetColumns(values);
    std::vector<CCI_Reading> readings;
    actuator.Describe(readings);
    for (const CCI_Reading& reading : readings)
      if (!std::isfinite(reading.value))
        Complain(device, fmt::format("Describe: '{}' is {}", reading.name, reading.value));
  }
};
REGISTER_CONTROLLER(CSimplestScenesProbe, kProbe)

void RequireDefaults(const std::string& owner, const std::vector<ParameterSpec>& parameters)
{
  for (const ParameterSpec& parameter : parameters)
    EXPECT_TRUE(parameter.default_value || IsNumbered(parameter))
        << "the parameter '" << parameter.name << "' of " << owner
        << " has no default, so no scene can be made from its table: give it one, or its value to DeviceElement or "
           "EntityElement in tests/unit/every_plugin/small_scene.cpp";
}

// The attributes that the element of an entity needs besides its position.
const std::map<std::string, std::string>& ElementsOfKinds()
{
  static const std::map<std::string, std::string> attributes = {{"block", " size='0.2,0.2,0.2'"},
                                                                {"wall", " size='0.2,0.2,0.2'"},
                                                                {"ground_patch", " radius='0.1'"},
                                                                {"charging_station", " radius='0.1'"},
                                                                {"hole", " radius='0.1'"}};
  return attributes;
}

double HalfWidth(EntityKind kind)
{
  const EntityKindDescription& row = DescriptionOf(kind);
  if (row.size.x() == 0) return 0.15;
  return row.form == BodyForm::kBox ? 0.5 * row.size.head<2>().norm() : row.size.x();
}

bool Has(const std::vector<std::string>& names, const std::string& name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool CanHave(const PluginDescription& device, EntityKind robot, const PluginDescription& engine)
{
  return (device.robots.empty() || Has(device.robots, std::string(TagName(robot))) || Carries(robot, device.label)) &&
         (device.channel.empty() || Has(engine.channels, device.channel));
}

// Registers everything at the first call. Returns the names of the libraries of entity kinds by the tags of the kinds.
const std::map<std::string, std::string, std::less<>>& LibrariesOfKinds()
{
  static const auto libraries = []
  {
    RegisterBuiltins();
    namespace fs = std::filesystem;
    const std::vector<std::string> folders = {SWARMANOID_BUILD_FOLDER "/lib/swarmanoid"};
    std::map<std::string, std::string, std::less<>> of_kinds;
    for (const char* folder : {"controllers", "entities", "functions"})
      for (const auto& entry : fs::directory_iterator(fs::path(SWARMANOID_SOURCE_FOLDER) / "user" / folder))
      {
        const std::string name = entry.path().filename().string();
        const PluginLibrary& library = LoadPluginLibrary(name, folders);
        EXPECT_EQ(library.error, "");
        for (const auto& [kind, label] : library.registrations.labels)
          if (kind == PluginKind::kEntityKind) of_kinds.emplace(label, name);
      }
    return of_kinds;
  }();
  return libraries;
}

}  // namespace

void RegisterEverything() { LibrariesOfKinds(); }

std::vector<EntityKind> AllKinds()
{
  std::vector<EntityKind> kinds;
  for (std::size_t k = 0; k < EntityKindCount(); ++k)
    if (static_cast<EntityKind>(k) != EntityKind::kTerrain) kinds.push_back(static_cast<EntityKind>(k));
  return kinds;
}

std::vector<EntityKind> AllRobots()
{
  std::vector<EntityKind> robots = AllKinds();
  std::erase_if(robots, [](EntityKind kind) { return !IsRobot(kind); });
  return robots;
}

std::vector<const PluginDescription*> AllEngines()
{
  RegisterEverything();
  std::vector<const PluginDescription*> engines = PluginCatalogue::Instance().Of(PluginKind::kEngine);
  std::erase_if(engines, [](const PluginDescription* engine) { return engine->label == "dummy_engine"; });
  return engines;
}

bool Simulates(const PluginDescription& engine, EntityKind kind)
{
  return Has(engine.entity_tags, std::string(TagName(kind))) || (engine.any_kind && !IsBuiltIn(kind));
}

std::vector<Devices> DeviceSets(EntityKind robot, const PluginDescription& engine)
{
  std::vector<Devices> sets;
  const auto add = [&](PluginKind kind, std::vector<const PluginDescription*> Devices::*list)
  {
    std::map<std::string, std::vector<const PluginDescription*>> by_label;
    for (const PluginDescription* device : PluginCatalogue::Instance().Of(kind))
      if (CanHave(*device, robot, engine)) by_label[device->label].push_back(device);
    for (const auto& [label, implementations] : by_label)
      for (std::size_t i = 0; i < implementations.size(); ++i)
      {
        if (sets.size() <= i) sets.resize(i + 1);
        (sets[i].*list).push_back(implementations[i]);
      }
  };
  add(PluginKind::kSensor, &Devices::sensors);
  add(PluginKind::kActuator, &Devices::actuators);
  return sets;
}

std::string DeviceElement(const PluginDescription& device)
{
  RequireDefaults(device.label + " (" + device.implementation + ")", device.parameters);
  return fmt::format("<{} implementation='{}'/>", device.label, device.implementation);
}

namespace
{

// `more`: further attributes.
std::string ElementOf(EntityKind kind, const std::string& id, const std::string& more, const std::string& controller)
{
  const EntityKindDescription& row = DescriptionOf(kind);
  const auto given = ElementsOfKinds().find(row.tag);
  if (given == ElementsOfKinds().end()) RequireDefaults("the kind " + row.tag, row.parameters);
  return fmt::format("<{} id='{}'{}{}{}/>", row.tag, id, more, given == ElementsOfKinds().end() ? "" : given->second,
                     controller.empty() ? "" : " controller='" + controller + "'");
}

}  // namespace

double HeightOf(EntityKind kind)
{
  const EntityKindDescription& row = DescriptionOf(kind);
  return row.origin == BodyOrigin::kCentre ? 0.1 : row.role == EntityRole::kLight ? 0.3 : 0;
}

std::string EntityElement(EntityKind kind, const std::string& id, double x, double y, const std::string& controller)
{
  return ElementOf(kind, id, fmt::format(" position='{},{},{}'", x, y, HeightOf(kind)), controller);
}

std::string Waiting(EntityKind kind, const std::string& id, const std::string& controller)
{
  // An entity of a <reserve> must be able to move.
  const std::string movable = DescriptionOf(kind).mobility == Mobility::kIfAsked ? " movable='true'" : "";
  return "<reserve quantity='1'>" + ElementOf(kind, id, movable, controller) + "</reserve>";
}

double NearDistance(EntityKind robot, EntityKind other)
{
  constexpr double kGap = 0.08;
  return HalfWidth(robot) + HalfWidth(other) + kGap;
}

// The devices of fields refuse an arena that has none.
bool NeedsField(const Devices& devices)
{
  const auto is_of_field = [](const PluginDescription* device) { return device->label == "floor_field"; };
  return std::ranges::any_of(devices.sensors, is_of_field) || std::ranges::any_of(devices.actuators, is_of_field);
}

std::unique_ptr<Experiment> Read(const SmallScene& scene)
{
  RegisterEverything();
  const auto elements = [](const std::vector<const PluginDescription*>& devices)
  {
    std::string all;
    for (const PluginDescription* device : devices) all += DeviceElement(*device);
    return all;
  };
  std::string kinds;
  for (const EntityKind kind : AllKinds())
    if (!IsBuiltIn(kind))
      kinds += fmt::format("<{} library='{}'/>", TagName(kind), LibrariesOfKinds().find(TagName(kind))->second);
  return test::ExperimentText{
      .framework = fmt::format("<maxclock>{}</maxclock><plugin_path>{}</plugin_path>{}", scene.ticks,
                               SWARMANOID_BUILD_FOLDER "/lib/swarmanoid", scene.framework),
      .kinds = kinds,
      .controllers = fmt::format("<{0} id='c'><actuators>{1}</actuators><sensors>{2}</sensors></{0}>", scene.controller,
                                 elements(scene.devices.actuators), elements(scene.devices.sensors)),
      .size = fmt::format("{0},{0},3", kArena_m),
      .arena = (NeedsField(scene.devices) ? "<floor_field id='field'/>" : "") + scene.arena,
      .engines = fmt::format("<{} id='e'/>", scene.engine),
      .functions = scene.functions,
      .visualisations = scene.renderers,
      .faults = scene.faults}
      .Load(SWARMANOID_SOURCE_FOLDER);
}

std::uint64_t RunScene(const Experiment& experiment, const SimulatorOptions& options,
                       const std::function<void(CSimulator&)>& change)
{
  Mistakes().clear();
  std::uint64_t hash = 0;
  try
  {
    CSimulator simulator(experiment, options);
    do {
      if (change) change(simulator);
    } while (simulator.Step());
    EXPECT_EQ(simulator.GetSpace().GetTick(), experiment.max_clock) << "the run ended too early";
    hash = simulator.Finish().hash;
  }
  catch (const std::exception& error)
  {
    ADD_FAILURE() << error.what();
  }
  for (const std::string& mistake : Mistakes()) ADD_FAILURE() << mistake;
  return hash;
}

std::uint64_t RunScene(const SmallScene& scene, const std::function<void(CSimulator&)>& change)
{
  const std::unique_ptr<Experiment> experiment = Read(scene);
  if (experiment == nullptr) return 0;
  SimulatorOptions options;
  options.threads = 1;
  return RunScene(*experiment, options, change);
}

}  // namespace swarmanoid
