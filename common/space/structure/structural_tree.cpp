#include "common/space/structure/structural_tree.h"

#include <algorithm>

namespace swarmanoid
{

CCompoundEntity::CCompoundEntity(const CSwarmanoidSpace& space, std::uint32_t root, std::vector<std::uint32_t> members)
    : space_(space), root_(root), members_(std::move(members))
{
}

std::vector<Pose> CCompoundEntity::PosesAt(const Pose& root_pose) const
{
  const Pose from_root = space_.GetPose(root_).Inverse();
  std::vector<Pose> poses;
  for (const std::uint32_t member : members_)
    poses.push_back(member == root_ ? root_pose : root_pose.Compose(from_root.Compose(space_.GetPose(member))));
  return poses;
}

StructuralTree::StructuralTree(const CSwarmanoidSpace& space) : space_(space), held_(space.Size(), -1) {}

void StructuralTree::Rebuild()
{
  std::fill(held_.begin(), held_.end(), -1);
  for (std::uint32_t i = 0; i < held_.size(); ++i)
  {
    const CSwarmanoidSpaceEntity& entity = space_.GetEntity(i);
    if (!CanGrip(entity)) continue;
    const int hands = DescriptionOf(entity.GetKind()).grippers;
    for (int hand = 0; hand < hands; ++hand)
    {
      const double held = entity.GetAttribute("gripped", hand);
      if (held == 0) continue;
      const auto gripped = static_cast<std::uint32_t>(held) - 1;
      // A hand on a shelf holds on to the world: no part of a structure that moves.
      if (!space_.GetEntity(gripped).IsMovable()) continue;
      // Both hands of a handbot may be on the same object; handbots manipulate one object at a time.
      if (held_[i] != static_cast<int>(gripped)) Attach(i, gripped);
    }
  }
}

void StructuralTree::Check(std::uint32_t gripper, std::uint32_t gripped) const
{
  const CSwarmanoidSpaceEntity& a = space_.GetEntity(gripper);
  const CSwarmanoidSpaceEntity& b = space_.GetEntity(gripped);
  const std::string both = "'" + a.GetId() + "' cannot grip '" + b.GetId() + "': ";
  if (gripper == gripped) throw StructureError(both + "an entity cannot grip itself");
  if (!CanGrip(a)) throw StructureError(both + "a " + std::string(TagName(a.GetKind())) + " has no gripper");
  if (!CanBeGripped(b))
    throw StructureError(both + "a " + (b.IsMovable() ? "" : "fixed ") + std::string(TagName(b.GetKind())) +
                         " has nothing to grip");
  if (held_[gripper] >= 0)
    throw StructureError(both + "it holds '" + space_.GetEntity(static_cast<std::size_t>(held_[gripper])).GetId() +
                         "' already");
  if (GetRoot(gripped) == gripper) throw StructureError(both + "the connection would close a loop");
}

void StructuralTree::Attach(std::uint32_t gripper, std::uint32_t gripped)
{
  Check(gripper, gripped);
  held_[gripper] = static_cast<int>(gripped);
}

void StructuralTree::Detach(std::uint32_t gripper) { held_[gripper] = -1; }

std::vector<std::uint32_t> StructuralTree::GetHolders(std::uint32_t gripped) const
{
  std::vector<std::uint32_t> holders;
  for (std::uint32_t i = 0; i < held_.size(); ++i)
    if (held_[i] == static_cast<int>(gripped)) holders.push_back(i);
  return holders;
}

std::uint32_t StructuralTree::GetRoot(std::uint32_t entity) const
{
  while (held_[entity] >= 0) entity = static_cast<std::uint32_t>(held_[entity]);
  return entity;
}

CCompoundEntity StructuralTree::GetCompound(std::uint32_t member) const
{
  const std::uint32_t root = GetRoot(member);
  std::vector<std::uint32_t> members;
  for (std::uint32_t i = 0; i < held_.size(); ++i)
    if (GetRoot(i) == root) members.push_back(i);
  return {space_, root, std::move(members)};
}

bool StructuralTree::CanGrip(const CSwarmanoidSpaceEntity& entity)
{
  return DescriptionOf(entity.GetKind()).grippers > 0;
}

bool StructuralTree::CanBeGripped(const CSwarmanoidSpaceEntity& entity)
{
  return entity.IsMovable() && DescriptionOf(entity.GetKind()).grippable;
}

}  // namespace swarmanoid
