// CCI_FootBotState: the robot state of a footbot. Getters and setters of devices that the controller does not list
// throw CCI_DeviceError.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "common/control_interface/behavior/ci_seeing_robot_state.h"
#include "common/control_interface/ci_pie_camera_sensor.h"
#include "common/control_interface/footbot/ci_footbot_accelerometer_sensor.h"
#include "common/control_interface/footbot/ci_footbot_beacon_actuator.h"
#include "common/control_interface/footbot/ci_footbot_encoders_sensor.h"
#include "common/control_interface/footbot/ci_footbot_gripper_actuator.h"
#include "common/control_interface/footbot/ci_footbot_gripper_sensor.h"
#include "common/control_interface/footbot/ci_footbot_ground_sensor.h"
#include "common/control_interface/footbot/ci_footbot_leds_actuator.h"
#include "common/control_interface/footbot/ci_footbot_light_sensor.h"
#include "common/control_interface/footbot/ci_footbot_omnidirectional_camera_sensor.h"
#include "common/control_interface/footbot/ci_footbot_preferential_direction_actuator.h"
#include "common/control_interface/footbot/ci_footbot_proximity_sensor.h"
#include "common/control_interface/footbot/ci_footbot_turret_actuator.h"
#include "common/control_interface/footbot/ci_footbot_turret_encoder_sensor.h"
#include "common/control_interface/footbot/ci_footbot_turret_torque_sensor.h"
#include "common/control_interface/footbot/ci_footbot_wheels_actuator.h"

namespace swarmanoid
{

class CCI_FootBotState : public CCI_SeeingRobotState<CCI_FootBotLedsActuator>
{
public:
  static constexpr unsigned NUM_PROXIMITY_SENSORS = CCI_FootBotProximitySensor::NUM_SENSORS;
  static constexpr unsigned NUM_LIGHT_SENSORS = CCI_FootBotLightSensor::NUM_SENSORS;
  static constexpr unsigned NUM_GROUND_SENSORS = CCI_FootBotGroundSensor::NUM_SENSORS;

  explicit CCI_FootBotState(CCI_Robot* robot)
      : CCI_SeeingRobotState(robot, "footbot_omnidirectional_camera", "footbot_leds")
  {
  }

  // Looks up the devices that the controller lists. Call it once, before the first tick.
  void Init();
  // ReadSensors is called at the start of a control step, and WriteActuators at its end.
  void ReadSensors();
  void WriteActuators();

  // Sensors. Angles are in radians counter-clockwise from the front, distances in metres.
  void GetAllProximitySensorReadings(double* readings) const;  // NUM_PROXIMITY_SENSORS values, 0..1
  double GetProximitySensorReading(unsigned sensor) const;
  static double GetProximitySensorAngle(unsigned sensor) { return CCI_FootBotProximitySensor::AngleOf(sensor); }
  void GetAllLightSensorReadings(double* readings) const;  // NUM_LIGHT_SENSORS values, 0..1
  static double GetLightSensorAngle(unsigned sensor) { return CCI_FootBotLightSensor::AngleOf(sensor); }
  void GetAllGroundSensorReadings(double* readings) const;  // NUM_GROUND_SENSORS values, 0..1
  std::uint32_t GetFloorColour() const;                     // 0xRRGGBB under the centre
  // See CCI_PieCameraSensor. The colour is a CCI_Colour other than black.
  unsigned GetNumPieCameraSectors() const;
  const CCI_PieCameraSensor::Slice& GetPieCameraSlice(std::uint32_t colour, unsigned sector) const;
  bool IsGripping() const;
  double GetGripperAperture() const;     // radians, 0 is closed
  const std::string& GetHeldId() const;  // id of the gripped entity, see CCI_FootBotGripperSensor
  double GetTurretAngle() const;
  const std::array<double, 3>& GetTurretTorque() const;     // see CCI_FootBotTurretTorqueSensor
  const std::array<double, 2>& GetWheelVelocities() const;  // measured {left, right}, rad/s
  const std::array<double, 3>& GetAcceleration() const;     // see CCI_FootBotAccelerometerSensor

  // Actuators. The getters return the value that was last set on this state.
  void SetFootBotWheelsAngularVelocity(double left, double right);  // rad/s
  void SetFootBotWheelsLinearVelocity(double left, double right);   // m/s
  void GetFootBotWheelsAngularVelocity(double& left, double& right) const;
  bool HasNewWheelVelocity() const { return wheels_.IsPending(); }
  void SetGripper(double closed);  // 0 open .. 1 closed
  double GetGripper() const { return gripper_.Get(); }
  void SetTurretAngularVelocity(double velocity);  // rad/s
  void SetBeaconColour(std::uint32_t colour);
  void ShowDirection(double angle, std::uint32_t colour);  // on the LED ring
  void HideDirection();

private:
  struct Devices
  {
    CCI_FootBotProximitySensor* proximity = nullptr;
    CCI_FootBotLightSensor* light = nullptr;
    CCI_FootBotGroundSensor* ground = nullptr;
    CCI_FootBotGripperSensor* gripper_sensor = nullptr;
    CCI_FootBotTurretEncoderSensor* turret_encoder = nullptr;
    CCI_FootBotTurretTorqueSensor* turret_torque = nullptr;
    CCI_FootBotEncodersSensor* encoders = nullptr;
    CCI_PieCameraSensor* pie_camera = nullptr;
    CCI_FootBotAccelerometerSensor* accelerometer = nullptr;
    CCI_FootBotWheelsActuator* wheels = nullptr;
    CCI_FootBotGripperActuator* gripper = nullptr;
    CCI_FootBotTurretActuator* turret = nullptr;
    CCI_FootBotBeaconActuator* beacon = nullptr;
    CCI_FootBotPreferentialDirectionActuator* direction = nullptr;
  };
  struct Direction
  {
    bool shown = false;
    double angle = 0;
    std::uint32_t colour = 0;
  };

  Devices devices_;

  std::array<double, NUM_PROXIMITY_SENSORS> proximity_{};
  std::array<double, NUM_LIGHT_SENSORS> light_{};
  std::array<double, NUM_GROUND_SENSORS> ground_{};
  std::uint32_t floor_colour_ = 0;
  bool gripping_ = false;
  double aperture_ = 0;
  std::string held_id_;
  double turret_angle_ = 0;
  std::array<double, 3> turret_torque_{};
  std::array<double, 2> wheel_velocities_{};
  std::array<double, 3> acceleration_{};
  // It has the sectors of each colour, one colour after the other, in the order of kPieColours.
  std::vector<CCI_PieCameraSensor::Slice> pie_;

  PendingValue<std::array<double, 2>> wheels_;
  PendingValue<double> gripper_;
  PendingValue<double> turret_;
  PendingValue<std::uint32_t> beacon_;
  PendingValue<Direction> direction_;
};

}  // namespace swarmanoid

using swarmanoid::CCI_FootBotState;
