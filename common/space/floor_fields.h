// FloorFields: the fields on the floor of an experiment, and the robots that write to them. Every process that keeps
// the fields computes them from the same deposits with the same code, so the bits are equal and no cells travel. What
// experiment functions change travels as cells, and so does the whole field in snapshots.
//
// The fields of tick t + 1 are those of tick t, plus the deposits in the order of the entities, by the poses and rates
// in the state of tick t, and then a step, if one is due. One thread at a time may use them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/space/floor_field.h"
#include "idl/field_cells.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

class FloorFields
{
public:
  // The experiment must outlive the fields.
  explicit FloorFields(const Experiment& experiment);

  std::size_t size() const { return fields_.size(); }
  bool empty() const { return fields_.empty(); }
  const FloorField& operator[](std::size_t number) const { return fields_[number]; }
  // Returns the number of the field with that id. Throws std::invalid_argument if there is none.
  std::size_t NumberOf(std::string_view id) const;
  const FloorField& Field(std::string_view id) const { return fields_[NumberOf(id)]; }
  // Returns a number that changes with every change of a field.
  std::uint64_t Revision() const { return revision_; }
  // Returns the slot of a robot's rate of deposits to the first field; those to the others follow. The robot must have
  // the actuator floor_field.
  std::uint32_t RateSlotOf(std::uint32_t entity) const;
  // Returns whether this process keeps the fields.
  bool AreKept() const { return are_kept_; }
  void WriteCells(FieldCells& cells) const;
  // Calls use(numbers) with the number and the values of each run of cells that are not 0, ascending.
  template <class Use>
  void VisitRuns(Use use) const
  {
    for (std::size_t k = 0; k < fields_.size(); ++k)
      fields_[k].VisitRuns([&](std::size_t cell, std::span<const float> run) { use(FirstCell(k) + cell, run); });
  }
  // The cells of all fields are numbered, field after field.
  std::uint32_t FirstCell(std::size_t number) const { return first_cells_[number]; }
  std::uint32_t Cells() const { return first_cells_.back(); }
  float ValueOf(std::uint32_t cell) const;

  // The functions below change the fields, and are for the role that owns the space.
  // Adds a robot with the actuator floor_field whose rates begin at `slot`. The robots are added in the order of the
  // entities.
  void AddDepositor(std::uint32_t entity, std::uint32_t slot);
  // Brings the fields to the tick after that of the space, whose poses and attributes are of its tick.
  void Advance(const CSwarmanoidSpace& space);
  void Set(std::uint32_t cell, float value);
  void SetCells(const FieldCells& cells);
  // Takes the whole fields; all other cells are 0.
  void Load(const FieldCells& cells);
  // From now on, this process does not compute the fields.
  void Stop() { are_kept_ = false; }

private:
  struct Depositor
  {
    std::uint32_t entity;
    std::uint32_t slot;
    Vector3 point;  // m, in the frame of the robot
  };

  std::size_t FieldOf(std::uint32_t cell) const;

  const Experiment& experiment_;
  std::vector<FloorField> fields_;
  std::vector<std::uint32_t> first_cells_;  // by field; at the end the number of all cells
  std::vector<Depositor> depositors_;
  std::uint64_t revision_ = 1;
  bool are_kept_ = true;
};

// Returns the number of cells of all fields.
std::size_t FloorFieldCells(const Experiment& experiment);
// Returns the number of slots for the rates of an entity's deposits: one for each field if it has the actuator.
std::size_t DepositSlots(const Experiment& experiment, const EntityConfiguration& entity);
// Adds a cell behind all others.
void AddCell(FieldCells& cells, std::uint32_t cell, float value);
// Returns the mistake in cells of a message or file, for fields with `all` cells; empty for none.
std::string MistakeIn(const FieldCells& cells, std::size_t all);

}  // namespace swarmanoid
