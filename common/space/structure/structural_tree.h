// The structural tree: which entity grips which. Trees whose roots are the gripped objects and whose leaves grip; a
// prey or a handbot may be held by several, a robot holds one thing with each gripper, loops are refused. Connections
// are rigid.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/math/pose.h"
#include "common/space/space.h"

namespace swarmanoid
{

// A connection that cannot be: it names both entities and the reason.
class StructureError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

// A set of connected entities that act as a whole: the root, which nothing else of the set is held by, and those that
// hold it or one another. A value: valid until the tree changes.
class CCompoundEntity
{
public:
  CCompoundEntity(const CSwarmanoidSpace& space, std::uint32_t root, std::vector<std::uint32_t> members);

  std::uint32_t GetRoot() const { return root_; }
  // The root and all that are connected to it, ascending.
  const std::vector<std::uint32_t>& GetMembers() const { return members_; }
  // Where each member is, in their order, when the root is at a pose and carries the others along as one rigid body.
  // SpaceEditor::MoveCompound puts them there.
  std::vector<Pose> PosesAt(const Pose& root_pose) const;

private:
  const CSwarmanoidSpace& space_;
  std::uint32_t root_;
  std::vector<std::uint32_t> members_;
};

class StructuralTree
{
public:
  // No connections yet. The space outlives the tree.
  explicit StructuralTree(const CSwarmanoidSpace& space);

  // Reads the connections that the space has: the attributes "gripped" of all robots. Throws StructureError for a loop.
  void Rebuild();

  // gripper takes hold of gripped. Throws StructureError if gripper has no gripper or holds something already,
  // gripped cannot be held, both are the same, or a loop would arise.
  void Attach(std::uint32_t gripper, std::uint32_t gripped);
  // gripper lets go; nothing happens if it holds nothing.
  void Detach(std::uint32_t gripper);

  // The entity that one holds, or -1.
  int GetHeld(std::uint32_t gripper) const { return held_[gripper]; }
  // Those that hold an entity, ascending.
  std::vector<std::uint32_t> GetHolders(std::uint32_t gripped) const;
  // Itself if it holds nothing.
  std::uint32_t GetRoot(std::uint32_t entity) const;
  CCompoundEntity GetCompound(std::uint32_t member) const;

  // Kinds with a gripper: footbots and handbots. Kinds that can be held: those with a gripping strip (footbots,
  // handbots, preys) and movable blocks.
  static bool CanGrip(const CSwarmanoidSpaceEntity& entity);
  static bool CanBeGripped(const CSwarmanoidSpaceEntity& entity);

private:
  void Check(std::uint32_t gripper, std::uint32_t gripped) const;

  const CSwarmanoidSpace& space_;
  std::vector<int> held_;
};

}  // namespace swarmanoid
