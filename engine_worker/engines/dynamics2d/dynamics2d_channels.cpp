// Commands, poses, attributes and sensors of the engine dynamics2d.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
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

void CDynamics2dEngine::ReadCommands(const EngineCommands& commands)
{
  for (const ChannelBlock& block : commands.blocks)
  {
    const std::span<const double> values = commands.Of(block);
    if (robots_.Command(block, values)) continue;
    const auto width = static_cast<std::size_t>(block.width);
    for (std::size_t i = 0; i < block.entities.size(); ++i)
    {
      const std::span<const double> command = values.subspan(i * width, width);
      if (!std::all_of(command.begin(), command.end(), [](double value) { return std::isfinite(value); }))
        throw std::runtime_error(fmt::format("'{}' was given a command on {} that is not a finite number",
                                             space_->GetEntity(block.entities[i]).GetId(), block.name));
      const int body = BodyOf(block.entities[i]);
      if (block.name == "footbot_wheels" || block.name == "wheels")
      {
        const WheelDrive& wheels = *DescriptionOf(space_->GetEntity(block.entities[i]).GetKind()).wheels;
        const double left = Speed(command[0] * wheels.radius_m);
        const double right = Speed(command[1] * wheels.radius_m);
        world_->SetDrive(body, {(left + right) / 2, 0, (right - left) / wheels.axle_m});
      }
      else if (block.name == "eyebot_propellers")
      {
        const double turn = TurnRate(command[3]);
        const Vector2 drift = robots_.Drift(block.entities[i], turn);
        world_->SetDrive(body, {Speed(command[0] + drift.x()), Speed(command[1] + drift.y()), turn});
      }
      else if (block.name == "footbot_turret")
      {
        world_->SetTurretSpeed(body, TurnRate(command[0]));
      }
      else if (block.name == "footbot_gripper")
      {
        FootbotOf(block.entities[i]).gripper = std::clamp(command[0], 0.0, 1.0);
      }
    }
  }
}

void CDynamics2dEngine::WritePoses(EngineUpdate& update) const
{
  const std::size_t count = owned_.size();
  double* x = update.poses.data();
  world_->ForEach(count,
                  [&](std::size_t i)
                  {
                    const Pose pose = plane_.ToSpace(world_->PoseOf(owned_[i].body), owned_[i].stance);
                    x[i] = pose.position.x();
                    x[count + i] = pose.position.y();
                    x[2 * count + i] = pose.position.z();
                    x[3 * count + i] = pose.orientation.x();
                    x[4 * count + i] = pose.orientation.y();
                    x[5 * count + i] = pose.orientation.z();
                    x[6 * count + i] = pose.orientation.w();
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
    for (const std::uint32_t entity : block.entities)
    {
      const Footbot& footbot = footbots_[footbot_of_entity_[entity]];
      const TickMeasures& measures = world_->MeasuresOf(footbot.body);
      if (block.name == "footbot_encoders")
      {
        value[0] = measures.left_arc;
        value[1] = measures.right_arc;
      }
      else if (block.name == "footbot_turret_torque")
      {
        value[0] = std::clamp(measures.load.force_x / parameters_.traction_range, -1.0, 1.0);
        value[1] = std::clamp(measures.load.force_y / parameters_.traction_range, -1.0, 1.0);
        value[2] = std::clamp(measures.load.torque / parameters_.turret_torque, -1.0, 1.0);
      }
      else if (block.name == "footbot_accelerometer")
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
