// Each actuator of the simulated robot has a topic here that a node of ROS 2 writes, with the message that the driver
// of the real actuator publishes. A message is taken first and applied later, because in lock step the commands of all
// topics must have arrived before one of them acts. Numbers that are not finite and lists of a wrong length are refused
// with the name of the topic, and the run ends: a node that sends them would not work on a real robot either.
#include "real_robot/ros2_controller/device_commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "common/control_interface/ci_joints_actuator.h"
#include "common/control_interface/ci_led_ring_actuator.h"
#include "common/control_interface/ci_range_and_bearing.h"
#include "common/control_interface/eyebot/ci_eyebot_attachment_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_laser_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_leds_actuator.h"
#include "common/control_interface/footbot/ci_footbot_beacon_actuator.h"
#include "common/control_interface/footbot/ci_footbot_gripper_actuator.h"
#include "common/control_interface/footbot/ci_footbot_leds_actuator.h"
#include "common/control_interface/footbot/ci_footbot_turret_actuator.h"

namespace swarmanoid::ros2
{
namespace
{

using UInt8MultiArray = std_msgs::msg::dds_::UInt8MultiArray_;
using Topics = std::vector<std::unique_ptr<CommandTopic>>;

// Throws a mistake in a command; the handler adds the topic.
[[noreturn]] void Refuse(const std::string& what) { throw DriverError(what); }

double Finite(double value)
{
  if (!std::isfinite(value)) Refuse("a command is not a finite number");
  return value;
}

template <class Message>
class Topic : public CommandTopic
{
public:
  Topic(const DriverSetup& setup, const std::string& topic, bool reliable,
        std::function<void(const Message& message)> apply)
      : subscriber_(setup, topic, reliable), apply_(std::move(apply))
  {
  }
  bool Take() override { return subscriber_.TakeNext(); }
  void Apply() override
  {
    try
    {
      apply_(subscriber_.Latest());
    }
    catch (const DriverError& error)
    {
      throw DriverError(fmt::format("{}: {}", Name(), error.what()));
    }
  }
  void Wait(double seconds) override { subscriber_.Wait(seconds); }
  unsigned Publishers() const override { return subscriber_.Publishers(); }
  std::string Name() const override { return subscriber_.Name(); }

private:
  Subscriber<Message> subscriber_;
  std::function<void(const Message&)> apply_;
};

struct TopicSetup
{
  const CCI_Robot& robot;
  const DriverSetup& driver;
  bool reliable;

