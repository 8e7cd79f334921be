// The calls that the interfaces of devices add to those of their implementations: groups, single readings, errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/control_interface/ci_pie_camera_sensor.h"
#include "common/control_interface/ci_robot.h"
#include "common/control_interface/footbot/ci_footbot_leds_actuator.h"
#include "common/control_interface/footbot/ci_footbot_light_sensor.h"
#include "common/control_interface/footbot/ci_footbot_proximity_sensor.h"
#include "common/control_interface/handbot/ci_handbot_arms_actuator.h"
#include "common/control_interface/handbot/ci_handbot_hands_actuator.h"
#include "common/math/elementary.h"
#include "tests/world/message_of.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;

class Leds : public CCI_FootBotLedsActuator
{
public:
  void SetAllColours(std::uint32_t colour) override { colours.fill(colour); }
  void SetColour(unsigned led, std::uint32_t colour) override { colours.at(led) = colour; }
  std::array<std::uint32_t, NUM_LEDS> colours{};
};

class Arms : public CCI_HandBotArmsActuator
{
public:
  void SetArmVelocities(double left, double right) override { arms = {left, right}; }
  void SetWristVelocities(double left, double right) override { wrists = {left, right}; }
  std::array<double, 2> arms{}, wrists{};
};

class Hands : public CCI_HandBotHandsActuator
{
public:
  void Close(Hand hand) override { closed.at(hand) = true; }
  void Open(Hand hand) override { closed.at(hand) = false; }
  std::array<bool, 2> closed{true, false};
};

template <class Interface>
class Ring : public Interface
{
public:
  Ring() { std::iota(readings.begin(), readings.end(), 0.0); }
  std::span<const double, 24> GetAllSensorReadings() const override { return readings; }
  std::array<double, 24> readings{};
};

class Pie : public CCI_PieCameraSensor
{
public:
  unsigned GetNumSectors() const override { return 2; }
  std::span<const Slice> GetAllSlices(std::uint32_t) const override { return slices; }
  std::array<Slice, 2> slices{Slice{1, 1}, Slice{2, 3}};
};

TEST(DeviceInterfaces, GroupsOfActuatorsAreSetAtOnce)
{
  Leds leds;
  std::array<std::uint32_t, 12> colours{};
  std::iota(colours.begin(), colours.end(), 0x100U);
  leds.SetAllActuatorOutputs(colours);
  EXPECT_EQ(leds.colours, colours);
  EXPECT_THROW(leds.SetAllActuatorOutputs(std::vector<std::uint32_t>(11)), std::invalid_argument);

  Arms arms;
  arms.SetAllActuatorOutputs({1, 2, 3, 4});
  EXPECT_THAT(arms.arms, ElementsAre(1, 2));
  EXPECT_THAT(arms.wrists, ElementsAre(3, 4));

  Hands hands;
  hands.SetAllActuatorOutputs({false, true});
  EXPECT_THAT(hands.closed, ElementsAre(false, true));
}

TEST(DeviceInterfaces, SingleReadingsAreThoseOfTheGroupAndEndWithIt)
{
  const Ring<CCI_FootBotProximitySensor> proximity;
  EXPECT_EQ(proximity.GetProximitySensorReading(23), 23);
  EXPECT_THROW(proximity.GetProximitySensorReading(24), std::out_of_range);
  const Ring<CCI_FootBotLightSensor> light;
  EXPECT_EQ(light.GetLightSensorReading(7), 7);
  EXPECT_THROW(light.GetLightSensorReading(24), std::out_of_range);
  const Pie pie;
  EXPECT_EQ(pie.GetSlice(CCI_Colour::RED, 1).blobs, 3U);
  EXPECT_THROW(pie.GetSlice(CCI_Colour::RED, 2), std::out_of_range);
}

std::string ErrorOf(const CCI_Robot& robot, const std::string& sensor)
{
  return test::MessageOf<CCI_DeviceError>([&] { robot.GetSensor(sensor); }, "none");
}

TEST(DeviceInterfaces, ADeviceThatIsNotListedIsNamedWithThoseListedAndTheCure)
{
  CCI_Robot robot("fb", "footbot");
  EXPECT_EQ(ErrorOf(robot, "footbot_light"),
            "robot 'fb' has no sensor 'footbot_light'; its controller lists none. Add <footbot_light> to <sensors> of "
            "the controller in the experiment file");
  Ring<CCI_FootBotProximitySensor> proximity;
  Leds leds;
  robot.AddSensor("footbot_proximity", &proximity);
  robot.AddActuator("footbot_leds", &leds);
  EXPECT_EQ(ErrorOf(robot, "footbot_proximty"),
            "robot 'fb' has no sensor 'footbot_proximty'; its controller lists footbot_proximity. Add "
            "<footbot_proximty> to <sensors> of the controller in the experiment file; did you mean "
            "'footbot_proximity'?");
  EXPECT_EQ(ErrorOf(robot, "footbot_leds"),
            "robot 'fb' has no sensor 'footbot_leds'; its controller lists footbot_proximity. It lists the actuator of "
            "that name");
  EXPECT_THROW(robot.Sensor<CCI_FootBotLightSensor>("footbot_proximity"), CCI_DeviceError);
}

// The limits are those of the hand-bot in the manual of ARGoS 2.
TEST(DeviceInterfaces, JointsOfAHandbotHaveTheLimitsOfItsManual)
{
  EXPECT_DOUBLE_EQ(CCI_HandBotArmsActuator::MAX_ARM, kPi / 3);
  EXPECT_DOUBLE_EQ(CCI_HandBotArmsActuator::MAX_WRIST, kPi / 2);
}

}  // namespace
}  // namespace swarmanoid
