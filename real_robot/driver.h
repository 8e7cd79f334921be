// Drivers: the sensors and actuators of a real robot. One object serves one device of the robot on which the program
// swarmanoid_robot runs. The controller uses it by the same CCI_ interface as in the simulator. Drivers are plug-ins in
// a library that the robot program loads. All calls come from the thread that runs the controller.
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

// The arguments for making a driver.
struct DriverSetup
{
  Parameters parameters;   // the driver's parameters from the robot file
  std::string robot_id;    // the robot's id in the logs
  std::string robot_kind;  // "footbot", "eyebot" or "handbot"
  std::string name_space;  // put before names of topics; may be empty
  double tick_seconds;     // duration of one control step
};

// A driver cannot work, for example without a port or a network. what() gives the reason and the cure. It ends the
// robot program.
class DriverError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

// A source of values of a sensor driver, for logs and for detecting silence.
struct DriverSource
{
  std::string name;      // "topic rt/scan (sensor_msgs/msg/LaserScan)"
  bool heard = false;    // whether a value ever came
  double silence_s = 0;  // since the latest value, or since Init
};

class CSensorDriver
{
public:
  virtual ~CSensorDriver() = default;
  // Opens the device. It is called once, before all other functions. Throws ConfigurationError for a wrong parameter,
  // and DriverError if the device does not work.
  virtual void Init(const DriverSetup& setup) = 0;
  // Returns the object for the controller. It must live as long as the driver.
  virtual CCI_Sensor* Sensor() = 0;
  // Takes the latest values without waiting. It is called before each control step, so that readings do not change
  // within a step. Throws DriverError.
  virtual void Poll() = 0;
  // Returns one entry for each source of values. A robot does not start until each was heard. It stops while one is
  // silent for longer than the parameter timeout_s, which every sensor driver has. Empty: never silent.
  virtual std::vector<DriverSource> Sources() const { return {}; }
};

class CActuatorDriver
{
public:
  virtual ~CActuatorDriver() = default;
  // Opens the device. It is called once, before all other functions. Throws ConfigurationError for a wrong parameter,
  // and DriverError if the device does not work.
  virtual void Init(const DriverSetup& setup) = 0;
  // Returns the object for the controller. It must live as long as the driver.
  virtual CCI_Actuator* Actuator() = 0;
  // Sends the values that the controller set last to the hardware. It is called after each control step. Throws
  // DriverError.
  virtual void Push() = 0;
  // Makes the device safe: wheels stop, LEDs go dark, grippers keep their objects. It is called instead of Push while
  // the controller does not run, and at the end, also after an error. The values of the controller are kept.
  virtual void Stop() = 0;
  // Returns the destinations of the values, for logs: "topic rt/cmd_vel (geometry_msgs/msg/Twist)".
  virtual std::vector<std::string> Sinks() const { return {}; }
};

// Describes a driver, for the macros below. `type` is the device's label in experiment files, `name` that of the driver
// in robot files, and `robots` has the kinds that it supports, empty for all.
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
// registers a driver.
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
