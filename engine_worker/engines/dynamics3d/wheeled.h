// A robot on two driven wheels in 3D: a chassis with the wheels on it, and two casters. The footbot adds a turret and a
// gripper; a user's kind with wheels adds nothing. ODE moves its bodies. While the robot is free, the closed form of
// its drive computes the motion, and while it meets only upright walls and robots, PlanarSolver does. MoveBodies then
// copies the motion to the bodies.
#pragma once

#include <array>

#include "engine_worker/engines/dynamics3d/differential_drive.h"
#include "engine_worker/engines/dynamics3d/jointed.h"
#include "engine_worker/engines/dynamics3d/model.h"
#include "engine_worker/engines/dynamics3d/planar_solver.h"

namespace swarmanoid::dynamics3d
{

// Lengths are in metres, masses in kilograms.
struct WheeledShape
{
  Vector3 size = Vector3::Zero();  // of the whole robot: a box, or radius, radius, height
  bool is_cylinder = true;
  std::shared_ptr<const ConvexHull> hull = {};  // instead of both, in the frame of the robot
  double clearance = 0;                         // of the chassis above the ground
  double wheel_radius = 0;
  double half_track = 0;
  double caster_radius = 0;
  std::array<double, 2> caster_reach = {};  // from the axle to the front one and to the back one
  double chassis_mass = 0;
  double wheel_mass = 0;  // of each, with motor and tread
  double centre_of_mass = 0;
  double inertia_radius = 0;  // of the cylinder that has the inertia of the chassis
  double inertia_height = 0;
  double free_speed = 0;  // m/s of a wheel's rim, where the motor has no torque left

  // Returns the shape that the row of the kind describes, with the proportions of the footbot for missing values.
  // `density` (kg/m3) is used for a kind without a mass.
  static WheeledShape Of(const CSwarmanoidSpaceEntity& entity, double density);
};

// The outline of an upright robot that PlanarSolver can move: a disc, or a box.
struct PlanarOutline
{
  double radius = 0;  // 0: a box
  Vector2 half_size = Vector2::Zero();
  double low = 0, high = 0;  // m, of the chassis
  // A force of both motors at this height (m) lifts no wheel.
  double highest_push = 0;
};

class WheeledModel : public Model
{
public:
  WheeledModel(Scene& scene, const CSwarmanoidSpaceEntity& entity, const WheeledShape& shape);

  void Place(const Pose& pose) override;
  double Reach() const override { return links_ ? links_->Reach() : 0; }
  void Command(std::string_view channel, std::span<const double> values) override;
  void Sense(std::string_view channel, std::span<double> values) const override;
  void BeginTick() override;
  void SetLeftOut(bool left_out) override;
  void BeforeStep(double seconds) override;
  void AfterStep(double seconds) override;
  void Report(AttributeReport& report) const override;
  void Save(ByteWriter& state) const override;
  void Load(ByteReader& state) override;
  void SaveTick(ByteWriter& state) const override;
  void LoadTick(ByteReader& state) override;

  double Radius() const { return radius_; }  // m, of the upright robot about its vertical axis
  double Height() const { return height_; }  // m, of its highest point
  bool IsUpright() const;
  double LargestSpeed() const override;
  Box CurrentBox() const override;
  Vector2 GroundPoint() const;  // below its middle

  // Returns whether the robot rolls on level ground as its wheels turn, so that the closed form goes on where the
  // solver is.
  bool RollsFreely() const;
  bool IsFree() const { return motion_of_ == EMotionOf::kClosedForm; }
  void BecomeFree();
  void AdvanceFreely(int steps, double step_seconds);
  // Returns whether the robot stands and moves on its wheels, in any direction, so that PlanarSolver can go on where
  // ODE is.
  bool StandsOnWheels() const;
  bool IsPlanar() const { return motion_of_ == EMotionOf::kPlanarSolver; }
  // Returns whether it meets upright things between two heights (m) at its side, and low enough not to tip.
  bool MeetsUpright(double low, double high) const;
  const PlanarOutline& InPlane() const { return planar_; }
  void BecomePlanar();
  // The planar solver moves the motion. AfterPlanarStep follows.
  std::size_t AddTo(PlanarSolver& solver) { return solver.Add(drive_, motion_, wheel_command_); }
  void AfterPlanarStep(double seconds);
  const PlaneMotion& Motion() const { return motion_; }
  double PlanarSpeed() const;  // m/s, of the middle
  // Puts the bodies where the closed form or the planar solver is, with its velocities.
  void MoveBodies();
  // Has the solver move the bodies from where they are.
  void BecomeSolved();

protected:
  void FollowAttributes() override;
  // The wheels roll.
  void SetVelocity(const EntityVelocity& velocity) override;
  // Called after the closed form or the planar solver moved the robot by `seconds`.
  virtual void AfterFreeMotion(double seconds) { elapsed_ += seconds; }
  dBodyID Chassis() const { return scene_.world.Body(bodies_[0].number); }
  double Elapsed() const { return elapsed_; }  // s, of this tick

private:
  dJointID Axle(std::size_t wheel) const { return scene_.world.Hinge(axles_[wheel]); }
  std::array<double, 2> WheelRates() const;
  bool IsOnBodies() const { return motion_of_ == EMotionOf::kBodies; }
  void StartMotion();

  // It says where the motion of the robot is kept.
  enum class EMotionOf : std::uint8_t
  {
    kBodies,  // of ODE
    kClosedForm,
    kPlanarSolver
  };

  double wheel_radius_;
  double radius_;
  double height_;
  double largest_free_rate_;  // rad/s, of the wheels of a free robot
  bool brakes_freely_;        // its wheels stay down at full braking; if false, only a steady robot is free
  DifferentialDrive drive_;
  std::unique_ptr<JointedLinks> links_;           // nullptr: none
  int axles_[2] = {0, 0};                         // hinges: left, right
  std::array<double, 2> wheel_command_ = {0, 0};  // rad/s
  std::array<double, 2> wheel_turn_ = {0, 0};     // rad, of the last tick
  bool can_be_planar_ = false;
  PlanarOutline planar_;
  EMotionOf motion_of_ = EMotionOf::kBodies;
  PlaneMotion motion_;  // unless its bodies have it
  double elapsed_ = 0;
};

}  // namespace swarmanoid::dynamics3d
