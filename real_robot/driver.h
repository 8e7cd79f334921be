// Drivers: the sensors and actuators of a real robot. One object serves one device of the robot that the program
// swarmanoid_robot runs on; its controller holds the same CCI_ interface as in the simulator. Drivers are plug-ins of a
// library that the robot program loads; all calls come from the thread that runs the controller.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/configuration/parameter.h"
#include "common/control_interface/ci_device.h"
#include "common/plugins/registry.h"

namespace swarmanoid
{

// What a driver is made from.
struct DriverSetup
{
  Parameters parameters;   // of the driver, from the robot file
  std::string robot_id;    // as in the logs
  std::string robot_kind;  // "footbot", "eyebot" or "handbot"
  std::string name_space;  // put before the names of topics and the like; may be empty
  double tick_seconds;     // of one control step
};

// A driver cannot work: no such port, no network. what() says which, and what to do. Ends the robot program.
class DriverError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

// Where a sensor driver gets its values from, for logs and the watch on silence.
struct DriverSource
{
  std::string name;      // "topic rt/scan (sensor_msgs/msg/LaserScan)"
  bool heard = false;    // whether anything ever came
  double silence_s = 0;  // since the latest value, or since Init
};

class CSensorDriver
{
public:
  virtual ~CSensorDriver() = default;
  virtual void Init(const DriverSetup& setup) = 0;
  // The object given to the controller; it lives as long as the driver.
  virtual CCI_Sensor* Sensor() = 0;
  // Takes over the latest values, without waiting. Called before each control step, so that readings stay what they are
  // within a step.
  virtual void Poll() = 0;
  // One for each place that values come from. A robot does not start until each was heard, and stands still while one
  // is silent for longer than the parameter timeout_s, which every sensor driver has. Empty: never silent.
  virtual std::vector<DriverSource> Sources() const { return {}; }
};

class CActuatorDriver
{
public:
  virtual ~CActuatorDriver() = default;
  virtual void Init(const DriverSetup& setup) = 0;
  virtual CCI_Actuator* Actuator() = 0;
  // Gives the hardware what the controller set last. Called after each control step.
  virtual void Push() = 0;
  // Makes the device safe: wheels stand, LEDs are dark, grippers keep what they hold. Called in place of Push while the
  // controller does not run, and at the end, also after an error. What the controller set is kept.
  virtual void Stop() = 0;
  // Where the values go, for logs: "topic rt/cmd_vel (geometry_msgs/msg/Twist)".
  virtual std::vector<std::string> Sinks() const { return {}; }
};

// For the macros below. `type`: the device's label in experiment files; `name`: of the driver, for robot files;
// `robots`: those that it is for, empty for all.
PluginDescription DescribeDriver(const std::string& type, const std::string& name, const std::string& brief,
                                 std::vector<std::string> robots = {}, std::vector<ParameterSpec> parameters = {});

template <>
PluginRegistry<CSensorDriver>& PluginRegistry<CSensorDriver>::Instance();
template <>
PluginRegistry<CActuatorDriver>& PluginRegistry<CActuatorDriver>::Instance();

template <class Interface>
struct DriverRegistration
{
  DriverRegistration(const PluginDescription& description, std::unique_ptr<Interface> (*create)())
  {
    PluginRegistry<Interface>::Instance().Add(description, create);
  }
};

}  // namespace swarmanoid

using swarmanoid::CActuatorDriver;
using swarmanoid::CSensorDriver;
using swarmanoid::DescribeDriver;

// REGISTER_SENSOR_DRIVER(CMyLight, DescribeDriver("footbot_light", "my_port", "light sensors at the serial port"))
#define REGISTER_SENSOR_DRIVER(CLASS, ...)                                                                      \
  namespace                                                                                                     \
  {                                                                                                             \
  const ::swarmanoid::DriverRegistration<::swarmanoid::CSensorDriver> driver_registration_of_##CLASS(           \
      __VA_ARGS__, []() -> std::unique_ptr<::swarmanoid::CSensorDriver> { return std::make_unique<CLASS>(); }); \
  }
#define REGISTER_ACTUATOR_DRIVER(CLASS, ...)                                                                      \
  namespace                                                                                                       \
  {                                                                                                               \
  const ::swarmanoid::DriverRegistration<::swarmanoid::CActuatorDriver> driver_registration_of_##CLASS(           \
      __VA_ARGS__, []() -> std::unique_ptr<::swarmanoid::CActuatorDriver> { return std::make_unique<CLASS>(); }); \
  }
