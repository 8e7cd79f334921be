// CSwarmanoidSpace: the 3D space in which everything is simulated. Entities with global poses, their attributes, the
// clock. Every process holds one; the space server's is the original, the others follow it by SpaceState. Whoever reads
// (sensors, engines, renderers, experiment functions, programs of users) gets a const one, which gives const entities;
// only the server and the replicas have one to write to. One thread at a time.
#pragma once

#include <memory>
#include <memory_resource>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/experiment/experiment.h"
#include "common/math/zeroed_vector.h"
#include "common/messages/tick_messages.h"
#include "common/space/attributes.h"
#include "common/space/make_entity.h"
#include "common/space/pose_arrays.h"
#include "common/space/slot_table.h"
#include "common/space/structure/structural_tree.h"

namespace swarmanoid
{

class CSwarmanoidSpace
{
public:
  // The initial state of the experiment, which must outlive the space.
  explicit CSwarmanoidSpace(const Experiment& experiment);
  ~CSwarmanoidSpace();
  CSwarmanoidSpace(const CSwarmanoidSpace&) = delete;
  CSwarmanoidSpace& operator=(const CSwarmanoidSpace&) = delete;

  const Experiment& GetExperiment() const { return experiment_; }
  std::uint64_t GetTick() const { return tick_; }
  double GetTickSeconds() const { return experiment_.TickSeconds(); }
  double GetTime() const { return static_cast<double>(tick_) * GetTickSeconds(); }
  // The tick at which the run began: 0, or later if experiment functions began it again (SpaceEditor::BeginAgain).
  std::uint64_t FirstTick() const { return first_tick_; }
  // As what tick random numbers are drawn now: counted from the first one, in the upper half what was given with it.
  std::uint64_t StreamTick() const { return (tick_ - first_tick_) | std::uint64_t{variation_} << 32U; }

  std::size_t Size() const { return entities_.size(); }
  const CSwarmanoidSpaceEntity& GetEntity(std::size_t index) const { return *entities_[index]; }
  CSwarmanoidSpaceEntity& GetEntity(std::size_t index) { return *entities_[index]; }
  // nullptr if no entity has that id.
  const CSwarmanoidSpaceEntity* FindEntity(std::string_view id) const;
  CSwarmanoidSpaceEntity* FindEntity(std::string_view id);

  const PoseArrays& Poses() const { return poses_; }
  Pose GetPose(std::size_t index) const;
  // False for the entities of a <reserve> that were not added yet, and for those that were removed.
  bool IsPresent(std::size_t index) const { return attributes_[first_presence_ + index] != 0; }
  // Those that are not in the arena, ascending.
  std::span<const std::uint32_t> Absent() const { return absent_; }
  // All slots: those of the entities in their order, then the presence of each, 1 or 0.
  const SparseVector<double>& Attributes() const { return attributes_; }
  // What each slot stands for.
  const SlotTable& AttributeValues() const { return attribute_values_; }
  std::uint32_t PresenceSlot(std::size_t index) const { return first_presence_ + static_cast<std::uint32_t>(index); }
  // Who holds whom, as the attributes "gripped" say.
  const StructuralTree& Structure() const { return structure_; }
  // The slots of the attribute "gripped" of an entity, one for each of its grippers.
  std::uint32_t FirstHandSlot(std::size_t index) const;
  std::span<const double> Hands(std::size_t index) const;
  // Indices of the entities that can move, ascending.
  std::span<const std::uint32_t> Movable() const { return movable_; }

  // Changes with every change of a pose, so that indexes know when to follow.
  std::uint64_t Revision() const { return revision_; }
  // Likewise with every change of an attribute.
  std::uint64_t AttributeRevision() const { return attribute_revision_; }

  // Changes of the state, for the role that owns this space.
  void SetTick(std::uint64_t tick) { tick_ = tick; }
  void BeginAgain(std::uint64_t first_tick, std::uint32_t variation)
  {
    first_tick_ = first_tick;
    variation_ = variation;
  }
  void SetPose(std::size_t index, const Pose& pose);
  // poses: structure of arrays over `entities`, as in EngineUpdate.
  void SetPoses(std::span<const std::uint32_t> entities, std::span<const double> poses);
  void SetAttribute(std::uint32_t slot, double value);
  void SetAttributes(const AttributeChanges& changes);

  // What experiment functions draw at this tick; empty unless somebody looks. No part of the state.
  const Drawing& GetDrawing() const { return drawing_; }
  // Changes when that does.
  std::uint64_t DrawingRevision() const { return drawing_revision_; }
  // The former one is left in `drawing`.
  void SwapDrawing(Drawing& drawing);

  // Brings a replica to the tick of the message.
  void Apply(const SpaceState& state);
  // Likewise of a message to a host. `near`: that of the message before, at first empty; becomes that of this one.
  void Apply(const LocalState& state, std::vector<std::uint32_t>& near);
  void Apply(const SpaceSnapshot& snapshot);
  void WritePoses(std::vector<double>& poses) const;  // of the movable entities, as in SpaceState

  // XXH3-64 over the tick, the bits of all poses and the attributes, in entity order, and the indices of those that are
  // not in the arena.
  std::uint64_t Hash() const;

private:
  void FindAbsent();
  void LeaveOut(const std::vector<std::uint32_t>& near);
  // Where the id stands in place_of_id_, or the free place where it would.
  std::size_t PlaceOfId(std::string_view id) const;
  void SetDrawing(const Drawing& drawing);

  const Experiment& experiment_;
  std::uint64_t tick_ = 0;
  std::uint64_t first_tick_ = 0;
  std::uint32_t variation_ = 0;
  std::uint64_t revision_ = 1;
  std::uint64_t attribute_revision_ = 1;
  std::uint64_t drawing_revision_ = 1;
  Drawing drawing_;
  PoseArrays poses_;
  SparseVector<double> attributes_;  // most are 0: LEDs that are dark, messages that nobody sends
  SlotTable attribute_values_;
  std::uint32_t first_presence_ = 0;  // slot
  std::vector<std::uint32_t> absent_;
  std::vector<std::uint32_t> movable_;
  std::pmr::monotonic_buffer_resource memory_of_entities_;
  std::vector<EntityPointer> entities_;
  // A table with open addresses (Knuth, The Art of Computer Programming, volume 3, 6.4): 1 + index at the hash of the
  // id or behind it, 0: free.
  std::vector<std::uint32_t> place_of_id_;
  StructuralTree structure_;
};

}  // namespace swarmanoid
