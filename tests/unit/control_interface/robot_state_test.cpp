// The parts of robot states other than wheels and proximity: copies keep their snapshot, and values are written once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/control_interface/behavior/ci_eyebot_state.h"
#include "common/control_interface/behavior/ci_footbot_state.h"
#include "common/control_interface/behavior/ci_handbot_state.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;

class FakeReceiver : public CCI_RangeAndBearingSensor
{
public:
  std::span<const Packet> GetAllPackets() const override { return packets; }
  std::vector<Packet> packets;
};

class FakeSender : public CCI_RangeAndBearingActuator
{
public:
  void SetMessage(const Message& message) override { calls.push_back("send " + std::to_string(message[0])); }
  void StopSending() override { calls.emplace_back("stop"); }
  std::vector<std::string> calls;
};

class FakePieCamera : public CCI_PieCameraSensor
{
public:
  unsigned GetNumSectors() const override { return 4; }
  std::span<const Slice> GetAllSlices(std::uint32_t colour) const override
  {
    return colour == CCI_Colour::GREEN ? green : nothing;
  }
  std::array<Slice, 4> nothing{};
  std::array<Slice, 4> green{Slice{0.5, 2}, Slice{}, Slice{}, Slice{1.5, 1}};
};

class FakeAccelerometer : public CCI_FootBotAccelerometerSensor
{
public:
  std::span<const double, 3> GetAllSensorReadings() const override { return readings; }
  std::array<double, 3> readings{1, 2, 9.81};
};

class FakeDirection : public CCI_FootBotPreferentialDirectionActuator
{
public:
  void SetDirection(double angle, std::uint32_t) override { calls.push_back("show " + std::to_string(angle)); }
  void HideDirection() override { calls.emplace_back("hide"); }
  std::vector<std::string> calls;
};

class FakePropellers : public CCI_EyeBotPropellersActuator
{
public:
  void SetVelocity(double, double, double, double) override { calls.emplace_back("velocity"); }
  void SetPosition(const Vector3& position, double) override { calls.push_back("to " + std::to_string(position.x())); }
  std::vector<std::string> calls;
};

class FakeGripper : public CCI_FootBotGripperSensor
{
public:
  double GetAperture() const override { return 0.5; }
  bool IsGripping() const override { return !held.empty(); }
  std::string GetHeldId() const override { return held; }
  std::string held = "prey_1";
};

class FakeBeacon : public CCI_HandBotBeaconActuator
{
public:
  void SetColour(std::uint32_t value) override { colour = value; }
  std::uint32_t colour = 0;
};

TEST(RobotState, RangeAndBearingIsTheSameForAllRobots)
{
  CCI_Robot robot("hb", "handbot");
  FakeReceiver receiver;
  FakeSender sender;
  robot.AddSensor("range_and_bearing", &receiver);
  robot.AddActuator("range_and_bearing", &sender);
  CCI_HandBotState state(&robot);
  state.Init();
  receiver.packets.resize(1);
  receiver.packets[0].range_m = 1.5;
  state.ReadSensors();
  const CCI_HandBotState copy = state;
  receiver.packets.clear();
  state.ReadSensors();
  EXPECT_EQ(state.GetRangeAndBearingPackets().size(), 0U);
  ASSERT_EQ(copy.GetRangeAndBearingPackets().size(), 1U);
  EXPECT_EQ(copy.GetRangeAndBearingPackets()[0].range_m, 1.5);

  state.WriteActuators();
  state.SetRangeAndBearingMessage({7});
  state.SetRangeAndBearingMessage({8});
  state.WriteActuators();
  state.WriteActuators();
  state.StopRangeAndBearing();
  state.WriteActuators();
  EXPECT_THAT(sender.calls, ElementsAre("send 8", "stop"));
}

TEST(RobotState, ADeviceOfAllRobotsThatIsNotListedIsNamed)
{
  CCI_Robot robot("eb", "eyebot");
  CCI_EyeBotState state(&robot);
  state.Init();
  EXPECT_THROW(state.GetRangeAndBearingPackets(), CCI_DeviceError);
  EXPECT_THROW(state.StopRangeAndBearing(), CCI_DeviceError);
}

TEST(RobotState, LedsThatAreNotListedAreNamed)
{
  CCI_Robot robot("fb", "footbot");
  CCI_FootBotState state(&robot);
  state.Init();
  EXPECT_THROW(state.SetLedColour(0, CCI_Colour::RED), CCI_DeviceError);
  EXPECT_THROW(state.SetAllLedColours(CCI_Colour::RED), CCI_DeviceError);
}