  template <class Message>
  void Add(Topics& topics, const std::string& topic, std::function<void(const Message&)> apply) const
  {
    topics.push_back(std::make_unique<Topic<Message>>(driver, topic, reliable, std::move(apply)));
  }
};

// Reads led x rgb, each channel 0 to 1.
template <class Interface>
void Leds(const TopicSetup& setup, const std::string& type, Topics& topics)
{
  CCI_LedRingActuator* leds = &setup.robot.Actuator<Interface>(type);
  setup.Add<Float32MultiArray>(
      topics, "leds",
      [leds](const Float32MultiArray& message)
      {
        const auto& data = message.data();
        if (data.size() != std::size_t{3} * leds->GetNumLeds())
          Refuse(fmt::format("a command has {} numbers; {} LEDs take {}, red, green and blue of each", data.size(),
                             leds->GetNumLeds(), 3 * leds->GetNumLeds()));
        for (unsigned led = 0; led < leds->GetNumLeds(); ++led)
        {
          ColorRGBA colour;
          colour.r(static_cast<float>(Finite(data[3 * led])));
          colour.g(static_cast<float>(Finite(data[3 * led + 1])));
          colour.b(static_cast<float>(Finite(data[3 * led + 2])));
          leds->SetColour(led, ToColour(colour));
        }
      });
}

std::uint32_t Shown(const ColorRGBA& message)
{
  for (const float channel : {message.r(), message.g(), message.b(), message.a()}) Finite(channel);
  return message.a() == 0 ? 0 : ToColour(message);
}

void Beacon(const TopicSetup& setup, const std::string& type, Topics& topics)
{
  auto* beacon = &setup.robot.Actuator<CCI_FootBotBeaconActuator>(type);
  setup.Add<ColorRGBA>(topics, "beacon", [beacon](const ColorRGBA& message) { beacon->SetColour(Shown(message)); });
}

void Gripper(const TopicSetup& setup, const std::string& type, Topics& topics)
{
  auto* gripper = &setup.robot.Actuator<CCI_FootBotGripperActuator>(type);
  setup.Add<Float64>(topics, "gripper/command",
                     [gripper](const Float64& message) { gripper->SetGripper(Finite(message.data())); });
}

void Turret(const TopicSetup& setup, const std::string& type, Topics& topics)
{
  auto* turret = &setup.robot.Actuator<CCI_FootBotTurretActuator>(type);
  setup.Add<Float64>(topics, "turret/velocity",
                     [turret](const Float64& message) { turret->SetTurretAngularVelocity(Finite(message.data())); });
}

// Reads positions or velocities of joints by name. A joint with both gets its position.
void JointCommands(const TopicSetup& setup, const std::string& type, Topics& topics)
{
  auto* joints = &setup.robot.Actuator<CCI_JointsActuator>(type);
  setup.Add<JointState>(topics, "joint_commands",
                        [joints](const JointState& message)
                        {
                          const auto& names = message.name();
                          const bool has_positions = !message.position().empty();
                          const auto& values = has_positions ? message.position() : message.velocity();
                          if (values.size() != names.size())
                            Refuse(fmt::format("a command has {} joints and {} {}", names.size(), values.size(),
                                               has_positions ? "positions" : "velocities"));
                          for (std::size_t k = 0; k < names.size(); ++k)
                          {
                            unsigned joint = 0;
                            try
                            {
                              joint = joints->GetJoint(names[k]);
                            }
                            catch (const std::invalid_argument& error)
                            {
                              Refuse(error.what());
                            }
                            has_positions ? joints->SetPosition(joint, Finite(values[k]))
                                          : joints->SetVelocity(joint, Finite(values[k]));
                          }
                        });
}

void Magnet(const TopicSetup& setup, const std::string& type, Topics& topics)
{
  auto* magnet = &setup.robot.Actuator<CCI_EyeBotAttachmentActuator>(type);
  setup.Add<Bool>(topics, "attach",
                  [magnet](const Bool& message) { message.data() ? magnet->Attach() : magnet->Detach(); });
}

void Laser(const TopicSetup& setup, const std::string& type, Topics& topics)
{
  auto* laser = &setup.robot.Actuator<CCI_EyeBotLaserActuator>(type);
  const auto pan = std::make_shared<double>(0);
  const auto tilt = std::make_shared<double>(0);
  setup.Add<ColorRGBA>(topics, "laser/color",
                       [laser](const ColorRGBA& message)
                       {
                         const std::uint32_t colour = Shown(message);
                         if (colour == 0) return laser->SwitchOff();
                         laser->SetColour(colour);
                         laser->SwitchOn();
                       });
  for (const auto& turn : {std::pair("laser/pan", pan), std::pair("laser/tilt", tilt)})
    setup.Add<Float64>(topics, turn.first,
                       [laser, pan, tilt, angle = turn.second](const Float64& message)
                       {
                         *angle = Finite(message.data());
                         laser->SetDirection(*pan, *tilt);
                       });
}

void Sender(const TopicSetup& setup, const std::string& type, Topics& topics)
{
  auto* sender = &setup.robot.Actuator<CCI_RangeAndBearingActuator>(type);
  setup.Add<UInt8MultiArray>(
      topics, "range_and_bearing/send",
      [sender](const UInt8MultiArray& message)
      {
        const auto& data = message.data();
        if (data.empty()) return sender->StopSending();
        CCI_RangeAndBearingActuator::Message bytes{};
        if (data.size() != bytes.size())
          Refuse(fmt::format("a command has {} bytes; it takes {}, or none", data.size(), bytes.size()));
        std::copy(data.begin(), data.end(), bytes.begin());
        sender->SetMessage(bytes);
      });
}

// Adds the topic of any other actuator: a number for each of its columns.
void AllColumns(const TopicSetup& setup, const std::string& type, Topics& topics)
{
  CCI_Actuator* actuator = setup.robot.GetActuator(type);
  setup.Add<Float32MultiArray>(topics, type + "/set",
                               [actuator, width = actuator->Columns().size()](const Float32MultiArray& message)
                               {
                                 const std::vector<double> values(message.data().begin(), message.data().end());
                                 if (values.size() != width)
                                   Refuse(fmt::format("a command has {} numbers; it takes {}", values.size(), width));
                                 for (const double value : values) Finite(value);
                                 actuator->SetColumns(values);
                               });
}

using TopicMaker = void (*)(const TopicSetup& setup, const std::string& type, Topics& topics);

const std::map<std::string, TopicMaker>& TopicMakers()
{
  static const std::map<std::string, TopicMaker> makers{
      {"eyebot_attachment", Magnet}, {"eyebot_laser", Laser},      {"eyebot_leds", Leds<CCI_EyeBotLedsActuator>},
      {"footbot_beacon", Beacon},    {"footbot_gripper", Gripper}, {"footbot_leds", Leds<CCI_FootBotLedsActuator>},
      {"footbot_turret", Turret},    {"joints", JointCommands},    {"range_and_bearing", Sender},
  };
  return makers;
}

}  // namespace

std::vector<std::unique_ptr<CommandTopic>> MakeCommandTopics(const CCI_Robot& robot, const DriverSetup& setup,
                                                             bool reliable)
{
  Topics topics;
  for (const std::string& type : robot.ActuatorTypes())
    if (std::ranges::find(kDrivingActuators, type) == kDrivingActuators.end())
    {
      const auto maker = TopicMakers().find(type);
      (maker == TopicMakers().end() ? AllColumns : maker->second)({robot, setup, reliable}, type, topics);
    }
  return topics;
}

}  // namespace swarmanoid::ros2
