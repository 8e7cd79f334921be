// Grips are attributes of the gripping entities, and change at any tick. The tree follows them. held_ has the entity
// that each gripper holds; first_holder_ and next_holder_ have the same grips from the other side, as one linked list
// for each held entity. A change costs as many steps as the entity has holders.
//
// Invariants: both views have the same grips; the lists ascend, so that every replica visits holders in the same order;
// the space server lets no loop in (MistakeIn), so that the way to a root ends.
#include "common/space/structural_tree.h"

#include <algorithm>

#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

std::string Both(const EntityConfiguration& gripper, const EntityConfiguration& gripped)
{
  return "'" + gripper.id + "' cannot grip '" + gripped.id + "': ";
}

}  // namespace

CCompoundEntity::CCompoundEntity(const CSwarmanoidSpace& space, std::uint32_t root, std::vector<std::uint32_t> members)
    : space_(space), root_(root), members_(std::move(members))
{
}

std::vector<Pose> CCompoundEntity::PosesAt(std::uint32_t member, const Pose& pose) const
{
  const Pose from_member = space_.GetPose(member).Inverse();
  std::vector<Pose> poses;
  for (const std::uint32_t one : members_)
    poses.push_back(one == member ? pose : pose.Compose(from_member.Compose(space_.GetPose(one))));
  return poses;
}

StructuralTree::StructuralTree(const CSwarmanoidSpace& space)
    : space_(space),
      held_(space.GetExperiment().entities.size(), kNothing),
      first_holder_(held_.size(), kNothing),
      next_holder_(held_.size(), kNothing)
{
}

int StructuralTree::HeldBy(const Experiment& experiment, std::span<const double> hands)
{
  // A replica may get any values, so only numbers of entities are accepted.
  const auto most = static_cast<double>(experiment.entities.size());
  for (const double hand : hands)
    if (hand >= 1 && hand <= most && experiment.entities[static_cast<std::size_t>(hand) - 1].movable)
      return static_cast<int>(hand) - 1;
  return kNothing;
}

void StructuralTree::Unlink(std::uint32_t gripper)
{
  int* link = &first_holder_[static_cast<std::size_t>(held_[gripper])];
  while (*link != static_cast<int>(gripper)) link = &next_holder_[static_cast<std::size_t>(*link)];
  *link = next_holder_[gripper];
  held_[gripper] = next_holder_[gripper] = kNothing;
}

void StructuralTree::Follow(std::uint32_t gripper)
{
  const int held = HeldBy(space_.GetExperiment(), space_.Hands(gripper));
  if (held == held_[gripper]) return;
  if (held_[gripper] != kNothing) Unlink(gripper);
  held_[gripper] = held;
  if (held == kNothing) return;
  int* link = &first_holder_[static_cast<std::size_t>(held)];
  while (*link != kNothing && *link < static_cast<int>(gripper)) link = &next_holder_[static_cast<std::size_t>(*link)];
  next_holder_[gripper] = *link;
  *link = static_cast<int>(gripper);
}

void StructuralTree::FollowAll()
{
  for (std::uint32_t i = 0; i < held_.size(); ++i) Follow(i);
}

std::string StructuralTree::MistakeInKinds(std::uint32_t gripper, std::uint32_t gripped) const
{
  const EntityConfiguration& a = space_.GetExperiment().entities[gripper];
  const EntityConfiguration& b = space_.GetExperiment().entities[gripped];
  if (gripper == gripped) return Both(a, b) + "an entity cannot grip itself";
  if (!CanGrip(a)) return Both(a, b) + "a " + std::string(TagName(a.kind)) + " has no gripper";
  if (!CanBeGripped(b))
    return Both(a, b) + "a " + (b.movable ? "" : "fixed ") + std::string(TagName(b.kind)) + " has nothing to grip";
  return {};
}

std::string StructuralTree::MistakeIn(std::uint32_t gripper, std::uint32_t gripped,
                                      const std::function<int(std::uint32_t entity)>& held_after) const
{
  if (std::string mistake = MistakeInKinds(gripper, gripped); !mistake.empty()) return mistake;
  std::size_t steps = 0;
  for (int at = static_cast<int>(gripped); at != kNothing; at = held_after(static_cast<std::uint32_t>(at)))
    if (at == static_cast<int>(gripper) || ++steps > held_.size())
      return Both(space_.GetExperiment().entities[gripper], space_.GetExperiment().entities[gripped]) +
             "the connection would close a loop";
  return {};
}

std::vector<std::uint32_t> StructuralTree::GetHolders(std::uint32_t gripped) const
{
  std::vector<std::uint32_t> holders;
  for (int holder = first_holder_[gripped]; holder != kNothing; holder = next_holder_[static_cast<std::size_t>(holder)])
    holders.push_back(static_cast<std::uint32_t>(holder));
  return holders;
}

std::uint32_t StructuralTree::GetRoot(std::uint32_t entity) const
{
  while (held_[entity] != kNothing) entity = static_cast<std::uint32_t>(held_[entity]);
  return entity;
}

CCompoundEntity StructuralTree::GetCompound(std::uint32_t member) const
{
  std::vector<std::uint32_t> members{GetRoot(member)};
  for (std::size_t k = 0; k < members.size(); ++k)
    for (const std::uint32_t holder : GetHolders(members[k])) members.push_back(holder);
  const std::uint32_t root = members.front();
  std::sort(members.begin(), members.end());
  return {space_, root, std::move(members)};
}

bool StructuralTree::CanGrip(const EntityConfiguration& entity) { return DescriptionOf(entity.kind).grippers > 0; }

bool StructuralTree::CanBeGripped(const EntityConfiguration& entity)
{
  return entity.movable && DescriptionOf(entity.kind).grippable;
}

}  // namespace swarmanoid
