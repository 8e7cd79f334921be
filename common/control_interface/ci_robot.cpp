#include "common/control_interface/ci_robot.h"

namespace swarmanoid
{
namespace
{

template <class Device>
Device* Find(const std::map<std::string, Device*>& devices, const std::string& type, const std::string& robot,
             const char* what)
{
  const auto found = devices.find(type);
  if (found != devices.end()) return found->second;
  std::string listed;
  for (const auto& [name, device] : devices) listed += (listed.empty() ? "" : ", ") + name;
  throw CCI_DeviceError("robot '" + robot + "' has no " + what + " '" + type + "'; its controller lists " +
                        (listed.empty() ? "none" : listed) + ". Add <" + type + "> to <" + what +
                        "s> of the controller in the experiment file");
}

}  // namespace

CCI_Actuator* CCI_Robot::GetActuator(const std::string& type) const { return Find(actuators_, type, id_, "actuator"); }

CCI_Sensor* CCI_Robot::GetSensor(const std::string& type) const { return Find(sensors_, type, id_, "sensor"); }

}  // namespace swarmanoid
