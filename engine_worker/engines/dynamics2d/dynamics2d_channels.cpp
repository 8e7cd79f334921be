// Commands, poses, attributes and sensors of the engine dynamics2d.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "common/math/elementary.h"
#include "common/space/space.h"
#include "engine_worker/engines/dynamics2d/dynamics2d_engine.h"

namespace swarmanoid
{

using namespace dynamics2d;

namespace
{

// No robot moves faster than this, and single precision would not hold.
constexpr double kFastest = 100;           // m/s
constexpr double kFastestTurn = 1000;      // rad/s
constexpr double kOpenAperture = kPi / 2;  // rad, of an open gripper

double Speed(double value) { return std::clamp(value, -kFastest, kFastest); }
double TurnRate(double value) { return std::clamp(value, -kFastestTurn, kFastestTurn); }

}  // namespace

// Sets the drives of all robots with wheels in a block.
void CDynamics2dEngine::ReadWheels(const ChannelBlock& block, std::span<const double> values)
{
  const WheelDrive* wheels = nullptr;
  std::optional<EntityKind> last;
  for (std::size_t i = 0; i < block.entities.size(); ++i)
  {
    // Most neighbours are of one kind.
    const EntityKind kind = space_->GetEntity(block.entities[i]).GetKind();
    if (last != kind) wheels = &*DescriptionOf(kind).wheels;
    last = kind;
    const double left = Speed(values[2 * i] * wheels->radius_m);
    const double right = Speed(values[2 * i + 1] * wheels->radius_m);
    world_->SetDrive(BodyOf(block.entities[i]), {(left + right) / 2, 0, (right - left) / wheels->axle_m});
  }
}

void CDynamics2dEngine::ReadCommands(const EngineCommands& commands)
{
  for (const ChannelBlock& block : commands.blocks)
  {
    const std::span<const double> values = commands.Of(block);
    if (robots_.Command(block, values)) continue;
    CheckFinite(block, values);
    if (block.name == "footbot_wheels" || block.name == "wheels")
    {
      ReadWheels(block, values);
      continue;
    }
    const bool are_propellers = block.name == "eyebot_propellers";
    const bool are_turrets = block.name == "footbot_turret";
    const bool are_grippers = block.name == "footbot_gripper";
    const auto width = static_cast<std::size_t>(block.width);
    for (std::size_t i = 0; i < block.entities.size(); ++i)
    {
      const std::span<const double> command = values.subspan(i * width, width);
      const std::uint32_t entity = block.entities[i];
      if (are_propellers)
      {
        const double turn = TurnRate(command[3]);
        const Vector2 drift = robots_.Drift(entity, turn);
        world_->SetDrive(BodyOf(entity), {Speed(command[0] + drift.x()), Speed(command[1] + drift.y()), turn});
      }
      else if (are_turrets)
      {
        world_->SetTurretSpeed(BodyOf(entity), TurnRate(command[0]));
      }
      else if (are_grippers)
      {
        FootbotOf(entity).gripper = std::clamp(command[0], 0.0, 1.0);
      }
    }
  }
}

// Throws std::runtime_error with the name of the first robot whose command is not a finite number.
void CDynamics2dEngine::CheckFinite(const ChannelBlock& block, std::span<const double> values) const
{
  double sum = 0;
  for (const double value : values) sum += value - value;
  if (sum == 0) return;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      throw std::runtime_error(fmt::format(
          "'{}' was given a command on {} that is not a finite number",
          space_->GetEntity(block.entities[i / static_cast<std::size_t>(block.width)]).GetId(), block.name));
}

void CDynamics2dEngine::WritePoses(EngineUpdate& update) const
{
  const std::size_t count = owned_.size();
  double* x = update.poses.data();
  const auto write = [&](std::size_t i, const Pose& pose)
  {
    x[i] = pose.position.x();
    x[count + i] = pose.position.y();
    x[2 * count + i] = pose.position.z();
    x[3 * count + i] = pose.orientation.x();
    x[4 * count + i] = pose.orientation.y();
    x[5 * count + i] = pose.orientation.z();
    x[6 * count + i] = pose.orientation.w();
  };
  // On a level plane, bodies that stand upright turn about z alone.
  const Pose& frame = plane_.Frame();
  const auto upright = Quaternion::Identity().coeffs();
  const bool is_level = frame.orientation.coeffs() == upright;
  world_->ForEach(count,
                  [&](std::size_t i)
                  {
                    const Owned& owned = owned_[i];
                    const PlanePose pose = world_->PoseOf(owned.body);
                    if (!is_level || owned.stance.lean.coeffs() != upright)
                      return write(i, plane_.ToSpace(pose, owned.stance));
                    const SinCos half = SinCosOf(pose.heading / 2);
                    x[i] = frame.position.x() + pose.u;
                    x[count + i] = frame.position.y() + pose.v;
                    x[2 * count + i] = frame.position.z() + owned.stance.height;
                    x[3 * count + i] = x[4 * count + i] = 0;
                    x[5 * count + i] = half.sin;
                    x[6 * count + i] = half.cos;
                  });
}

void CDynamics2dEngine::ReportAttributes(EngineUpdate& update) const
{
  const SparseVector<double>& known = space_->Attributes();
  const auto report = [&](std::uint32_t slot, double value)
  {
    if (known[slot] != value) update.attributes.Add(slot, value);
  };
  for (const Footbot& footbot : footbots_)
  {
    if (footbot.has_gripper) report(footbot.aperture_slot, (1 - footbot.gripper) * kOpenAperture);
    const int gripped = world_->GrippedBy(footbot.body);
    report(footbot.gripped_slot, gripped == kNoBody ? 0 : 1.0 + entity_of_body_[static_cast<std::size_t>(gripped)]);
    report(footbot.turret_slot, world_->TurretAngleOf(footbot.body));
  }
}

void CDynamics2dEngine::WriteSensors(std::span<double> sensors) const
{
  for (const ChannelBlock& block : layout_->sensors)
  {
    if (block.name == "joints")
    {
      const std::size_t count = block.entities.size() * static_cast<std::size_t>(block.width);
      robots_.Sense(block, sensors.subspan(block.offset, count));
      continue;
    }
    double* value = sensors.data() + block.offset;
    const bool are_encoders = block.name == "footbot_encoders";
    const bool are_torques = block.name == "footbot_turret_torque";
    const bool are_accelerometers = block.name == "footbot_accelerometer";
    for (const std::uint32_t entity : block.entities)
    {
      const Footbot& footbot = footbots_[footbot_of_entity_[entity]];
      const TickMeasures& measures = world_->MeasuresOf(footbot.body);
      if (are_encoders)
      {
        value[0] = measures.left_arc;
        value[1] = measures.right_arc;
      }
      else if (are_torques)
      {
        value[0] = std::clamp(measures.load.force_x / parameters_.traction_range, -1.0, 1.0);
        value[1] = std::clamp(measures.load.force_y / parameters_.traction_range, -1.0, 1.0);
        value[2] = std::clamp(measures.load.torque / parameters_.turret_torque, -1.0, 1.0);
      }
      else if (are_accelerometers)
      {
        const PlaneVelocity velocity = world_->VelocityOf(footbot.body);
        const SinCos heading = SinCosOf(world_->PoseOf(footbot.body).heading);
        const double u = (velocity.u - footbot.velocity.u) / space_->GetTickSeconds();
        const double v = (velocity.v - footbot.velocity.v) / space_->GetTickSeconds();
        value[0] = heading.cos * u + heading.sin * v;
        value[1] = heading.cos * v - heading.sin * u;
        value[2] = parameters_.gravity;
      }
      value += block.width;
    }
  }
}

}  // namespace swarmanoid