TEST(FootBotState, HoldsThePieCameraByColourAndSector)
{
  CCI_Robot robot("fb", "footbot");
  FakePieCamera camera;
  robot.AddSensor("pie_camera", &camera);
  CCI_FootBotState state(&robot);
  state.Init();
  state.ReadSensors();
  camera.green = {};
  EXPECT_EQ(state.GetNumPieCameraSectors(), 4U);
  EXPECT_EQ(state.GetPieCameraSlice(CCI_Colour::GREEN, 0).blobs, 2U);
  EXPECT_EQ(state.GetPieCameraSlice(CCI_Colour::GREEN, 3).distance_m, 1.5);
  EXPECT_EQ(state.GetPieCameraSlice(CCI_Colour::RED, 3).blobs, 0U);
  EXPECT_THROW(state.GetPieCameraSlice(CCI_Colour::BLACK, 0), std::invalid_argument);
  EXPECT_THROW(state.GetPieCameraSlice(CCI_Colour::GREEN, 4), std::out_of_range);
}

TEST(FootBotState, HoldsTheAccelerometerAndShowsADirection)
{
  CCI_Robot robot("fb", "footbot");
  FakeAccelerometer accelerometer;
  FakeDirection direction;
  robot.AddSensor("footbot_accelerometer", &accelerometer);
  robot.AddActuator("footbot_preferential_direction", &direction);
  CCI_FootBotState state(&robot);
  state.Init();
  state.ReadSensors();
  EXPECT_THAT(state.GetAcceleration(), ElementsAre(1, 2, 9.81));
  state.ShowDirection(0.5, CCI_Colour::RED);
  state.WriteActuators();
  state.HideDirection();
  state.WriteActuators();
  EXPECT_THAT(direction.calls, ElementsAre("show 0.500000", "hide"));
}

TEST(FootBotState, HoldsWhatTheGripperHeldWhenItWasRead)
{
  CCI_Robot robot("fb", "footbot");
  FakeGripper gripper;
  CCI_FootBotState state(&robot);
  state.Init();
  EXPECT_THROW(state.GetHeldId(), CCI_DeviceError);
  robot.AddSensor("footbot_gripper", &gripper);
  state.Init();
  state.ReadSensors();
  gripper.held.clear();
  EXPECT_TRUE(state.IsGripping());
  EXPECT_EQ(state.GetHeldId(), "prey_1");
  EXPECT_EQ(state.GetGripperAperture(), 0.5);
}

TEST(EyeBotState, OfVelocityAndPositionTheLaterOneCounts)
{
  CCI_Robot robot("eb", "eyebot");
  FakePropellers propellers;
  robot.AddActuator("eyebot_propellers", &propellers);
  CCI_EyeBotState state(&robot);
  state.Init();
  state.SetVelocity(1, 0, 0, 0);
  state.SetPosition({3, 0, 1}, 0);
  state.WriteActuators();
  state.SetPosition({4, 0, 1}, 0);
  state.SetVelocity(1, 0, 0, 0);
  state.WriteActuators();
  EXPECT_THAT(propellers.calls, ElementsAre("to 3.000000", "velocity"));
}

TEST(HandBotState, JointsThatAreNotListedAreNamed)
{
  CCI_Robot robot("hb", "handbot");
  CCI_HandBotState state(&robot);
  state.Init();
  EXPECT_THROW(state.GetJoint(CCI_HandBotJointsSensor::HOLDS_LEFT), CCI_DeviceError);
  EXPECT_THROW(state.IsHolding(CCI_HandBotHandsActuator::LEFT), CCI_DeviceError);
  EXPECT_THROW(state.GetHeldId(CCI_HandBotHandsActuator::LEFT), CCI_DeviceError);
}

TEST(HandBotState, LightsItsBeacon)
{
  CCI_Robot robot("hb", "handbot");
  FakeBeacon beacon;
  robot.AddActuator("handbot_beacon", &beacon);
  CCI_HandBotState state(&robot);
  state.Init();
  state.SetBeaconColour(CCI_Colour::CYAN);
  EXPECT_EQ(beacon.colour, 0U);
  state.WriteActuators();
  EXPECT_EQ(beacon.colour, CCI_Colour::CYAN);
}

}  // namespace
}  // namespace swarmanoid
