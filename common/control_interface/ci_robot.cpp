#include "common/control_interface/ci_robot.h"

#include <iostream>

#include "common/configuration/wording.h"

namespace swarmanoid
{
namespace
{

template <class Device>
std::vector<std::string> TypesOf(const std::map<std::string, Device*>& devices)
{
  std::vector<std::string> types;
  for (const auto& [type, device] : devices) types.push_back(type);
  return types;
}

// The device, or an error that says what to do: list it, ask for the other kind, or spell it as listed.
template <class Device, class Other>
Device* Find(const std::map<std::string, Device*>& devices, const std::map<std::string, Other*>& others,
             const std::string& type, const std::string& robot, const std::string& what, const std::string& other)
{
  const auto found = devices.find(type);
  if (found != devices.end()) return found->second;
  const std::vector<std::string> listed = TypesOf(devices);
  const std::string cure = others.contains(type)
                               ? "It lists the " + other + " of that name"
                               : "Add <" + type + "> to <" + what + "s> of the controller in the experiment file";
  throw CCI_DeviceError("robot '" + robot + "' has no " + what + " '" + type + "'; its controller lists " +
                        Listed(listed) + ". " + cure + DidYouMean(type, listed));
}

}  // namespace

void CCI_Robot::WriteLog(const CCI_Robot& robot, std::string_view text)
{
  std::cerr << "robot '" << robot.GetId() << "' at tick " << robot.GetTick() << ": " << text << "\n";
}

CCI_Actuator* CCI_Robot::GetActuator(const std::string& type) const
{
  return Find(actuators_, sensors_, type, id_, "actuator", "sensor");
}

CCI_Sensor* CCI_Robot::GetSensor(const std::string& type) const
{
  return Find(sensors_, actuators_, type, id_, "sensor", "actuator");
}

std::vector<std::string> CCI_Robot::ActuatorTypes() const { return TypesOf(actuators_); }

std::vector<std::string> CCI_Robot::SensorTypes() const { return TypesOf(sensors_); }

}  // namespace swarmanoid
