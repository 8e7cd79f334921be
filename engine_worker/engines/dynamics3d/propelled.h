// A flying robot in 3D: a single body that hovers by thrust along its own axis and turns by torques. An autopilot
// follows velocity commands. The robot can also hang from the ceiling, if it has a magnet. All values are those of its
// row.
#pragma once

#include <optional>

#include "engine_worker/engines/dynamics3d/model.h"
#include "engine_worker/engines/dynamics3d/rotors.h"

namespace swarmanoid::dynamics3d
{

class PropelledModel : public Model
{
public:
  // ceiling_m is the height of the ceiling in the space, or infinity if the arena has no ceiling.
  PropelledModel(Scene& scene, const CSwarmanoidSpaceEntity& entity, double ceiling_m);

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
  const RotorSet& RotorsForTest() const { return *rotors_; }

private:
  dBodyID Body() const { return scene_.world.Body(MainBody()); }
  void UpdateAttachment();
  void TrackReference(double seconds);
  // Exerts the thrust for an acceleration, and the torque that turns the thrust's axis to it. Space axes.
  void Fly(const Vector3& acceleration, double seconds);
  void Exert(double thrust, const Vector3& torque, double seconds);

  const Propellers& row_;
  double height_;
  double max_thrust_;  // N
  double ceiling_;
  std::optional<RotorSet> rotors_;
  double velocity_command_[3] = {0, 0, 0};  // forward, left, up, m/s
  double yaw_rate_command_ = 0;             // rad/s
  bool attach_ = false;
  // The place that the robot keeps, space frame; moves with the commanded velocity.
  Vector3 reference_ = Vector3::Zero();
  double reference_yaw_ = 0;
  Vector3 reference_velocity_ = Vector3::Zero();
  std::uint32_t magnet_ = 0;
  double thrust_ = 0;
  Vector3 wind_ = Vector3::Zero();  // m/s, of this tick, space frame
};

}  // namespace swarmanoid::dynamics3d
