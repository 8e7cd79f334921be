#include "argos3/plugin/own_devices.h"

#include <argos3/core/simulator/entity/composable_entity.h>

#include <utility>

#include "argos3/library/running.h"
#include "argos3/plugin/labels.h"

namespace swarmanoid::argos3
{
namespace
{

// While the object lives, devices read and change the arena, as loop functions do.
class Working
{
public:
  Working() : before_(std::exchange(TheRunning().editor, TheRunning().editor_for_devices)) {}
  ~Working() { TheRunning().editor = before_; }
  Working(const Working&) = delete;
  Working& operator=(const Working&) = delete;

private:
  SpaceEditor* before_;
};

// Returns the object of ARGoS3 for a robot, which may not be in the arena yet.
argos::CComposableEntity& RobotOf(const std::string& our_id, const SourceLocation& place, const std::string& device)
{
  const Running& running = TheRunning();
  if (running.editor_for_devices == nullptr)
    throw ConfigurationError(place, Quoted(device) +
                                        " of ARGoS3 reads the entities of the arena, which are in another "
                                        "process; run the experiment with --single-process");
  const auto given = running.given.find(our_id);
  argos::CEntity* entity = given == running.given.end() ? nullptr : given->second;
  if (entity == nullptr)
    for (argos::CEntity* one : argos::CSimulator::GetInstance().GetSpace().GetEntityVector())
      if (running.OurId(one->GetId()) == our_id) entity = one;
  auto* robot = dynamic_cast<argos::CComposableEntity*>(entity);
  if (robot == nullptr) throw ConfigurationError(place, "no robot of ARGoS3 has the device " + Quoted(device));
  return *robot;
}

// Calls `make` for each element of a list with the registered maker of its device.
template <class Registry, class Make>
void ForEachOf(const TConfigurationTree& list, const char* what, Registry registry, Make make)
{
  for (const TConfigurationTree& device : list.Children())
  {
    const std::string library = device.GetText("argos3_library");
    const PluginLibrary& loaded = LoadPluginLibrary(library, {});
    ShareNames(loaded.path);
    if (!loaded.error.empty()) throw ConfigurationError(device.Location(), loaded.error);
    const std::string label =
        std::string("argos3 ") + what + " " + device.Name() + " (" + device.GetText("implementation") + ")";
    const auto& known = registry();
    const auto found = known.find(label);
    if (found == known.end())
      throw ConfigurationError(device.Location(), "the library " + loaded.path + " registers no " + what + " <" +
                                                      device.Name() + " implementation=\"" +
                                                      device.GetText("implementation") + "\">");
    make(device, found->second());
  }
}

// Copies the element without our attribute.
void CopyDevice(const TConfigurationTree& from, argos::TConfigurationNode& to)
{
  ConfigurationNode copy = *from.Node();
  std::erase_if(copy.attributes, [](const auto& attribute) { return attribute.name == "argos3_library"; });
  CopyElement(copy, to);
}

}  // namespace

OwnDevices::~OwnDevices() = default;

void OwnDevices::Make(const TConfigurationTree& parameters, const std::string& our_id,
                      argos::CCI_Controller& controller)
{
  const TConfigurationTree sensors = parameters.Child("registered_sensors"),
                           actuators = parameters.Child("registered_actuators");
  if (!sensors.Exists() && !actuators.Exists()) return;
  LoadBefore("");
  const Working working;
  if (actuators.Exists())
    ForEachOf(actuators, "actuator", ActuatorsByLabel,
              [&](const TConfigurationTree& device, const argos::SMadeActuator& made)
              {
                Actuator& one = *actuators_.emplace_back(std::make_unique<Actuator>());
                one.simulated.reset(made.Simulated);
                one.actuator = made.Actuator;
                CopyDevice(device, one.element);
                argos::CComposableEntity& robot = RobotOf(our_id, device.Location(), device.Name());
                Calling(device.Location(),
                        [&]
                        {
                          one.simulated->SetRobot(robot);
                          one.actuator->Init(one.element);
                        });
                controller.AddActuator(device.Name(), one.actuator);
              });
  if (sensors.Exists())
    ForEachOf(sensors, "sensor", SensorsByLabel,
              [&](const TConfigurationTree& device, const argos::SMadeSensor& made)
              {
                Sensor& one = *sensors_.emplace_back(std::make_unique<Sensor>());
                one.simulated.reset(made.Simulated);
                one.sensor = made.Sensor;
                CopyDevice(device, one.element);
                argos::CComposableEntity& robot = RobotOf(our_id, device.Location(), device.Name());
                Calling(device.Location(),
                        [&]
                        {
                          one.simulated->SetRobot(robot);
                          one.sensor->Init(one.element);
                        });
                controller.AddSensor(device.Name(), one.sensor);
              });
}

void OwnDevices::Sense()
{
  if (sensors_.empty()) return;
  const Working working;
  for (const auto& one : sensors_) one->simulated->Update();
}

void OwnDevices::Act()
{
  if (actuators_.empty()) return;
  const Working working;
  for (const auto& one : actuators_) one->simulated->Update();
}

void OwnDevices::Reset()
{
  const Working working;
  for (const auto& one : sensors_) one->sensor->Reset();
  for (const auto& one : actuators_) one->actuator->Reset();
}

void OwnDevices::Clear()
{
  for (const auto& one : sensors_) one->sensor->Destroy();
  for (const auto& one : actuators_) one->actuator->Destroy();
  sensors_.clear();
  actuators_.clear();
}

}  // namespace swarmanoid::argos3
