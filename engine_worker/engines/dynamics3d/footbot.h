// The footbot in 3D: a wheeled robot with a turret and a gripper on it. The turret has no mass. Its angle places the
// gripper, and its motor drives the joint of a gripped body.
#pragma once

#include "common/plugin_descriptions/robot_parts.h"
#include "engine_worker/engines/dynamics3d/grasp.h"
#include "engine_worker/engines/dynamics3d/wheeled.h"

namespace swarmanoid::dynamics3d
{

// Lengths are in metres, masses in kilograms. Radius, height, wheels and the total mass of 1.6 kg are those of the
// ARGoS 3 model. The height of the centre of mass (batteries low in the base), the share and inertia of the wheels, and
// the torques are our assumptions.
struct FootbotShape
{
  static constexpr double kRadius = 0.085036758;
  static constexpr double kHeight = 0.146899733;
  static constexpr double kClearance = 0.015;
  static constexpr double kWheelRadius = 0.029112741;
  static constexpr double kHalfTrack = 0.07;
  static constexpr double kCasterRadius = 0.01;
  static constexpr double kCasterReach = 0.075;
  static constexpr double kChassisMass = 1.2;
  static constexpr double kWheelMass = 0.2;  // with motor and tread
  static constexpr double kMass = kChassisMass + 2 * kWheelMass;
  static constexpr double kCentreOfMass = 0.05;
  static constexpr double kGripperHeight = 0.085;
  static constexpr double kFreeSpeed = 0.6;     // m/s: twice the speed of the robot
  static constexpr double kTurretTorque = 1.5;  // N m
  static constexpr double kTractionRange = 25;  // N: the torque sensor reads 1 there, and at the turret's torque
};

class FootbotModel : public WheeledModel
{
public:
  FootbotModel(Scene& scene, const CSwarmanoidSpaceEntity& entity);

  void Place(const Pose& pose) override;
  void Command(std::string_view channel, std::span<const double> values) override;
  void Sense(std::string_view channel, std::span<double> values) const override;
  void BeginTick() override;
  void BeforeStep(double seconds) override;
  void AfterStep(double seconds) override;
  void Report(AttributeReport& report) const override;
  void Save(ByteWriter& state) const override;
  void Load(ByteReader& state) override;
  void SaveTick(ByteWriter& state) const override;
  void LoadTick(ByteReader& state) override;

protected:
  void AfterFreeMotion(double seconds) override;
  void FollowAttributes() override;

private:
  void UpdateGripper();

  double turret_command_ = 0;  // rad/s
  bool lock_ = false;
  double turret_angle_ = 0;   // rad
  double turret_target_ = 0;  // rad: where the motor wants a loaded turret
  double aperture_ = 0;       // rad
  Grasp gripper_;
  // Values of the last tick.
  Vector3 velocity_at_start_ = Vector3::Zero();
  Vector3 grip_force_ = Vector3::Zero();
  double grip_torque_ = 0;
};

}  // namespace swarmanoid::dynamics3d
