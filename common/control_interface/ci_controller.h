// CCI_Controller: the base of every robot controller. The same class runs in the simulator and on the robot.
//
// A controller library holds one or more such classes. REGISTER_CONTROLLER registers each with its tag in <controllers>
// and the table of its <parameters>. The runtime makes one object for each robot, calls Init once, ControlStep every
// tick, and Destroy at the end. All calls come from one thread unless StepsInParallel returns true.
#pragma once

#include <iosfwd>
#include <memory>
#include <string>

#include "common/configuration/configuration_tree.h"
#include "common/control_interface/ci_robot.h"
#include "common/plugins/registry.h"

namespace swarmanoid
{

class CCI_Controller
{
public:
  static constexpr int RETURN_OK = 0;
  static constexpr int RETURN_ERROR = 1;

  virtual ~CCI_Controller() = default;

  // Gets the <parameters> of the controller, and looks up its devices. If the controller declared its parameters, the
  // tree was checked and has all of them with their defaults. A result other than RETURN_OK, and any exception, stops
  // the experiment with the robot's name. A ConfigurationError is shown as a mistake of the file.
  virtual int Init(const TConfigurationTree t_tree) = 0;
  // The host calls it once in each tick: it reads the sensors and sets the actuators.
  virtual void ControlStep() = 0;
  // The host calls it once, at the end of the run.
  virtual void Destroy() {}

  // Returns false if the controller cannot be saved; checkpoints of the run are then refused. Runs that continue from a
  // checkpoint need the state between ticks. A controller without state overrides only HasState.
  virtual bool HasState() const { return false; }
  // Saves the state between ticks.
  virtual void SaveState(std::ostream&) const {}
  // Loads what SaveState has saved.
  virtual void LoadState(std::istream&) {}

  // Returns the state of the controller in a few words, which visualisers show beside the robot. A controller need not
  // have it.
  virtual std::string StatusText() const { return {}; }
  // Returns the current state of the controller's state machine, for visualisers. Controllers made of behaviours or
  // derived from FSM have it.
  virtual std::string StateName() const;

  // Returns true if the controller reads some parameters after Init or only sometimes. Otherwise a parameter that Init
  // did not read is refused as misspelt. Only for controllers that declare no parameters.
  virtual bool ReadsParametersLater() const { return false; }

  // Returns true if ControlStep of several robots may run at the same time in threads of one process (`--threads`). It
  // must then share no data that another robot's step writes: no static variables and no common files. All objects of
  // the Common Interface belong to one robot. If false, robots step one after the other.
  virtual bool StepsInParallel() const { return false; }

  CCI_Robot* GetRobot() const { return robot_; }
  // The runtime calls this before Init.
  void SetRobot(CCI_Robot* robot) { robot_ = robot; }

private:
  CCI_Robot* robot_ = nullptr;
};

template <>
PluginRegistry<CCI_Controller>& PluginRegistry<CCI_Controller>::Instance();

// The macro REGISTER_CONTROLLER makes one of these for each class.
struct ControllerRegistration
{
  using Create = std::unique_ptr<CCI_Controller> (*)();

  ControllerRegistration(Create create, const char* class_name, PluginDescription description);
  // `brief` is one line for `swarmanoid list plugins`; without it, the class name is shown.
  ControllerRegistration(Create create, const char* class_name, const char* label, const char* brief = nullptr);
};

}  // namespace swarmanoid

using swarmanoid::CCI_Controller;
using swarmanoid::ParameterType;

// REGISTER_CONTROLLER(CSampleFootBotController, "sample_footbot_controller") may have a third argument: one line that
// says what the controller does. The other form has the table of its parameters, so that mistakes in them are found
// before a run:
//
//   REGISTER_CONTROLLER(CWalker, {.label = "walker",
//                                 .brief = "walks straight on",
//                                 .parameters = {{.name = "speed",
//                                                 .unit = "m/s",
//                                                 .default_value = "0.1",
//                                                 .description = "Forward velocity.",
//                                                 .minimum = 0,
//                                                 .maximum = 0.3}}})
#define REGISTER_CONTROLLER(CLASS, ...)                                                                    \
  namespace                                                                                                \
  {                                                                                                        \
  const ::swarmanoid::ControllerRegistration registration_of_##CLASS(                                      \
      []() -> std::unique_ptr<::swarmanoid::CCI_Controller> { return std::make_unique<CLASS>(); }, #CLASS, \
      __VA_ARGS__);                                                                                        \
  }

// The name of the framework in the code of its first users: `using namespace ahss;`.
namespace ahss
{
using namespace swarmanoid;
}
