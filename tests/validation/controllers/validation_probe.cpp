// Executes a list of commands, tick by tick, and writes the readings of its sensors as lines of CSV, so that a script
// can compare them with closed forms.
#include <charconv>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "ci_controller.h"
#include "ci_directional_leds_actuator.h"
#include "ci_floor_field.h"
#include "ci_joints_actuator.h"
#include "ci_radio.h"
#include "ci_range_and_bearing.h"
#include "ci_wheels_actuator.h"
#include "eyebot/ci_eyebot_laser_actuator.h"
#include "eyebot/ci_eyebot_propellers_actuator.h"
#include "footbot/ci_footbot_beacon_actuator.h"
#include "footbot/ci_footbot_gripper_actuator.h"
#include "footbot/ci_footbot_leds_actuator.h"
#include "footbot/ci_footbot_preferential_direction_actuator.h"
#include "footbot/ci_footbot_turret_actuator.h"
#include "footbot/ci_footbot_wheels_actuator.h"
#include "handbot/ci_handbot_arms_actuator.h"
#include "handbot/ci_handbot_head_actuator.h"
#include "handbot/ci_handbot_rope_actuator.h"

using namespace swarmanoid;

class CValidationProbe : public CCI_Controller
{
public:
  int Init(const TConfigurationTree t_tree) override
  {
    std::istringstream commands(t_tree.GetText("commands"));
    for (std::string line; std::getline(commands, line, ';');)
    {
      std::istringstream words(line);
      Command command;
      if (!(words >> command.first >> command.last >> command.device)) continue;
      for (double value = 0; words >> value;) command.values.push_back(value);
      command.values.resize(10);
      commands_.push_back(command);
    }
    std::istringstream sensors(t_tree.GetText("sensors"));
    for (std::string sensor; sensors >> sensor;) sensors_[sensor] = GetRobot()->GetSensor(sensor);
    draws_ = t_tree.GetInteger("draws");
    const std::string folder = t_tree.GetText("folder");
    if (!sensors_.empty() || draws_ > 0) file_.open(folder + "/" + GetRobot()->GetId() + ".csv");
    if (file_.is_open() && !file_) throw std::runtime_error("cannot write to " + folder);
    return RETURN_OK;
  }

  void ControlStep() override
  {
    const auto tick = static_cast<long long>(GetRobot()->GetTick());
    // A tick without readings gets a line, too.
    Write(tick, "probe", "tick", static_cast<double>(tick));
    for (const auto& [sensor, device] : sensors_)
    {
      std::vector<CCI_Reading> readings;
      device->Describe(readings);
      for (const CCI_Reading& reading : readings) Write(tick, sensor, reading.name, reading.value);
    }
    for (long long i = 0; i < draws_; ++i) Write(tick, "random", "uniform", GetRobot()->GetRandom().Uniform());
    for (long long i = 0; i < draws_; ++i) Write(tick, "random", "gaussian", GetRobot()->GetRandom().Gaussian());
    for (const Command& command : commands_)
      if (command.first <= tick && tick <= command.last) Do(command);
  }

private:
  struct Command
  {
    long long first = 0;  // ticks in which it is done
    long long last = 0;
    std::string device;
    std::vector<double> values;
  };

  void Write(long long tick, const std::string& sensor, const std::string& name, double value)
  {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
    file_ << tick << ',' << sensor << ',' << name << ',' << std::string_view(digits, end) << '\n';
  }

