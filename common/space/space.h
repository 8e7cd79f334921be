// CSwarmanoidSpace: the 3D space of the simulation: entities with global poses, their attributes, and the clock. Every
// process holds one. The space server has the original, and the others follow it by SpaceState. Readers (sensors,
// engines, renderers, experiment functions, programs of users) get a const reference, which gives const entities. Only
// the server and the replicas write to it. One thread at a time may use it.
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
#include "common/space/floor_fields.h"
#include "common/space/make_entity.h"
#include "common/space/pose_arrays.h"
#include "common/space/slot_table.h"
#include "common/space/structural_tree.h"

namespace swarmanoid
{

class CSwarmanoidSpace
{
public:
  // Makes the initial state of the experiment, which must outlive the space.
  explicit CSwarmanoidSpace(const Experiment& experiment);
  ~CSwarmanoidSpace();
  CSwarmanoidSpace(const CSwarmanoidSpace&) = delete;
  CSwarmanoidSpace& operator=(const CSwarmanoidSpace&) = delete;

  const Experiment& GetExperiment() const { return experiment_; }
  std::uint64_t GetTick() const { return tick_; }
  double GetTickSeconds() const { return experiment_.TickSeconds(); }
  double GetTime() const { return static_cast<double>(tick_) * GetTickSeconds(); }
  // Returns the tick at which the run began: 0, or later if experiment functions began it again
  // (SpaceEditor::BeginAgain).
  std::uint64_t FirstTick() const { return first_tick_; }
  // Returns the tick for random numbers: the count from the first tick, with the variation of BeginAgain in the upper
  // half.
  std::uint64_t StreamTick() const { return (tick_ - first_tick_) | std::uint64_t{variation_} << 32U; }

  std::size_t Size() const { return entities_.size(); }
  const CSwarmanoidSpaceEntity& GetEntity(std::size_t index) const { return *entities_[index]; }
  CSwarmanoidSpaceEntity& GetEntity(std::size_t index) { return *entities_[index]; }
  // Return nullptr if no entity has that id.
  const CSwarmanoidSpaceEntity* FindEntity(std::string_view id) const;
  CSwarmanoidSpaceEntity* FindEntity(std::string_view id);

  const PoseArrays& Poses() const { return poses_; }
  Pose GetPose(std::size_t index) const;
  // Returns false for entities of a <reserve> that were not added yet, and for removed entities.
  bool IsPresent(std::size_t index) const { return attributes_[first_presence_ + index] != 0; }
  // Returns the entities outside the arena, ascending.
  std::span<const std::uint32_t> Absent() const { return absent_; }
  // Returns all slots: those of the entities in their order, then the presence of each, 1 or 0.
  const SparseVector<double>& Attributes() const { return attributes_; }
  // Returns the meaning of each slot.
  const SlotTable& AttributeValues() const { return attribute_values_; }
  std::uint32_t PresenceSlot(std::size_t index) const { return first_presence_ + static_cast<std::uint32_t>(index); }
  // Returns the grips between entities, from the attributes "gripped".
  const StructuralTree& Structure() const { return structure_; }
  // Returns the slots of the attribute "gripped" of an entity, one for each of its grippers.
  std::uint32_t FirstHandSlot(std::size_t index) const;
  std::span<const double> Hands(std::size_t index) const;
  // Returns the slots of an entity that changes its engine (EngineSlots): place k in Experiment::engine_choices.
  std::uint32_t EngineSlot(std::size_t k) const { return engine_slots_[k]; }
  // Returns whether an engine moves such an entity in the next tick.
  bool IsMovedBy(std::size_t k, std::uint32_t engine) const
  {
    return attributes_[engine_slots_[k] + EngineSlots::kEngine] == engine;
  }
  // Returns the engine that moved an entity that changes its engine in the last tick.
  std::uint32_t EngineBefore(std::uint32_t entity) const;
  // Returns the engine that moves an entity in the next tick. `engines` are those of the start (Assignment::owner).
  int EngineOf(std::uint32_t entity, std::span<const int> engines) const;
  // Returns the fields on the floor. Throws std::logic_error in a process that does not keep them: engine workers, and
  // controller hosts of which all devices have a Reach.
  const FloorFields& Fields() const;
  // Returns the slot of a robot's rate of deposits to the first floor field; those to the others follow. The robot must
  // have the actuator floor_field.
  std::uint32_t RateSlotOf(std::uint32_t entity) const { return fields_.RateSlotOf(entity); }
  // Returns the indices of the movable entities, ascending.
  std::span<const std::uint32_t> Movable() const { return movable_; }

