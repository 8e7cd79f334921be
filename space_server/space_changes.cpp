#include "space_server/space_changes.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "common/configuration/wording.h"
#include "common/experiment/body.h"
#include "common/math/elementary.h"
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

[[noreturn]] void Refuse(const std::string& text) { throw std::invalid_argument(text); }

const CSwarmanoidSpaceEntity& Find(const CSwarmanoidSpace& space, std::string_view id)
{
  if (const CSwarmanoidSpaceEntity* entity = space.FindEntity(id)) return *entity;
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < space.Size(); ++i) ids.push_back(space.GetEntity(i).GetId());
  Refuse(fmt::format("there is no entity {}{}", Quoted(id), DidYouMean(id, ids)));
}

void RequirePresence(const CSwarmanoidSpace& space, const CSwarmanoidSpaceEntity& entity, bool present)
{
  if (space.IsPresent(entity.GetIndex()) == present) return;
  Refuse(fmt::format("entity '{}' is {}", entity.GetId(), present ? "not in the arena" : "in the arena already"));
}

void RequireRemovable(const CSwarmanoidSpaceEntity& entity)
{
  if (entity.IsMovable()) return;
  Refuse(
      fmt::format("the {} '{}' never moves, so it cannot be added or removed; only robots, preys, movable blocks and "
                  "what is in a <reserve> can",
                  TagName(entity.GetKind()), entity.GetId()));
}

// Returns the first entity of a reserve that is not in the arena. Throws if the reserve is unknown or empty.
const CSwarmanoidSpaceEntity& FirstWaiting(const CSwarmanoidSpace& space, std::string_view reserve)
{
  std::set<std::string> reserves;
  const CSwarmanoidSpaceEntity* last = nullptr;
  std::size_t quantity = 0;
  for (std::size_t i = 0; i < space.Size(); ++i)
  {
    const CSwarmanoidSpaceEntity& entity = space.GetEntity(i);
    const std::string& of = entity.GetConfiguration().reserve;
    if (!of.empty()) reserves.insert(of);
    if (of != reserve) continue;
    if (!space.IsPresent(i)) return entity;
    last = &entity;
    ++quantity;
  }
  if (last == nullptr)
    Refuse(fmt::format("there is no reserve and no entity {}; reserves are: {}", Quoted(reserve),
                       Listed({reserves.begin(), reserves.end()})));
  Refuse(
      fmt::format("all {} entities of the reserve {} are in the arena; give its <reserve> (line {}) a larger quantity",
                  quantity, Quoted(reserve), last->GetConfiguration().location.line));
}

// Returns a bound for the distance between the position of an entity and any point of its body.
double ReachOf(const CSwarmanoidSpaceEntity& entity) { return entity.GetSize().norm(); }

std::optional<placement::Body> BodyAt(const CSwarmanoidSpaceEntity& entity, const Pose& pose)
{
  EntityConfiguration placed;
  placed.kind = entity.GetKind();
  placed.size = entity.GetSize();
  placed.pose = pose;
  return placement::BodyOf(placed);
}

// `orientation`: the one of an order with a position alone.
Pose PoseOf(const ControlOrder& order, const Quaternion& orientation, const CSwarmanoidSpace& space)
{
  const auto numbers = order.Get<std::vector<double>>("pose");
  Pose pose{{numbers[0], numbers[1], numbers[2]}, orientation};
  const Vector3& size = space.GetExperiment().arena_size;
  if ((pose.position.array() < 0).any() || (pose.position.array() > size.array()).any())
    Refuse(fmt::format("{:g}, {:g}, {:g} is outside the arena, which reaches from 0, 0, 0 to {:g}, {:g}, {:g}",
                       numbers[0], numbers[1], numbers[2], size.x(), size.y(), size.z()));
  if (numbers.size() == 6)
    pose.orientation =
        QuaternionFromEuler({DegreesToRadians(numbers[3]), DegreesToRadians(numbers[4]), DegreesToRadians(numbers[5])});
  return pose;
}

// Throws unless all moved entities stay in the arena and none overlaps an entity that is not moved.
void RequireRoomFor(const CSwarmanoidSpace& space, const std::vector<MoveRequest>& moves)
{
  for (const MoveRequest& move : moves)
  {
    const CSwarmanoidSpaceEntity& entity = space.GetEntity(move.entity);
    const Vector3& at = move.pose.position;
    const Vector3& size = space.GetExperiment().arena_size;
    if (at.x() < 0 || at.y() < 0 || at.x() > size.x() || at.y() > size.y())
      Refuse(fmt::format("'{}' would come to {:.4g}, {:.4g}, {:.4g}, outside the arena; `detach` moves one alone",
                         entity.GetId(), at.x(), at.y(), at.z()));
  }
  RequireFree(space, moves);
}

}  // namespace

const CSwarmanoidSpaceEntity& FindToMove(const CSwarmanoidSpace& space, std::string_view id)
{
  const CSwarmanoidSpaceEntity& entity = Find(space, id);
  if (!entity.IsMovable()) Refuse(fmt::format("'{}' cannot move", entity.GetId()));
  RequirePresence(space, entity, true);
  return entity;
}

