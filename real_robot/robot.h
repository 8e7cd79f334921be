// Robot: a controller with the drivers of its devices, on one real robot. It corresponds to the controller host of the
// simulator: it loads the same library and calls it in the same way. The robot program uses it from one thread.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/control_interface/ci_controller.h"
#include "common/control_interface/ci_robot.h"
#include "real_robot/driver.h"
#include "real_robot/robot_file.h"

namespace swarmanoid
{

// A controller failed. what() names the robot, the step and the reason.
class RobotError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

// The first function loads the libraries of the drivers. The second one returns lines for the user about those for a
// device; "" for all.
void LoadDriverLibraries(const RobotConfiguration& configuration);
std::string DriverList();

class Robot
{
public:
  // Loads the libraries and makes the drivers and the controller, without calling its Init. Throws ConfigurationError
  // or DriverError.
  explicit Robot(RobotConfiguration configuration);
  // Stops the devices; an error of a driver is lost then.
  ~Robot();
  Robot(const Robot&) = delete;
  Robot& operator=(const Robot&) = delete;

  // Takes the latest values of all sensors.
  void Poll();
  // Returns the first sensor whose source was never heard, or is silent for longer than its timeout: "sensor
  // 'footbot_proximity': topic … is silent for 1.2 s". Empty: all sensors work.
  std::string NotHeard() const;
  std::string Silent() const;

  // Calls Init of the controller. Throws RobotError if it fails.
  void Start();
  // Does one control step with the values of the latest Poll, then calls Push of all actuators. Throws RobotError.
  void Tick();
  // Calls Stop of all actuators, so that the robot stands.
  void Stop();
  // Calls Stop, and once Destroy of the controller.
  void End();

  const RobotConfiguration& Configuration() const { return configuration_; }
  // Returns a line for each device: its driver, and the sources or destinations of its values.
  std::vector<std::string> Wiring() const;

private:
  struct Sensor
  {
    const RobotDevice* device;
    std::string driver_name;
    std::unique_ptr<CSensorDriver> driver;
    double timeout_s;
  };
  struct Actuator
  {
    const RobotDevice* device;
    std::string driver_name;
    std::unique_ptr<CActuatorDriver> driver;
  };

  void BeginStep(std::uint64_t step_stream);

  RobotConfiguration configuration_;
  CCI_Robot interface_;
  std::vector<Sensor> sensors_;
  std::vector<Actuator> actuators_;
  const PluginRegistry<CCI_Controller>::Entry* controller_entry_ = nullptr;
  std::unique_ptr<CCI_Controller> controller_;
  std::uint64_t steps_ = 0;
  bool started_ = false;
  bool ended_ = false;
};

}  // namespace swarmanoid
