// CCI_Controller: the base of controllers. It runs at a controller host, one object for each robot, in one thread.
#pragma once

#include <argos3/core/control_interface/ci_actuator.h>
#include <argos3/core/control_interface/ci_sensor.h>
#include <argos3/core/utility/configuration/base_configurable_resource.h>
#include <argos3/core/utility/datatypes/datatypes.h>
#include <argos3/core/utility/logging/argos_log.h>
#include <argos3/core/utility/plugins/factory.h>

namespace argos
{

class CCI_Controller : public CBaseConfigurableResource
{
public:
  // Gets the <params> of the controller.
  void Init(TConfigurationNode&) override {}
  // Called at each tick, after the sensors were read.
  virtual void ControlStep() {}
  void Reset() override {}
  void Destroy() override {}

  const std::string& GetId() const { return m_strId; }
  void SetId(const std::string& id) { m_strId = id; }

  // Return the device with that tag in the experiment file. Throw CARGoSException with the listed devices if the tag is
  // not listed, or if the device is of another type.
  template <class Actuator>
  Actuator* GetActuator(const std::string& tag)
  {
    return Typed<Actuator>(m_mapActuators, tag, "actuator");
  }
  template <class Sensor>
  Sensor* GetSensor(const std::string& tag)
  {
    return Typed<Sensor>(m_mapSensors, tag, "sensor");
  }
  bool HasActuator(const std::string& tag) const { return m_mapActuators.count(tag) != 0; }
  bool HasSensor(const std::string& tag) const { return m_mapSensors.count(tag) != 0; }
  CCI_Actuator::TMap& GetAllActuators() { return m_mapActuators; }
  CCI_Sensor::TMap& GetAllSensors() { return m_mapSensors; }
  void AddActuator(const std::string& tag, CCI_Actuator* actuator) { m_mapActuators[tag] = actuator; }
  void AddSensor(const std::string& tag, CCI_Sensor* sensor) { m_mapSensors[tag] = sensor; }

protected:
  CCI_Actuator::TMap m_mapActuators;
  CCI_Sensor::TMap m_mapSensors;
  std::string m_strId;

private:
  template <class Device, class Base>
  Device* Typed(const std::map<std::string, Base*>& devices, const std::string& tag, const char* what) const
  {
    const auto found = devices.find(tag);
    if (found == devices.end())
    {
      std::string listed;
      for (const auto& device : devices) listed += (listed.empty() ? "" : ", ") + device.first;
      THROW_ARGOSEXCEPTION("robot '" << m_strId << "' has no " << what << " '" << tag << "'; its controller lists "
                                     << (listed.empty() ? "none" : listed) << ". Add <" << tag << "> to <" << what
                                     << "s> of the controller in the experiment file");
    }
    if (auto* typed = dynamic_cast<Device*>(found->second)) return typed;
    THROW_ARGOSEXCEPTION("the " << what << " '" << tag << "' of robot '" << m_strId
                                << "' is not of the type that is asked for");
  }
};

}  // namespace argos

#define REGISTER_CONTROLLER(CLASS, LABEL)                                                            \
  namespace                                                                                          \
  {                                                                                                  \
  const argos::SControllerRegistration argos3_registration_of_##CLASS(LABEL,                         \
                                                                      []() -> argos::CCI_Controller* \
                                                                      { return new CLASS; });        \
  }