const CSwarmanoidSpaceEntity& FindToAdd(const CSwarmanoidSpace& space, std::string_view id)
{
  const CSwarmanoidSpaceEntity* entity = space.FindEntity(id);
  if (entity == nullptr) return FirstWaiting(space, id);
  RequireRemovable(*entity);
  RequirePresence(space, *entity, false);
  return *entity;
}

const CSwarmanoidSpaceEntity& FindToRemove(const CSwarmanoidSpace& space, std::string_view id)
{
  const CSwarmanoidSpaceEntity& entity = Find(space, id);
  RequireRemovable(entity);
  RequirePresence(space, entity, true);
  return entity;
}

const CSwarmanoidSpaceEntity* FindInTheWay(const CSwarmanoidSpace& space, const CSwarmanoidSpaceEntity& entity,
                                           const Pose& pose, std::span<const std::uint32_t> together)
{
  const auto body = BodyAt(entity, pose);
  if (!body) return nullptr;
  for (const EngineConfiguration& engine : space.GetExperiment().engines)
  {
    if (!std::binary_search(engine.entities.begin(), engine.entities.end(), entity.GetIndex())) continue;
    for (const std::uint32_t other : engine.entities)
    {
      if (other == entity.GetIndex() || !space.IsPresent(other)) continue;
      if (std::binary_search(together.begin(), together.end(), other)) continue;
      const CSwarmanoidSpaceEntity& there = space.GetEntity(other);
      const Pose at = space.GetPose(other);
      const double reach = ReachOf(entity) + ReachOf(there);
      if ((at.position - pose.position).squaredNorm() > reach * reach) continue;
      const auto taken = BodyAt(there, at);
      if (taken && placement::Overlap(*body, *taken)) return &there;
    }
  }
  return nullptr;
}

void RequireFree(const CSwarmanoidSpace& space, const CSwarmanoidSpaceEntity& entity, const Pose& pose,
                 std::span<const std::uint32_t> together)
{
  const CSwarmanoidSpaceEntity* there = FindInTheWay(space, entity, pose, together);
  if (there == nullptr) return;
  const Vector3 at = there->GetPosition();
  Refuse(
      fmt::format("'{}' does not fit at {:g}, {:g}, {:g}: the {} '{}' stands there, at {:.4g}, {:.4g}, {:.4g}; "
                  "choose a free place",
                  entity.GetId(), pose.position.x(), pose.position.y(), pose.position.z(), TagName(there->GetKind()),
                  there->GetId(), at.x(), at.y(), at.z()));
}

void RequireFree(const CSwarmanoidSpace& space, const std::vector<MoveRequest>& moves)
{
  std::vector<std::uint32_t> together;
  for (const MoveRequest& move : moves) together.push_back(move.entity);
  for (const MoveRequest& move : moves) RequireFree(space, space.GetEntity(move.entity), move.pose, together);
}

std::vector<MoveRequest> CompoundAt(const CSwarmanoidSpace& space, const CSwarmanoidSpaceEntity& entity,
                                    const Pose& pose)
{
  const CCompoundEntity compound = space.Structure().GetCompound(entity.GetIndex());
  const std::vector<Pose> poses = compound.PosesAt(entity.GetIndex(), pose);
  std::vector<MoveRequest> moves;
  for (std::size_t k = 0; k < poses.size(); ++k) moves.push_back({compound.GetMembers()[k], poses[k]});
  return moves;
}

MoveRequest Removal(const CSwarmanoidSpaceEntity& entity)
{
  return {entity.GetIndex(), WaitingPose(entity.GetConfiguration(), entity.GetIndex()), false};
}

SpaceChange ReadMove(const ControlOrder& order, const CSwarmanoidSpace& space)
{
  const CSwarmanoidSpaceEntity& entity = FindToMove(space, order.Get<std::string>("entity"));
  std::vector<MoveRequest> moves = CompoundAt(space, entity, PoseOf(order, entity.GetOrientation(), space));
  RequireRoomFor(space, moves);
  std::string done = fmt::format("moved '{}'", entity.GetId());
  if (moves.size() > 1) done += fmt::format(" and {} that it is connected to", moves.size() - 1);
  return {std::move(moves), entity.GetId(), std::move(done)};
}

SpaceChange ReadDetachment(const ControlOrder& order, const CSwarmanoidSpace& space)
{
  const CSwarmanoidSpaceEntity& entity = FindToMove(space, order.Get<std::string>("entity"));
  const Pose pose = PoseOf(order, entity.GetOrientation(), space);
  RequireFree(space, entity, pose);
  return {{{entity.GetIndex(), pose}}, entity.GetId(), fmt::format("moved '{}' alone", entity.GetId())};
}

SpaceChange ReadAddition(const ControlOrder& order, const CSwarmanoidSpace& space)
{
  const CSwarmanoidSpaceEntity& entity = FindToAdd(space, order.Get<std::string>("entity"));
  const Pose pose = PoseOf(order, Quaternion::Identity(), space);
  RequireFree(space, entity, pose);
  return {{{entity.GetIndex(), pose}}, entity.GetId(), fmt::format("added '{}'", entity.GetId())};
}

SpaceChange ReadRemoval(const ControlOrder& order, const CSwarmanoidSpace& space)
{
  const CSwarmanoidSpaceEntity& entity = FindToRemove(space, order.Get<std::string>("entity"));
  return {{Removal(entity)}, entity.GetId(), fmt::format("removed '{}'", entity.GetId())};
}

}  // namespace swarmanoid
