// A robot on two driven wheels in 3D: a chassis with the wheels on it, and two casters. The footbot is one, with a
// turret and a gripper; a user's kind with wheels is nothing more.
#pragma once

#include "engine_worker/engines/dynamics3d/model.h"

namespace swarmanoid::dynamics3d
{

// Metres and kilograms.
struct WheeledShape
{
  Vector3 size = Vector3::Zero();  // of the whole robot: a box, or radius, radius, height
  bool is_cylinder = true;
  std::shared_ptr<const ConvexHull> hull = {};  // instead of both, in the frame of the robot
  double clearance = 0;                         // of the chassis above the ground
  double wheel_radius = 0;
  double half_track = 0;
  double caster_radius = 0;
  double caster_reach = 0;
  double chassis_mass = 0;
  double wheel_mass = 0;  // of each, with motor and tread
  double centre_of_mass = 0;
  double inertia_radius = 0;  // of the cylinder that has the inertia of the chassis
  double inertia_height = 0;
  double free_speed = 0;  // m/s of a wheel's rim, where the motor has no torque left

  // What a row says, and the proportions of the footbot for what it does not. `density`: kg/m3, of one without a mass.
  static WheeledShape Of(const CSwarmanoidSpaceEntity& entity, double density);
};

class WheeledModel : public Model
{
public:
  WheeledModel(Scene& scene, const CSwarmanoidSpaceEntity& entity, const WheeledShape& shape);

  void Command(std::string_view channel, std::span<const double> values) override;
  void Sense(std::string_view channel, std::span<double> values) const override;
  void BeginTick() override;
  void BeforeStep(double seconds) override;
  void AfterStep(double seconds) override;

protected:
  dBodyID Chassis() const { return scene_.world.Body(bodies_[0].number); }
  double Elapsed() const { return elapsed_; }  // s, of this tick

private:
  double LargestTorque(double command, double speed) const;

  double wheel_radius_;
  double stall_torque_;                     // N m, of each motor
  double free_rate_;                        // rad/s, of a wheel that needs no torque
  dJointID axles_[2] = {nullptr, nullptr};  // left, right
  double wheel_command_[2] = {0, 0};        // rad/s
  double wheel_turn_[2] = {0, 0};           // rad, of the last tick
  double elapsed_ = 0;
};

}  // namespace swarmanoid::dynamics3d
