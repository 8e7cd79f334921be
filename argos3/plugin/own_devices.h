// The sensors and actuators of a robot that users' libraries registered by REGISTER_SENSOR and REGISTER_ACTUATOR. They
// know the entities of ARGoS3, so they need the loop functions in the same process.
#pragma once

#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/core/simulator/actuator.h>
#include <argos3/core/simulator/sensor.h>

#include <memory>
#include <string>
#include <vector>

#include "common/configuration/configuration_tree.h"

namespace swarmanoid::argos3
{

class OwnDevices
{
public:
  OwnDevices() = default;
  ~OwnDevices();
  OwnDevices(const OwnDevices&) = delete;
  OwnDevices& operator=(const OwnDevices&) = delete;

  // Makes the devices of <registered_sensors> and <registered_actuators> in `parameters`, and gives them to the
  // controller of the robot. `our_id`: of the robot. Throws ConfigurationError.
  void Make(const TConfigurationTree& parameters, const std::string& our_id, argos::CCI_Controller& controller);
  // Before each control step.
  void Sense();
  // After each control step.
  void Act();
  void Reset();
  void Clear();

private:
  struct Sensor
  {
    std::unique_ptr<argos::CSimulatedSensor> simulated;
    argos::CCI_Sensor* sensor = nullptr;
    argos::TConfigurationNode element{};
  };
  struct Actuator
  {
    std::unique_ptr<argos::CSimulatedActuator> simulated;
    argos::CCI_Actuator* actuator = nullptr;
    argos::TConfigurationNode element{};
  };

  // The addresses of elements stay, since devices may keep them.
  std::vector<std::unique_ptr<Sensor>> sensors_;
  std::vector<std::unique_ptr<Actuator>> actuators_;
};

}  // namespace swarmanoid::argos3
