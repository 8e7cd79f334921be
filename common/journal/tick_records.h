// The content that a journal keeps of each tick, and the packing of ticks into one block. Rows of doubles, one a tick,
// are stored column by column (packed_rows.h). Each number is stored as its integer difference from the value that
// earlier ticks predict. Smooth motion gives small differences, which compress well.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/checkpoint/checkpoint.h"
#include "common/journal/packed_rows.h"
#include "common/messages/assignment.h"
#include "common/messages/tick_messages.h"
#include "common/serialisation/bytes.h"

namespace swarmanoid
{

// It holds all inputs of a run's processes at a tick.
struct TickRecord
{
  SpaceState state;                       // as sent to the processes
  bool save = false;                      // as sent: whether the server asked for saved states
  std::vector<SensorFrame> frames;        // frames of the tick, of all engines in their order; empty at the first tick
  std::vector<ControlCommands> commands;  // commands of all hosts, in their order; empty at the last tick of a run
};

// Returns whether both have the same bits.
bool SameBits(const std::vector<double>& a, const std::vector<double>& b);

// Consecutive ticks. The thread of the ticks fills the object, and allocates nothing once the buffers have grown.
class TickRows
{
public:
  bool Empty() const { return ticks_ == 0; }
  std::uint32_t Ticks() const { return ticks_; }
  std::uint64_t FirstTick() const { return first_tick_; }
  // Returns the size of the future Content without the newest ticks.
  std::size_t Bytes() const { return numbers_.Widths().size() + numbers_.Bytes().size() + rest_.Bytes().size(); }
  // Adds a tick. Returns false and adds nothing if the rows have another length or belong to other hosts.
  bool Add(const SpaceState& state, bool save, std::span<const SensorFrame> frames,
           std::span<const ControlCommands> commands);
  void Clear();
  // Packs the newest ticks, and gives the memory for unpacked ones to `next`. Nothing can be added until Clear.
  void Finish(TickRows& next);
  // Returns the content of a block, in `room`, which is kept for the next block. Nothing can be added until Clear.
  std::span<const char> Content(ReusedMemory& room);

private:
  std::uint64_t first_tick_ = 0;
  std::uint32_t ticks_ = 0;
  std::size_t poses_ = 0;  // in each row
  std::size_t others_ = 0;
  std::size_t hosts_ = 0;  // 0 at the last tick of a run
  RowPacker numbers_;      // packs rows of poses, frames and commands
  ByteWriter rest_;
};

// Reads the content of a block, record by record.
class TickRecordReader
{
public:
  // `ticks`: reads at most these first ticks. Without `with_numbers`, records lack poses, frames and commands, which is
  // faster. Throws std::runtime_error, as Next does, if the content is invalid.
  TickRecordReader(std::span<const char> content, std::uint64_t ticks, bool with_numbers = true);
  // Returns false after the last record.
  bool Next(TickRecord& record);

private:
  std::vector<double> numbers_;  // row after row
  bool with_numbers_;
  std::size_t row_ = 0;
  std::size_t at_ = 0;
  std::size_t poses_ = 0;
  std::uint64_t tick_ = 0;
  std::uint64_t left_ = 0;
  std::vector<char> bytes_;
  ByteReader rest_;
};

// The origin of the journal's run.
struct JournalStart
{
  CheckpointOrigin origin;
  HostTable hosts;
  std::uint64_t first_tick = 0;
};

// Return the contents of the other kinds of blocks.
std::vector<char> ContentOf(const JournalStart& start);
JournalStart ReadStart(std::span<const char> content);
std::vector<char> ContentOf(const SpaceSnapshot& snapshot);
SpaceSnapshot ReadSnapshot(std::span<const char> content);
std::vector<char> ContentOf(const SavedPart& part);
SavedPart ReadPart(std::span<const char> content);
std::vector<char> ContentOf(std::span<const SensorFrame> frames);
std::vector<SensorFrame> ReadFrames(std::span<const char> content);

}  // namespace swarmanoid
