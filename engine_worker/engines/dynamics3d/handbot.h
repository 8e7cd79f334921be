// The handbot in 3D: a trunk, a head that turns about the forward axis, and two arms on the head with a hand on a wrist
// at the end of each. A rope to the ceiling has a winch, and fans keep the heading while the robot hangs on it.
#pragma once

#include "common/plugin_descriptions/robot_parts.h"
#include "engine_worker/engines/dynamics3d/grasp.h"

namespace swarmanoid::dynamics3d
{

// Lengths are in metres, masses in kilograms. The angles are those of the ARGoS 2 model; the masses are our
// assumptions.
struct HandbotShape : HandbotParts
{
  static constexpr double kTrunkMass = 2.2;
  static constexpr double kTrunkCentre = 0.06;
  static constexpr double kHeadMass = 0.3;
  static constexpr double kArmMass = 0.25;
  // Geared motors multiply the inertia of the part that they turn, here relative to a plain box. With less, arms would
  // sag under a book at few iterations.
  static constexpr double kHeadInertia = 10;
  static constexpr double kArmInertia = 4;
  static constexpr double kMass = kTrunkMass + kHeadMass + 2 * kArmMass;
  static constexpr double kHeadTorque = 3;      // N m
  static constexpr double kArmTorque = 2;       // N m
  static constexpr double kWristTorque = 1;     // N m
  static constexpr double kFanTorque = 0.1;     // N m, both fans
  static constexpr double kWidestArm = 1.0472;  // rad
  static constexpr double kWidestWrist = 1.5708;
  static constexpr double kWidestHand = 3.1416;
  static constexpr double kHandSpeed = 3;       // rad/s
  static constexpr double kRopeForward = 0.03;  // m: above the centre of mass, so that the robot hangs level
  static constexpr double kLongestRope = 5;     // m
  static constexpr double kShortestRope = 0.05;
  static constexpr double kWinchSpeed = 0.15;  // m/s
};

class HandbotModel : public Model
{
public:
  HandbotModel(Scene& scene, const CSwarmanoidSpaceEntity& entity);

  void Place(const Pose& pose) override;
  void Command(std::string_view channel, std::span<const double> values) override;
  void BeginTick() override;
  void BeforeStep(double seconds) override;
  void AfterStep(double seconds) override;
  void Report(AttributeReport& report) const override;
  void Save(ByteWriter& state) const override;
  void Load(ByteReader& state) override;
  void SaveTick(ByteWriter& state) const override;
  void LoadTick(ByteReader& state) override;

protected:
  void FollowAttributes() override;

private:
  // A hinge whose motor follows a target angle.
  struct Servo
  {
    int hinge = 0;
    int inner = 0;  // indices into bodies_: the one that has, the one that turns
    int outer = 0;
    Vector3 axis = Vector3::UnitX();
    double sign = 1;  // a positive angle turns the outer body by sign about the axis
    double lowest = 0, highest = 0;
    double target = 0;
    double rate = 0;  // commanded, rad/s
  };
  struct Hand
  {
    Grasp grasp;
    double wrist = 0;  // rad
    double wrist_rate = 0;
    double aperture = 0;  // rad
    bool close = false;
    bool commanded = false;
  };
  static constexpr std::size_t kHead = 0;  // among the servos; arms 1 (left) and 2

  dBodyID BodyAt(int k) const { return scene_.world.Body(bodies_[static_cast<std::size_t>(k)].number); }
  void MakeServo(std::size_t k, int inner, int outer, const Vector3& anchor, const Vector3& axis, double sign,
                 double lowest, double highest, double torque);
  double AngleOf(const Servo& servo) const;
  void DriveServo(Servo& servo, double seconds);
  void UpdateHands();
  void UpdateRope();
  void RunFans();

  Servo servos_[3];
  Hand hands_[2];
  bool launch_ = false;
  double winch_ = 0;  // m/s
  std::uint32_t rope_ = 0;
  double heading_ = 0;  // rad, in the space: what the fans keep while the robot hangs
};

}  // namespace swarmanoid::dynamics3d
