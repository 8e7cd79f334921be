// StructuralTree: the grips between entities. The root of a tree is a gripped object, and leaves grip. A prey or a
// handbot may be held by several entities, a robot holds one entity with each gripper, and loops are refused.
// Connections are rigid. The space has one (CSwarmanoidSpace::Structure), made from the attributes "gripped". So every
// replica has the same tree, and it is part of the state hash and of checkpoints. Engines report grips and releases by
// these attributes.
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

// A set of connected entities that move as a whole: the root, which holds no other member, and the entities that hold
// it or each other. It is valid until the tree changes.
class CCompoundEntity
{
public:
  CCompoundEntity(const CSwarmanoidSpace& space, std::uint32_t root, std::vector<std::uint32_t> members);

  std::uint32_t GetRoot() const { return root_; }
  // Returns the root and all entities that are connected to it, ascending.
  const std::vector<std::uint32_t>& GetMembers() const { return members_; }
  // Returns the pose of each member, in their order, when one member is at a pose and carries the others as one rigid
  // body. That member has the pose to the last bit; the others have theirs to the rounding of doubles.
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

  // Makes a tree without connections. The space must outlive the tree.
  explicit StructuralTree(const CSwarmanoidSpace& space);

  // Returns the entity that one holds, or kNothing.
  int GetHeld(std::uint32_t gripper) const { return held_[gripper]; }
  bool Holds(std::uint32_t gripper, std::uint32_t gripped) const { return held_[gripper] == static_cast<int>(gripped); }
  // Returns the entities that hold an entity, ascending.
  std::vector<std::uint32_t> GetHolders(std::uint32_t gripped) const;
  // Returns the root of an entity's tree; the entity itself if it holds nothing.
  std::uint32_t GetRoot(std::uint32_t entity) const;
  CCompoundEntity GetCompound(std::uint32_t member) const;

  // Returns the reason why `gripper` cannot hold `gripped`, or "". `held_after` returns for each entity what it will
  // hold after all changes of the same tick, or kNothing.
  std::string MistakeIn(std::uint32_t gripper, std::uint32_t gripped,
                        const std::function<int(std::uint32_t entity)>& held_after) const;

  // The space calls these after a change of the attributes, to update one entity or all.
  void Follow(std::uint32_t gripper);
  void FollowAll();

  // CanGrip is true for kinds with a gripper: footbots and handbots. CanBeGripped is true for kinds with a gripping
  // strip (footbots, handbots, preys) and movable blocks.
  static bool CanGrip(const EntityConfiguration& entity);
  static bool CanBeGripped(const EntityConfiguration& entity);
  // Returns the movable entity among those that the hands of a robot hold (values of the attribute "gripped"), or
  // kNothing. A hand on a shelf holds the world, which is not part of a moving structure.
  static int HeldBy(const Experiment& experiment, std::span<const double> hands);

private:
  std::string MistakeInKinds(std::uint32_t gripper, std::uint32_t gripped) const;
  void Unlink(std::uint32_t gripper);

  const CSwarmanoidSpace& space_;
  std::vector<int> held_;
  // The holders of each entity are a linked list, ascending: these are the first holder, and for each holder the next
  // one.
  std::vector<int> first_holder_, next_holder_;
};

}  // namespace swarmanoid
