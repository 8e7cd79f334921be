// Drivers of lights: LED rings, beacons, the preferential direction of a footbot, the laser of an eyebot.
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "common/control_interface/eyebot/ci_eyebot_laser_actuator.h"
#include "common/control_interface/eyebot/ci_eyebot_leds_actuator.h"
#include "common/control_interface/footbot/ci_footbot_beacon_actuator.h"
#include "common/control_interface/footbot/ci_footbot_leds_actuator.h"
#include "common/control_interface/footbot/ci_footbot_preferential_direction_actuator.h"
#include "common/control_interface/handbot/ci_handbot_beacon_actuator.h"
#include "common/control_interface/handbot/ci_handbot_leds_actuator.h"
#include "common/math/elementary.h"
#include "real_robot/drivers/ros2/topic_driver.h"

namespace swarmanoid::ros2
{
namespace
{

// Publishes LEDs as an array of led x rgb, each channel 0 to 1.
class RingPublisher
{
public:
  RingPublisher(const DriverSetup& setup, std::size_t leds) : publisher_(setup, setup.parameters.Text("topic"))
  {
    std_msgs::msg::dds_::MultiArrayDimension_ led;
    led.label("led");
    led.size(static_cast<std::uint32_t>(leds));
    led.stride(static_cast<std::uint32_t>(leds * 3));
    std_msgs::msg::dds_::MultiArrayDimension_ channel;
    channel.label("rgb");
    channel.size(3);
    channel.stride(3);
    message_.layout().dim({led, channel});
    message_.data().resize(leds * 3);
  }
  void Publish(const std::vector<std::uint32_t>& colours)
  {
    for (std::size_t led = 0; led < colours.size(); ++led)
    {
      const ColorRGBA colour = ToMessage(colours[led]);
      message_.data()[3 * led] = colour.r();
      message_.data()[3 * led + 1] = colour.g();
      message_.data()[3 * led + 2] = colour.b();
    }
    publisher_.Publish(message_);
  }
  std::string Name() const { return publisher_.Name(); }

private:
  Publisher<Float32MultiArray> publisher_;
  Float32MultiArray message_;
};

template <class Interface>
class Leds : public TopicActuator<Interface, RingPublisher>
{
public:
  void Init(const DriverSetup& setup) override { this->output_.emplace(setup, colours_.size()); }
  void SetAllColours(std::uint32_t colour) override { std::ranges::fill(colours_, colour); }
  void SetColour(unsigned led, std::uint32_t colour) override { colours_.at(led) = colour; }
  void Push() override { this->output_->Publish(colours_); }
  void Stop() override { this->output_->Publish(std::vector<std::uint32_t>(colours_.size())); }

private:
  std::vector<std::uint32_t> colours_ = std::vector<std::uint32_t>(Interface::NUM_LEDS);
};

using FootbotLeds = Leds<CCI_FootBotLedsActuator>;
using EyebotLeds = Leds<CCI_EyeBotLedsActuator>;
using HandbotLeds = Leds<CCI_HandBotLedsActuator>;

PluginDescription DescribeRing(const std::string& type, const std::string& robot)
{
  return DescribeDriver(type, "ros2", "std_msgs/msg/Float32MultiArray (led, rgb) on leds", {robot},
                        {TopicParameter("topic", "leds", "Topic of the colours.")});
}

REGISTER_ACTUATOR_DRIVER(FootbotLeds, DescribeRing("footbot_leds", "footbot"))
REGISTER_ACTUATOR_DRIVER(EyebotLeds, DescribeRing("eyebot_leds", "eyebot"))
REGISTER_ACTUATOR_DRIVER(HandbotLeds, DescribeRing("handbot_leds", "handbot"))

template <class Interface>
class Beacon : public TopicActuator<Interface, Publisher<ColorRGBA>>
{
public:
  void Init(const DriverSetup& setup) override { this->output_.emplace(setup, setup.parameters.Text("topic")); }
  void SetColour(std::uint32_t colour) override { colour_ = colour; }
  void Push() override { Show(colour_); }
  void Stop() override { Show(0); }

private:
  void Show(std::uint32_t colour)
  {
    ColorRGBA message = ToMessage(colour);
    this->output_->Publish(message);
  }
  std::uint32_t colour_ = 0;
};

using FootbotBeacon = Beacon<CCI_FootBotBeaconActuator>;
using HandbotBeacon = Beacon<CCI_HandBotBeaconActuator>;

PluginDescription DescribeBeacon(const std::string& type, const std::string& robot)
{
  return DescribeDriver(type, "ros2", "std_msgs/msg/ColorRGBA on beacon", {robot},
                        {TopicParameter("topic", "beacon", "Topic of the colour.")});
}

REGISTER_ACTUATOR_DRIVER(FootbotBeacon, DescribeBeacon("footbot_beacon", "footbot"))
REGISTER_ACTUATOR_DRIVER(HandbotBeacon, DescribeBeacon("handbot_beacon", "handbot"))

class PreferentialDirection : public TopicActuator<CCI_FootBotPreferentialDirectionActuator, RingPublisher>
{
public:
  void Init(const DriverSetup& setup) override
  {
    output_.emplace(setup, kLeds);
    half_width_ = DegreesToRadians(setup.parameters.Number("width")) / 2;
    turret_.emplace(setup, setup.parameters.Text("turret_topic"), std::vector{setup.parameters.Text("turret_joint")});
  }
  void SetDirection(double angle, std::uint32_t colour) override
  {
    angle_ = angle;
    colour_ = colour;
  }
  void HideDirection() override { colour_ = 0; }

