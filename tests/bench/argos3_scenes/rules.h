// The controllers of the scenes of tests/bench/beside_argos3, written for ARGoS3's interface alone: the same sources
// are built against ARGoS3 and against this simulator. Loop functions (measures.cpp) read the public members.
#pragma once

#include <argos3/core/control_interface/ci_controller.h>
#include <argos3/core/utility/math/rng.h>
#include <argos3/core/utility/math/vector2.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_gripper_actuator.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_light_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_motor_ground_sensor.h>
#include <argos3/plugins/robots/foot-bot/control_interface/ci_footbot_proximity_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_battery_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_colored_blob_omnidirectional_camera_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_differential_steering_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_leds_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_proximity_sensor.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_actuator.h>
#include <argos3/plugins/robots/generic/control_interface/ci_range_and_bearing_sensor.h>

// A robot that drives and avoids obstacles; the base of most rules.
class CDriver : public argos::CCI_Controller
{
public:
  void Init(argos::TConfigurationNode& node) override;

protected:
  // The mean of the proximity readings as vectors, in the frame of the robot.
  argos::CVector2 Obstacle() const;
  // The direction of the light as a vector of length 1, or 0 in the dark.
  argos::CVector2 Light() const;
  // Drives in a direction given in the frame of the robot: turns on the spot beyond a right angle, else in an arc.
  void Steer(const argos::CVector2& direction);
  // Steers away from an obstacle nearer than some 4 cm, else in the direction.
  void SteerAround(const argos::CVector2& direction);

  argos::CCI_DifferentialSteeringActuator* wheels_ = nullptr;
  argos::CCI_FootBotProximitySensor* proximity_ = nullptr;
  argos::CCI_FootBotLightSensor* light_ = nullptr;
  argos::CRandom::CRNG* random_ = nullptr;
  argos::Real speed_ = 10;  // cm/s
};

// The rule of the diffusion of ARGoS3's examples.
class CDiffusion : public CDriver
{
public:
  void Init(argos::TConfigurationNode& node) override;
  void ControlStep() override;

private:
  argos::Real delta_ = 0.1;
};

// Explores, and carries items to a nest that is grey ground beside lights.
class CForager : public CDriver
{
public:
  void Init(argos::TConfigurationNode& node) override;
  void ControlStep() override;

  bool carries_ = false;  // set by the loop functions

private:
  argos::CCI_FootBotMotorGroundSensor* ground_ = nullptr;
};

// Keeps a distance to the beacons that it sees, by the force of Lennard and Jones, and follows a light.
class CFlocker : public CDriver
{
public:
  void Init(argos::TConfigurationNode& node) override;
  void ControlStep() override;

private:
  argos::CCI_ColoredBlobOmnidirectionalCameraSensor* camera_ = nullptr;
  argos::Real distance_ = 75;  // cm
};

// Flashes with a period of 100 steps; flashes of others advance its phase.
class CFirefly : public argos::CCI_Controller
{
public:
  void Init(argos::TConfigurationNode& node) override;
  void ControlStep() override;

  bool flashes_ = false;

private:
  argos::CCI_LEDsActuator* leds_ = nullptr;
  argos::CCI_ColoredBlobOmnidirectionalCameraSensor* camera_ = nullptr;
  argos::UInt32 phase_ = 0;
};

// Drives ahead, grips after some steps what is there, pulls it back, and lets it go.
class CPuller : public CDriver
{
public:
  void Init(argos::TConfigurationNode& node) override;
  void ControlStep() override;

private:
  argos::CCI_FootBotGripperActuator* gripper_ = nullptr;
  int step_ = 0;
};

// Drives at random, and stops beside others: the more it hears, the longer (probabilistic aggregation).
class CAggregator : public CDriver
{
public:
  void Init(argos::TConfigurationNode& node) override;
  void ControlStep() override;

private:
  argos::CCI_RangeAndBearingSensor* ears_ = nullptr;
  bool rests_ = false;
};

// Drives to a light, around obstacles.
class CPhototaxis : public CDriver
{
public:
  void ControlStep() override;
};

// Explores, and becomes the next link of a chain of robots that begins at the nest.
class CChainLink : public CDriver
{
public:
  void Init(argos::TConfigurationNode& node) override;
  void ControlStep() override;

  int place_ = 0;  // in the chain; 0: explores, 1: the nest

private:
  argos::CCI_RangeAndBearingActuator* voice_ = nullptr;
  argos::CCI_RangeAndBearingSensor* ears_ = nullptr;
  bool is_nest_ = false;
};

// Tells its number of hops to a source: one more than the least that it hears.
class CHopCounter : public CDriver
{
public:
  void Init(argos::TConfigurationNode& node) override;
  void ControlStep() override;

  static constexpr int kFar = 255;
  int hops_ = kFar;

private:
  argos::CCI_RangeAndBearingActuator* voice_ = nullptr;
  argos::CCI_RangeAndBearingSensor* ears_ = nullptr;
  bool is_source_ = false;
};

// Drives about until its battery is low, then to the light, where loop functions charge it.
class CPowered : public CDriver
{
public:
  void Init(argos::TConfigurationNode& node) override;
  void ControlStep() override;

  bool wants_charge_ = false;
  argos::Real charge_ = 1;

private:
  argos::CCI_BatterySensor* battery_ = nullptr;
};

// Diffuses, and reads and writes every device that a forager of published experiments has.
class CAllDevices : public CDiffusion
{
public:
  void Init(argos::TConfigurationNode& node) override;
  void ControlStep() override;

private:
  argos::CCI_FootBotMotorGroundSensor* ground_ = nullptr;
  argos::CCI_ColoredBlobOmnidirectionalCameraSensor* camera_ = nullptr;
  argos::CCI_RangeAndBearingActuator* voice_ = nullptr;
  argos::CCI_RangeAndBearingSensor* ears_ = nullptr;
  argos::UInt8 step_ = 0;
};

// An e-puck that turns left while something is before it.
class CEPuckAvoider : public argos::CCI_Controller
{
public:
  void Init(argos::TConfigurationNode& node) override;
  void ControlStep() override;

private:
  argos::CCI_DifferentialSteeringActuator* wheels_ = nullptr;
  argos::CCI_ProximitySensor* proximity_ = nullptr;
};