  void Do(const Command& command)
  {
    const auto& values = command.values;
    const auto& robot = *GetRobot();
    const auto colour = static_cast<std::uint32_t>(values[0]);
    if (command.device == "footbot_wheels")
      robot.Actuator<CCI_FootBotWheelsActuator>("footbot_wheels").SetFootBotWheelsLinearVelocity(values[0], values[1]);
    else if (command.device == "wheels")
      robot.Actuator<CCI_WheelsActuator>("wheels").SetLinearVelocity(values[0], values[1]);
    else if (command.device == "floor_field")
      robot.Actuator<CCI_FloorFieldActuator>("floor_field").SetRate(values[0]);
    else if (command.device == "footbot_gripper")
      robot.Actuator<CCI_FootBotGripperActuator>("footbot_gripper").SetGripper(values[0]);
    else if (command.device == "footbot_turret")
      robot.Actuator<CCI_FootBotTurretActuator>("footbot_turret").SetTurretAngularVelocity(values[0]);
    else if (command.device == "footbot_leds")
      robot.Actuator<CCI_FootBotLedsActuator>("footbot_leds").SetAllColours(colour);
    else if (command.device == "directional_leds")
      robot.Actuator<CCI_DirectionalLedsActuator>("directional_leds")
          .SetColour(static_cast<unsigned>(values[1]), colour);
    else if (command.device == "footbot_preferential_direction")
      robot.Actuator<CCI_FootBotPreferentialDirectionActuator>("footbot_preferential_direction")
          .SetDirection(values[1], colour);
    else if (command.device == "handbot_head")
      robot.Actuator<CCI_HandBotHeadActuator>("handbot_head").SetHeadAngularVelocity(values[0]);
    else if (command.device == "handbot_arms")
      robot.Actuator<CCI_HandBotArmsActuator>("handbot_arms")
          .SetAllActuatorOutputs({values[0], values[1], values[2], values[3]});
    else if (command.device == "footbot_beacon")
      robot.Actuator<CCI_FootBotBeaconActuator>("footbot_beacon").SetColour(colour);
    else if (command.device == "eyebot_propellers")
      robot.Actuator<CCI_EyeBotPropellersActuator>("eyebot_propellers")
          .SetVelocity(values[0], values[1], values[2], values[3]);
    else if (command.device == "eyebot_laser")
    {
      auto& laser = robot.Actuator<CCI_EyeBotLaserActuator>("eyebot_laser");
      laser.SetDirection(values[0], values[1]);
      laser.SwitchOn();
    }
    else if (command.device == "handbot_rope")
    {
      auto& rope = robot.Actuator<CCI_HandBotRopeActuator>("handbot_rope");
      rope.Launch();
      rope.SetWinchVelocity(values[0]);
    }
    else if (command.device == "range_and_bearing")
    {
      CCI_RangeAndBearingActuator::Message message;
      message.fill(static_cast<std::uint8_t>(values[0]));
      robot.Actuator<CCI_RangeAndBearingActuator>("range_and_bearing").SetMessage(message);
    }
    else if (command.device == "radio")
      robot.Actuator<CCI_RadioActuator>("radio").Send(
          std::vector<std::uint8_t>(static_cast<std::size_t>(values[0]), 1));
    else if (command.device == "joints")
    {
      auto& joints = robot.Actuator<CCI_JointsActuator>("joints");
      joints.SetAllActuatorOutputs(std::span(values).first(joints.GetNumJoints()));
    }
    else
      throw std::invalid_argument("no command for the actuator " + command.device);
  }

  std::vector<Command> commands_;
  std::map<std::string, const CCI_Sensor*> sensors_;
  long long draws_ = 0;
  std::ofstream file_;
};

REGISTER_CONTROLLER(CValidationProbe,
                    {.label = "validation_probe",
                     .brief = "does what a list of commands says, and writes what its sensors read",
                     .parameters = {{.name = "commands",
                                     .type = ParameterType::kText,
                                     .default_value = "",
                                     .description = "First tick, last tick, actuator and values of each command, with "
                                                    "semicolons between them."},
                                    {.name = "sensors",
                                     .type = ParameterType::kText,
                                     .default_value = "",
                                     .description = "The sensors that are written, with blanks between them."},
                                    {.name = "draws",
                                     .type = ParameterType::kInteger,
                                     .default_value = "0",
                                     .description = "Uniform and normal numbers that are written in each tick.",
                                     .minimum = 0},
                                    {.name = "folder",
                                     .type = ParameterType::kPath,
                                     .default_value = ".",
                                     .description = "Folder of the files, one for each robot."}}})