  void Push() override
  {
    // The ring turns with the turret. Without an angle, the turret counts as looking ahead.
    turret_->Poll();
    const double on_ring = angle_ - turret_->Position(0) - kSpacing / 2;
    const auto away = [on_ring](std::size_t led)
    { return std::abs(WrapAngle(on_ring - static_cast<double>(led) * kSpacing)); };
    double nearest = kPi;
    for (std::size_t led = 0; led < kLeds; ++led) nearest = std::min(nearest, away(led));
    std::vector<std::uint32_t> colours(kLeds);
    for (std::size_t led = 0; led < kLeds; ++led)
      colours[led] = away(led) <= half_width_ + 1e-9 || away(led) <= nearest ? colour_ : 0;
    output_->Publish(colours);
  }
  void Stop() override { output_->Publish(std::vector<std::uint32_t>(kLeds)); }

private:
  static constexpr std::size_t kLeds = CCI_FootBotLedsActuator::NUM_LEDS;
  static constexpr double kSpacing = 2 * kPi / kLeds;
  std::optional<JointReader> turret_;
  double half_width_ = 0;
  double angle_ = 0;
  std::uint32_t colour_ = 0;
};

REGISTER_ACTUATOR_DRIVER(
    PreferentialDirection,
    DescribeDriver("footbot_preferential_direction", "ros2", "std_msgs/msg/Float32MultiArray (led, rgb) on leds",
                   {"footbot"},
                   {TopicParameter("topic", "leds", "Topic of the colours."),
                    NumberParameter("width", "degrees", "60", "LEDs within half of it of the direction are lit."),
                    TopicParameter("turret_topic", "joint_states", "Topic of the turret's angle; it may be silent."),
                    TopicParameter("turret_joint", "turret", "Name of the turret's joint.")}))

class Laser : public CActuatorDriver, public CCI_EyeBotLaserActuator
{
public:
  void Init(const DriverSetup& setup) override
  {
    const std::string topic = setup.parameters.Text("topic");
    colour_topic_.emplace(setup, topic + "/color");
    pan_topic_.emplace(setup, topic + "/pan");
    tilt_topic_.emplace(setup, topic + "/tilt");
  }
  CCI_Actuator* Actuator() override { return this; }
  void SwitchOn() override { on_ = true; }
  void SwitchOff() override { on_ = false; }
  void SetColour(std::uint32_t colour) override { colour_ = colour; }
  void SetDirection(double pan, double tilt) override
  {
    pan_ = WrapAngle(pan);
    tilt_ = std::clamp(tilt, 0.0, MAX_TILT);
  }
  void Push() override
  {
    pan_topic_->Publish(pan_);
    tilt_topic_->Publish(tilt_);
    Shine(on_ ? colour_ : 0);
  }
  void Stop() override { Shine(0); }
  std::vector<std::string> Sinks() const override
  {
    return {colour_topic_->Name(), pan_topic_->Name(), tilt_topic_->Name()};
  }

private:
  void Shine(std::uint32_t colour)
  {
    ColorRGBA message = ToMessage(colour);
    colour_topic_->Publish(message);
  }
  std::optional<Publisher<ColorRGBA>> colour_topic_;
  std::optional<NumberPublisher> pan_topic_;
  std::optional<NumberPublisher> tilt_topic_;
  bool on_ = false;
  std::uint32_t colour_ = CCI_Colour::RED;
  double pan_ = 0;
  double tilt_ = 0;
};

REGISTER_ACTUATOR_DRIVER(
    Laser, DescribeDriver("eyebot_laser", "ros2",
                          "std_msgs/msg/ColorRGBA on laser/color, Float64 on laser/pan and laser/tilt", {"eyebot"},
                          {TopicParameter("topic", "laser", "Topics of the laser, before /color, /pan and /tilt.")}))

}  // namespace
}  // namespace swarmanoid::ros2
