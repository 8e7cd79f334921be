#include "engine_worker/volume_members.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "common/math/elementary.h"
#include "common/space/bound_entities.h"
#include "common/space/space.h"
#include "common/space/state_checks.h"

namespace swarmanoid
{
namespace
{

// The channels that move a robot as a whole.
constexpr std::array<std::string_view, 3> kDrives{"eyebot_propellers", "footbot_wheels", "wheels"};

// Returns whether a point is within `margin` (m) of the box around a volume.
bool IsNear(const EngineVolume& volume, const Vector3& point, double margin)
{
  if (!(volume.low - margin <= point.z() && point.z() <= volume.high + margin)) return false;
  if (volume.outlines.empty()) return true;
  Vector2 least = volume.outlines.front().front(), most = least;
  for (const std::vector<Vector2>& outline : volume.outlines)
    for (const Vector2& corner : outline)
    {
      least = least.cwiseMin(corner);
      most = most.cwiseMax(corner);
    }
  const Vector2 at = point.head<2>();
  return (at - least).minCoeff() >= -margin && (most - at).minCoeff() >= -margin;
}

}  // namespace

EntityVelocity VelocityAfter(const Pose& from, const Pose& to, double seconds)
{
  const Vector3 mean = (to.position - from.position) / seconds;
  Quaternion turn = to.orientation * from.orientation.conjugate();
  if (turn.w() < 0) turn.coeffs() *= -1;
  const double sine = std::sqrt(turn.vec().squaredNorm());  // of half the angle
  if (sine < 1e-12) return {mean, Vector3::Zero()};
  const double half = Atan2(sine, turn.w());
  const Vector3 axis = turn.vec() / sine;
  // The chord of an arc is shorter than the arc, and its direction is half a turn behind that of the end.
  const Vector3 along = axis * axis.dot(mean);
  const Quaternion half_turn = Quaternion(1 + turn.w(), turn.x(), turn.y(), turn.z()).normalized();
  return {along + half_turn * ((mean - along) * (half / sine)), axis * (2 * half / seconds)};
}

bool IsGhost(const CSwarmanoidSpace& space, const EngineVolume& volume, std::uint32_t entity)
{
  return space.IsPresent(entity) && IsNear(volume, space.GetPose(entity).position, kGhostMargin_m) &&
         !IsBound(space, entity);
}

VolumeMembers::VolumeMembers(const CSwarmanoidSpace& space, const Assignment& assignment, std::uint32_t engine)
    : space_(space), layout_(assignment.engines[engine]), engine_(engine), moves_(layout_.members.size(), 1)
{
}

void VolumeMembers::Begin(CPhysicsEngine& engine)
{
  const std::vector<int> engines = layout_.members.empty() ? std::vector<int>() : StartEngines(space_.GetExperiment());
  Divide(engine, [&](std::size_t k) { return engines[EntityOf(layout_.members[k])] == static_cast<int>(engine_); });
}

void VolumeMembers::Follow(CPhysicsEngine& engine)
{
  Divide(engine, [this](std::size_t k) { return space_.IsMovedBy(layout_.members[k].choice, engine_); });
}

// All entities leave before others come, so that no two bodies are in one place.
template <class IsMoved>
void VolumeMembers::Divide(CPhysicsEngine& engine, const IsMoved& is_moved)
{
  bool changed = false;
  for (const bool comes : {false, true})
    for (std::size_t k = 0; k < moves_.size(); ++k)
    {
      if (is_moved(k) != comes || (moves_[k] != 0) == comes) continue;
      moves_[k] = comes ? 1 : 0;
      changed = true;
      const VolumeMember& member = layout_.members[k];
      if (comes)
        engine.TakeOver(EntityOf(member), SavedVelocity(member));
      else
        engine.HandOver(EntityOf(member));
    }
  if (!changed) return;
  elsewhere_.clear();
  for (std::size_t k = 0; k < moves_.size(); ++k)
    if (moves_[k] == 0) elsewhere_.push_back(EntityOf(layout_.members[k]));
}

EntityVelocity VolumeMembers::SavedVelocity(const VolumeMember& member) const
{
  const std::uint32_t slot = space_.EngineSlot(member.choice);
  EntityVelocity velocity;
  for (std::uint32_t axis = 0; axis < 3; ++axis)
  {
    velocity.linear[axis] = space_.Attributes()[slot + EngineSlots::kVelocity + axis];
    velocity.angular[axis] = space_.Attributes()[slot + EngineSlots::kSpin + axis];
  }
  return velocity;
}

bool VolumeMembers::IsElsewhere(std::uint32_t entity) const { return std::ranges::binary_search(elsewhere_, entity); }

void VolumeMembers::StopElsewhere(std::span<double> commands) const
{
  if (elsewhere_.empty()) return;
  for (const ChannelBlock& block : layout_.commands)
  {
    if (std::ranges::find(kDrives, block.name) != kDrives.end()) continue;
    const auto width = static_cast<std::size_t>(block.width);
    for (std::size_t k = 0; k < block.entities.size(); ++k)
      if (IsElsewhere(block.entities[k])) std::ranges::fill(commands.subspan(block.offset + k * width, width), 0.0);
  }
}

void VolumeMembers::LeaveOutElsewhere(EngineUpdate& update) const
{
  if (elsewhere_.empty()) return;
  if (update.poses.size() == 7 * layout_.owned.size())
    for (std::size_t k = 0; k < moves_.size(); ++k)
      if (moves_[k] == 0) PutPose(space_, layout_, layout_.members[k].place, update.poses);
  AttributeChanges& changes = update.attributes;
  if (changes.slots.size() != changes.values.size()) return;  // CheckResults reports it
  std::size_t kept = 0;
  for (std::size_t k = 0; k < changes.slots.size(); ++k)
  {
    const std::uint32_t slot = changes.slots[k];
    if (slot < space_.Attributes().size() && IsElsewhere(EntityOfSlot(space_, slot))) continue;
    changes.slots[kept] = slot;
    changes.values[kept++] = changes.values[k];
  }
  changes.slots.resize(kept);
  changes.values.resize(kept);
}

void VolumeMembers::TellVelocities(const CPhysicsEngine& engine, EngineUpdate& update) const
{
  const std::size_t count = layout_.owned.size();
  const EngineVolume& volume = space_.GetExperiment().engines[engine_].volume;
  if (volume.IsWhole() || update.poses.size() != 7 * count) return;
  for (std::size_t k = 0; k < moves_.size(); ++k)
  {
    const VolumeMember& member = layout_.members[k];
    const auto part = [&](std::size_t c) { return update.poses[c * count + member.place]; };
    const Vector3 at(part(0), part(1), part(2));
    const std::uint32_t entity = EntityOf(member);
    if (moves_[k] == 0 || volume.Holds(at) || !space_.IsPresent(entity)) continue;
    const Pose now{at, Quaternion(part(6), part(3), part(4), part(5))};
    const EntityVelocity velocity =
        engine.VelocityOf(entity).value_or(VelocityAfter(space_.GetPose(entity), now, space_.GetTickSeconds()));
    const std::uint32_t slot = space_.EngineSlot(member.choice);
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      update.attributes.Add(slot + EngineSlots::kVelocity + axis, velocity.linear[axis]);
    for (std::uint32_t axis = 0; axis < 3; ++axis)
      update.attributes.Add(slot + EngineSlots::kSpin + axis, velocity.angular[axis]);
  }
}

void VolumeMembers::SaveState(ByteWriter& state) const
{
  if (!moves_.empty()) state.PutArray(moves_);
}

void VolumeMembers::LoadState(ByteReader& state, CPhysicsEngine& engine)
{
  if (moves_.empty()) return;
  const auto moves = state.GetArray<std::uint8_t>();
  if (moves.size() != moves_.size()) throw std::runtime_error("saved state: it is of another experiment");
  Divide(engine, [&](std::size_t k) { return moves[k] != 0; });
}

}  // namespace swarmanoid
