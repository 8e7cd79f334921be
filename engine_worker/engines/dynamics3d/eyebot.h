// The eyebot in 3D: a single body that hovers by thrust along its own axis and turns by torques. A controller follows
// velocity commands. The eyebot can also hang from the ceiling.
#pragma once

#include "engine_worker/engines/dynamics3d/model.h"

namespace swarmanoid::dynamics3d
{

// Lengths are in metres, masses in kilograms. Ring, rod, legs and the total mass of 0.5 kg are those of the ODE model
// of ARGoS 2. Gains and limits are ours.
struct EyebotShape
{
  static constexpr double kRingRadius = 0.25;
  static constexpr double kRingHeight = 0.03;
  static constexpr double kRingCentre = 0.1735;
  static constexpr double kRodSide = 0.07;
  static constexpr double kHeight = 0.566;
  static constexpr double kLegRadius = 0.01;
  static constexpr double kLegReach = 0.12;
  static constexpr double kMass = 0.5;
  static constexpr double kCentreOfMass = 0.2;
  static constexpr double kMaximumThrust = 2.2;  // times the weight
  static constexpr double kCeilingReach = 0.03;  // m above its top where the magnet takes hold
};

class EyebotModel : public Model
{
public:
  // ceiling_m is the height of the ceiling in the space, or infinity if the arena has no ceiling.
  EyebotModel(Scene& scene, const CSwarmanoidSpaceEntity& entity, double ceiling_m);

  void Place(const Pose& pose) override;
  void Command(std::string_view channel, std::span<const double> values) override;
  void BeginTick() override;
  void BeforeStep(double seconds) override;
  void Report(AttributeReport& report) const override;
  void Save(ByteWriter& state) const override;
  void Load(ByteReader& state) override;
  void SaveTick(ByteWriter& state) const override;
  void LoadTick(ByteReader& state) override;

  // Returns the thrust of the last step in newton.
  double ThrustForTest() const { return thrust_; }

private:
  dBodyID Body() const { return scene_.world.Body(MainBody()); }
  void UpdateAttachment();
  void TrackReference(double seconds);
  // Commands the thrust for an acceleration, and the torque that turns the thrust's axis to it. Space axes.
  void Fly(const Vector3& acceleration);

  double ceiling_;
  double velocity_command_[3] = {0, 0, 0};  // forward, left, up, m/s
  double yaw_rate_command_ = 0;             // rad/s
  bool attach_ = false;
  // The place that the robot keeps, space frame; moves with the commanded velocity.
  Vector3 reference_ = Vector3::Zero();
  double reference_yaw_ = 0;
  Vector3 reference_velocity_ = Vector3::Zero();
  std::uint32_t magnet_ = 0;
  double thrust_ = 0;
};

}  // namespace swarmanoid::dynamics3d
