// TickLimits derives the limits of tick messages from an experiment: the lengths of arrays, and the valid slots and
// entities. They give the memory that messages need, and the checks of arriving messages. All processes of a run have
// the same limits. The limits never change, so any thread may ask for them.
#pragma once

#include <cstdint>
#include <vector>

#include "common/messages/assignment.h"
#include "common/messages/tick_messages.h"
#include "idl/messages.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

// Bytes of the largest messages of an engine that is split, if one region has all bodies.
struct RegionLimits
{
  std::size_t bodies = 0;
  std::size_t mirrors = 0;  // bodies of other engines

  std::size_t TaskBytes() const;
  std::size_t HaloBytes() const;
  std::size_t ResultBytes() const;
};

class TickLimits
{
public:
  // `recorded`: WorldMessage::recorded.
  TickLimits(const CSwarmanoidSpace& space, const Assignment& assignment, bool recorded);

  // Return the bytes of the largest message of a kind, from any sender.
  std::size_t StateBytes() const;
  std::size_t LocalStateBytes() const;
  std::size_t CommandBytes() const;
  std::size_t UpdateBytes() const;
  std::size_t FrameBytes() const;
  static std::size_t DrawnBytes();
  // Returns the limits of the largest split engine.
  RegionLimits Regions() const { return {most_in_regions_, most_mirrors_}; }

  // Check a message. Throw BadMessage with the name of the field.
  void Check(const MessageHeader& header, const SpaceState& state) const;
  void Check(const MessageHeader& header, const LocalState& state) const;
  void Check(const MessageHeader& header, const ControlCommands& commands) const;
  void Check(const MessageHeader& header, const EngineUpdate& update) const;
  void Check(const MessageHeader& header, const SensorFrame& frame) const;
  void Check(const SpaceSnapshot& snapshot) const;
  // Checks the sender of a message of that kind, before the message is read.
  template <class Message>
  void CheckSource(const MessageHeader& header) const;
  // The same if the senders are numbered from 0 to `senders` - 1.
  static void CheckSource(const MessageHeader& header, std::size_t senders);

private:
  void CheckSlots(const AttributeChanges& changes) const;
  void CheckMoved(const std::vector<std::uint32_t>& moved) const;
  void CheckDrawing(const Drawing& drawing) const;
  void CheckCells(const FieldCells& cells) const;
  void CheckFaults(const ControllerFaults& faults) const;

  std::size_t entities_;
  std::size_t movable_;
  std::size_t slots_;
  std::size_t cells_;                        // of floor fields
  bool sets_cells_;                          // experiment functions may change them
  bool draws_;                               // states have the drawings of experiment functions
  std::vector<bool> is_movable_;             // by entity
  std::vector<bool> may_fail_;               // by entity
  std::vector<std::size_t> command_values_;  // by host
  std::vector<std::size_t> owned_;           // by engine
  std::vector<std::size_t> recorded_;        // by engine: numbers in EngineUpdate::recorded
  std::vector<std::size_t> sensor_values_;   // by engine
  std::size_t most_in_regions_ = 0;          // bodies of one engine that is split
  std::size_t most_mirrors_ = 0;             // bodies of other engines in one split engine
};

}  // namespace swarmanoid
