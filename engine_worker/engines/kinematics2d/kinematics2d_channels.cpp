// Commands and sensors of the kinematic engine. Grippers: kinematics2d_grips.cpp.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>

#include "common/math/elementary.h"
#include "common/space/space.h"
#include "engine_worker/engines/kinematics2d/kinematics2d_engine.h"

namespace swarmanoid
{
namespace
{

using namespace kinematics2d;

// The torque sensor. A robot whose wheels are held back wholly at full drive feels what its wheels can exert on the
// ground, F = friction * mass * g and the torque F b / 2; one that is held back in part feels that part of it. The
// numbers are the defaults of dynamics2d, so that both engines read the same there.
constexpr double kFullSpeed = 0.3;                                          // m/s
constexpr double kFullTurn = 2 * kFullSpeed / kFootbotInterWheel;           // rad/s
constexpr double kWheelForce = 0.8 * 1.6 * 9.81;                            // N
constexpr double kFullTraction = kWheelForce / 25;                          // of the 25 N that are read as 1
constexpr double kFullTorque = kWheelForce * kFootbotInterWheel / 2 / 1.5;  // of the 1.5 N m that are read as 1

}  // namespace

void Kinematics2dEngine::ApplyCommands(const EngineCommands& commands, WorkerPool* pool)
{
  for (const ChannelBlock& block : commands.blocks)
  {
    const std::span<const double> values = commands.Of(block);
    if (block.name == "footbot_wheels" || block.name == "wheels") DriveWheels(block, values, pool);
    if (block.name == "eyebot_propellers") DrivePropellers(block, values);
    if (block.name == "footbot_turret") TurnTurrets(block, values);
    if (block.name == "footbot_gripper") UseGrippers(block, values);
    robots_.Command(block, values);
  }
  robots_.Advance(TickSeconds());
  for (const std::uint32_t eyebot : robots_.Attached()) world_.SetTwist(BodyOf(eyebot), {});
}

double Kinematics2dEngine::TickSeconds() const { return space_->GetTickSeconds(); }

// Throws if `sum`, the sum of a robot's values, is not finite: then one of them is not.
void Kinematics2dEngine::CheckCommand(double sum, std::uint32_t entity, const ChannelBlock& block) const
{
  if (!std::isfinite(sum))
    throw std::runtime_error("robot '" + space_->GetEntity(entity).GetId() + "' gave " + block.name +
                             " a value that is not a finite number");
}

void Kinematics2dEngine::DriveWheels(const ChannelBlock& block, std::span<const double> values, WorkerPool* pool)
{
  std::atomic<bool> failed = false;
  InParts(pool, block.entities.size(), 1,
          [&](unsigned, std::size_t begin, std::size_t end)
          {
            if (begin == end) return;
            const std::uint32_t* const owned = layout_->owned.data();
            std::uint32_t body = BodyOf(block.entities[begin]);
            bool finite = true;
            for (std::size_t k = begin; k < end; ++k, ++body)
            {
              while (owned[body] != block.entities[k]) ++body;
              const Wheels& wheels = wheels_[body];
              const double left = values[2 * k] * wheels.radius;
              const double right = values[2 * k + 1] * wheels.radius;
              finite &= std::isfinite(left + right);
              world_.SetTwist(body, {0.5 * (left + right), 0, (right - left) * wheels.inverse_axle});
            }
            if (!finite) failed = true;
          });
  if (!failed) return;
  for (std::size_t k = 0; k < block.entities.size(); ++k)
  {
    const double radius = wheels_[BodyOf(block.entities[k])].radius;
    CheckCommand(values[2 * k] * radius + values[2 * k + 1] * radius, block.entities[k], block);
  }
}

// The values are the speeds forward, left and up (m/s; the plane ignores the last one), and the yaw rate (rad/s).
void Kinematics2dEngine::DrivePropellers(const ChannelBlock& block, std::span<const double> values)
{
  for (std::size_t k = 0; k < block.entities.size(); ++k)
  {
    const std::span<const double> v = values.subspan(4 * k, 4);
    CheckCommand(v[0] + v[1] + v[3], block.entities[k], block);
    const std::uint32_t body = BodyOf(block.entities[k]);
    const Vector2 drift = robots_.Drift(block.entities[k], v[3]);
    world_.SetTwist(body, {v[0] + drift.x(), v[1] + drift.y(), v[3]});
  }
}

void Kinematics2dEngine::TurnTurrets(const ChannelBlock& block, std::span<const double> values)
{
  for (std::size_t k = 0; k < block.entities.size(); ++k)
  {
    CheckCommand(values[k], block.entities[k], block);
    world_.SetTurretRate(BodyOf(block.entities[k]), values[k]);
  }
}

// The attributes of footbots lie far apart in memory. If no controller commands turrets and grippers, they differ from
// the space only if it was changed there.
void Kinematics2dEngine::ReportFootbots(AttributeChanges& changes)
{
  if (!footbots_change_ && reported_ == space_->AttributeRevision()) return;
  const std::size_t before = changes.slots.size();
  const SparseVector<double>& known = space_->Attributes();
  const auto report = [&](std::uint32_t slot, double value)
  {
    if (known[slot] != value) changes.Add(slot, value);
  };
  for (const Footbot& footbot : footbots_)
  {
    if (is_elsewhere_[footbot.body] != 0) continue;
    if (footbot.aperture) report(footbot.aperture_slot, *footbot.aperture);
    const Grip* grip = world_.FindGrip(footbot.body);
    report(footbot.gripped_slot, grip == nullptr ? 0 : 1.0 + layout_->owned[grip->prey]);
    report(footbot.turret_slot, world_.TurretAngle(footbot.body));
  }
  if (changes.slots.size() == before) reported_ = space_->AttributeRevision();
}

// Gives the arcs (m) that the wheels rolled in the tick, collisions included.
void Kinematics2dEngine::ReadEncoders(const ChannelBlock& block, std::span<double> values) const
{
  for (std::size_t k = 0; k < block.entities.size(); ++k)
  {
    const std::uint32_t body = BodyOf(block.entities[k]);
    const double forward = world_.TravelForward(body);
    const double turned = 0.5 * kFootbotInterWheel * world_.TravelTurn(body);
    values[2 * k] = forward - turned;
    values[2 * k + 1] = forward + turned;
  }
}

// Gives the force of the load on the robot, in the frame of the turret: the way that the grip made the robot go beyond
// the command of its wheels, as a part of full drive.
void Kinematics2dEngine::ReadTurretTorques(const ChannelBlock& block, std::span<double> values) const
{
  std::fill(values.begin(), values.end(), 0.0);
  for (std::size_t k = 0; k < block.entities.size(); ++k)
  {
    const std::uint32_t body = BodyOf(block.entities[k]);
    if (world_.FindGrip(body) == nullptr) continue;
    const Pose2 wanted = Advanced(tick_start_[static_cast<std::size_t>(&FootbotOf(body) - footbots_.data())],
                                  world_.TwistOf(body), TickSeconds());
    const Placed robot = world_.PlacedAt(body);
    const double scale = kFullTraction / (kFullSpeed * TickSeconds());
    const double x = (robot.x - wanted.x) * scale;
    const double y = (robot.y - wanted.y) * scale;
    const double turret_cos = robot.cos * robot.turret_cos - robot.sin * robot.turret_sin;
    const double turret_sin = robot.sin * robot.turret_cos + robot.cos * robot.turret_sin;
    values[3 * k] = std::clamp(turret_cos * x + turret_sin * y, -1.0, 1.0);
    values[3 * k + 1] = std::clamp(turret_cos * y - turret_sin * x, -1.0, 1.0);
    const double turn = AngleOf(world_.PoseOf(body).heading * Conjugate(wanted.heading));
    values[3 * k + 2] = std::clamp(turn * kFullTorque / (kFullTurn * TickSeconds()), -1.0, 1.0);
  }
}

bool Kinematics2dEngine::IsFootbot(std::uint32_t body) const
{
  return std::ranges::binary_search(footbots_, body, {}, &Footbot::body);
}

Kinematics2dEngine::Footbot& Kinematics2dEngine::FootbotOf(std::uint32_t body)
{
  return *std::lower_bound(footbots_.begin(), footbots_.end(), body,
                           [](const Footbot& footbot, std::uint32_t b) { return footbot.body < b; });
}

const Kinematics2dEngine::Footbot& Kinematics2dEngine::FootbotOf(std::uint32_t body) const
{
  return const_cast<Kinematics2dEngine*>(this)->FootbotOf(body);
}

}  // namespace swarmanoid
