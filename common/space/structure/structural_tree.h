// The structural tree: which entity grips which. Trees whose roots are the gripped objects and whose leaves grip; a
// prey or a handbot may be held by several, a robot holds one thing with each gripper, loops are refused. Connections
// are rigid. The space has one (CSwarmanoidSpace::Structure), made from the attributes "gripped", so that every replica
// has the same one, and it is part of the state hash and of checkpoints; engines tell by these attributes who took hold
// and who let go.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "common/experiment/experiment.h"
#include "common/math/pose.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

// A set of connected entities that act as a whole: the root, which nothing else of the set is held by, and those that
// hold it or one another. A value: valid until the tree changes.
class CCompoundEntity
{
public:
  CCompoundEntity(const CSwarmanoidSpace& space, std::uint32_t root, std::vector<std::uint32_t> members);

  std::uint32_t GetRoot() const { return root_; }
  // The root and all that are connected to it, ascending.
  const std::vector<std::uint32_t>& GetMembers() const { return members_; }
  // Where each member is, in their order, when one of them is at a pose and carries the others along as one rigid body.
  // That one has the pose to the last bit; the others have theirs to the rounding of doubles.
  std::vector<Pose> PosesAt(std::uint32_t member, const Pose& pose) const;
  std::vector<Pose> PosesAt(const Pose& root_pose) const { return PosesAt(root_, root_pose); }

private:
  const CSwarmanoidSpace& space_;
  std::uint32_t root_;
  std::vector<std::uint32_t> members_;
};

class StructuralTree
{
public:
  static constexpr int kNothing = -1;

  // No connections yet. The space outlives the tree.
  explicit StructuralTree(const CSwarmanoidSpace& space);

  // The entity that one holds, or kNothing.
  int GetHeld(std::uint32_t gripper) const { return held_[gripper]; }
  bool Holds(std::uint32_t gripper, std::uint32_t gripped) const { return held_[gripper] == static_cast<int>(gripped); }
  // Those that hold an entity, ascending.
  std::vector<std::uint32_t> GetHolders(std::uint32_t gripped) const;
  // Itself if it holds nothing.
  std::uint32_t GetRoot(std::uint32_t entity) const;
  CCompoundEntity GetCompound(std::uint32_t member) const;

  // What speaks against `gripper` holding `gripped`: "" if nothing does. `held_after` tells of each entity what it will
  // hold when all that changes together has changed, or kNothing.
  std::string MistakeIn(std::uint32_t gripper, std::uint32_t gripped,
                        const std::function<int(std::uint32_t entity)>& held_after) const;

  // For the space, after a change of the attributes: takes over what they say, of one entity or of all.
  void Follow(std::uint32_t gripper);
  void FollowAll();

  // Kinds with a gripper: footbots and handbots. Kinds that can be held: those with a gripping strip (footbots,
  // handbots, preys) and movable blocks.
  static bool CanGrip(const EntityConfiguration& entity);
  static bool CanBeGripped(const EntityConfiguration& entity);
  // The movable entity of those that the hands of a robot hold (values of the attribute "gripped"), or kNothing. A hand
  // on a shelf holds on to the world: no part of a structure that moves.
  static int HeldBy(const Experiment& experiment, std::span<const double> hands);

private:
  std::string MistakeInKinds(std::uint32_t gripper, std::uint32_t gripped) const;
  void Unlink(std::uint32_t gripper);

  const CSwarmanoidSpace& space_;
  std::vector<int> held_;
  // The holders of each entity, ascending, as a list: the first one, and of each holder the one after it.
  std::vector<int> first_holder_, next_holder_;
};

}  // namespace swarmanoid
