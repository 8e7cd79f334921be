#include "common/control_interface/ci_robot.h"

#include <algorithm>
#include <iostream>
#include <mutex>
#include <set>

#include "common/configuration/wording.h"

namespace swarmanoid
{
namespace
{

template <class Devices>
std::vector<std::string> TypesOf(const Devices& devices)
{
  std::vector<std::string> types;
  for (const auto& [type, device] : devices) types.push_back(*type);
  return types;
}

}  // namespace

const std::string* CCI_Robot::Shared(const std::string& text)
{
  static std::mutex mutex;
  static std::set<std::string> texts;
  const std::lock_guard lock(mutex);
  return &*texts.insert(text).first;
}

template <class Device>
void CCI_Robot::Add(Devices<Device>& devices, const std::string& type, Device* device)
{
  const auto place =
      std::find_if(devices.begin(), devices.end(), [&](const auto& other) { return *other.first >= type; });
  if (place != devices.end() && *place->first == type)
    place->second = device;
  else
    devices.emplace(place, Shared(type), device);
}

template <class Device>
Device* CCI_Robot::Find(const Devices<Device>& devices, const std::string& type)
{
  for (const auto& [listed, device] : devices)
    if (*listed == type) return device;
  return nullptr;
}

template <class Device, class Other>
Device* CCI_Robot::Listed(const Devices<Device>& devices, const Devices<Other>& others, const std::string& type,
                          const std::string& what, const std::string& other) const
{
  if (Device* const found = Find(devices, type)) return found;
  const std::vector<std::string> listed = TypesOf(devices);
  const std::string cure = Find(others, type) != nullptr
                               ? "It lists the " + other + " of that name"
                               : "Add <" + type + "> to <" + what + "s> of the controller in the experiment file";
  throw CCI_DeviceError("robot '" + id_ + "' has no " + what + " '" + type + "'; its controller lists " +
                        swarmanoid::Listed(listed) + ". " + cure + DidYouMean(type, listed));
}

template void CCI_Robot::Add(Devices<CCI_Actuator>& devices, const std::string& type, CCI_Actuator* device);
template void CCI_Robot::Add(Devices<CCI_Sensor>& devices, const std::string& type, CCI_Sensor* device);
template CCI_Actuator* CCI_Robot::Find(const Devices<CCI_Actuator>& devices, const std::string& type);
template CCI_Sensor* CCI_Robot::Find(const Devices<CCI_Sensor>& devices, const std::string& type);

void CCI_Robot::WriteLog(const CCI_Robot& robot, std::string_view text)
{
  std::cerr << "robot '" << robot.GetId() << "' at tick " << robot.GetTick() << ": " << text << "\n";
}

CCI_Actuator* CCI_Robot::GetActuator(const std::string& type) const
{
  return Listed(actuators_, sensors_, type, "actuator", "sensor");
}

CCI_Sensor* CCI_Robot::GetSensor(const std::string& type) const
{
  return Listed(sensors_, actuators_, type, "sensor", "actuator");
}

std::vector<std::string> CCI_Robot::ActuatorTypes() const { return TypesOf(actuators_); }

std::vector<std::string> CCI_Robot::SensorTypes() const { return TypesOf(sensors_); }

}  // namespace swarmanoid