  // Returns a number that changes with every change of a pose, so that indexes know when to update.
  std::uint64_t Revision() const { return revision_; }
  // Returns a number that changes with every change of an attribute.
  std::uint64_t AttributeRevision() const { return attribute_revision_; }

  // The functions below change the state, and are for the role that owns this space.
  void SetTick(std::uint64_t tick) { tick_ = tick; }
  void BeginAgain(std::uint64_t first_tick, std::uint32_t variation)
  {
    first_tick_ = first_tick;
    variation_ = variation;
  }
  void SetPose(std::size_t index, const Pose& pose);
  // `poses` is a structure of arrays over `entities`, as in EngineUpdate.
  void SetPoses(std::span<const std::uint32_t> entities, std::span<const double> poses);
  void SetAttribute(std::uint32_t slot, double value);
  void SetAttributes(const AttributeChanges& changes);
  // Returns the fields on the floor for changes.
  FloorFields& Fields() { return fields_; }
  // Brings the floor fields to the tick after the present one. Call it before any value of the next state is set.
  void AdvanceFields() { fields_.Advance(*this); }

  // Returns the drawing of experiment functions at this tick. It is empty unless a visualiser needs it, and is no part
  // of the state.
  const Drawing& GetDrawing() const { return drawing_; }
  // Returns a number that changes with the drawing.
  std::uint64_t DrawingRevision() const { return drawing_revision_; }
  // Takes the shapes of `drawing` and gives it the old ones, so that their memory is used again. If both are equal,
  // nothing changes.
  void SwapDrawing(Drawing& drawing);

  // Brings a replica to the tick of the message.
  void Apply(const SpaceState& state);
  // Brings a replica to the tick of a local message. `near` is that of the message before, at first empty, and becomes
  // that of this message.
  void Apply(const LocalState& state, std::vector<std::uint32_t>& near);
  void Apply(const SpaceSnapshot& snapshot);
  void WritePoses(std::vector<double>& poses) const;  // writes the poses of the movable entities, as in SpaceState

  // Returns XXH3-64 over the tick, the bits of all poses and the attributes, in entity order, the indices of the
  // entities outside the arena, and the cells of floor fields that are not 0.
  std::uint64_t Hash() const;

private:
  void FindAbsent();
  void LeaveOut(const std::vector<std::uint32_t>& near);
  // Returns the position of the id in place_of_id_, or the free position for it.
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
  SparseVector<double> attributes_;  // most are 0: dark LEDs, no messages
  SlotTable attribute_values_;
  std::uint32_t first_presence_ = 0;  // slot
  std::vector<std::uint32_t> engine_slots_;
  std::vector<std::uint32_t> absent_;
  std::vector<std::uint32_t> movable_;
  std::pmr::monotonic_buffer_resource memory_of_entities_;
  std::vector<EntityPointer> entities_;
  // The table has open addresses (Knuth, The Art of Computer Programming, volume 3, 6.4): 1 + index is at the hash of
  // the id or behind it, and 0 is a free place.
  std::vector<std::uint32_t> place_of_id_;
  StructuralTree structure_;
  FloorFields fields_;
};

}  // namespace swarmanoid
