// What a journal keeps of each tick, and how many ticks become the content of one block. Rows of doubles, one a tick,
// are stored number after number, each as its difference, as an integer, from what the ticks before let expect: smooth
// motion becomes small numbers, which compress well.
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

// All that the processes of a run took in at a tick.
struct TickRecord
{
  SpaceState state;                       // as it was sent
  bool save = false;                      // likewise: it asked for saved states
  std::vector<SensorFrame> frames;        // of the tick, of all engines in their order; empty at the first one
  std::vector<ControlCommands> commands;  // of all hosts, in their order; none at the last tick of a run
};

// Whether both are the same to the last bit.
bool SameBits(const std::vector<double>& a, const std::vector<double>& b);

// Some ticks in a row. Filled by the thread of the ticks, which allocates nothing once the buffers have grown.
class TickRows
{
public:
  bool Empty() const { return ticks_ == 0; }
  std::uint32_t Ticks() const { return ticks_; }
  std::uint64_t FirstTick() const { return first_tick_; }
  // Of what Content will be, but for the newest ticks.
  std::size_t Bytes() const { return numbers_.Widths().size() + numbers_.Bytes().size() + rest_.Bytes().size(); }
  // False, and nothing happens, if the rows of the record are not as long as those here, or of other hosts.
  bool Add(const SpaceState& state, bool save, std::span<const SensorFrame> frames,
           std::span<const ControlCommands> commands);
  void Clear();
  // The content of a block, in `room`, which is kept for the next one. Nothing can be added any more until Clear.
  std::span<const char> Content(ReusedMemory& room);

private:
  std::uint64_t first_tick_ = 0;
  std::uint32_t ticks_ = 0;
  std::size_t poses_ = 0;  // in a row
  std::size_t others_ = 0;
  std::size_t hosts_ = 0;  // none at the last tick of a run
  RowPacker numbers_;      // a row: poses, frames, commands
  ByteWriter rest_;
};

// Takes the content of a block apart, record by record.
class TickRecordReader
{
public:
  // `ticks`: not more than these, of the first ones. `with_numbers`: else records lack poses, frames and commands, for
  // who wants to know quickly what else there was.
  // Throws std::runtime_error, as Next does, if the content is none.
  TickRecordReader(std::span<const char> content, std::uint64_t ticks, bool with_numbers = true);
  // False after the last one.
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

// What the journal is of.
struct JournalStart
{
  CheckpointOrigin origin;
  HostTable hosts;
  std::uint64_t first_tick = 0;
};

// The contents of the other kinds of blocks.
std::vector<char> ContentOf(const JournalStart& start);
JournalStart ReadStart(std::span<const char> content);
std::vector<char> ContentOf(const SpaceSnapshot& snapshot);
SpaceSnapshot ReadSnapshot(std::span<const char> content);
std::vector<char> ContentOf(const SavedPart& part);
SavedPart ReadPart(std::span<const char> content);
std::vector<char> ContentOf(std::span<const SensorFrame> frames);
std::vector<SensorFrame> ReadFrames(std::span<const char> content);

}  // namespace swarmanoid
