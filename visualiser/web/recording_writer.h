// RecordingWriter: packs the states of a run into blocks for a page that plays them without a server. page_render uses
// it, and page/src/recording.js reads it. One thread.
//
// The page is one HTML file. Its elements <script type="text/plain"> have bytes that are compressed by gzip, as base64:
//
//   id="swarmanoid-code"        the scripts of the page
//   id="swarmanoid-meshes"      the models of robots
//   class="swarmanoid-block"    states
//   id="swarmanoid-run"         JSON: the messages `world` and `timeline` (docs/web_render.md), `version` 1, `unit_m`
//   of
//                               positions, `firsts`, the first tick of each block, `colours`, the ticks at which the
//                               message `colours` changed and the message, `left_out`, the attributes that are not
//                               recorded, and `notes` for the log
//
// A count is a number of seven bits a byte, the lowest first; all bytes except the last have 128 added. A number is a
// count that means 0, -1, 1, -2, … A block of s states of n movable entities has, one after the other,
//
//   1. the count s, the count of the first tick, and s - 1 counts of the ticks from a state to the next;
//   2. for each entity a byte of flags, and its columns. The flags are 1, 2, 4: x, y, z change; 8: the direction
//   changes;
//      16: it tilts. The columns are x, y, z and the heading (32767 for half a turn, and beyond a full turn if it turns
//      on); if it tilts x, y, z, w of the quaternion times 32767 instead of the heading. A column is its first value as
//      a number, and if it changes s - 1 numbers, the differences of its differences;
//   3. 4 n bytes of colours and flags as in a key (docs/web_render.md). For each further state the count of changed
//   ones,
//      and for each the count from the one before (at first from -1) and 4 bytes;
//   4. for each state a byte: 0 for the lists of the state before, or 1, three counts, and the beams, grips and rings
//   as
//      in a key;
//   5. for each state the count of changed attributes, and for each the count from the one before and the value. Before
//      the first state all are 0. A value is twice its number as a count, or the count 1 and an f32. Attributes are
//      numbered in the order of the entities and of their tables.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "visualiser/web/state_frame.h"

namespace swarmanoid
{

class RecordingWriter
{
public:
  static constexpr double kUnit_m = 1e-5;  // of positions; directions are in 32767ths of half a turn

  // The space must outlive the writer.
  explicit RecordingWriter(const CSwarmanoidSpace& space);

  // Returns the attributes that a page does not show.
  static const std::vector<std::string>& LeftOut();

  // Adds the state of the space. Ticks must ascend.
  void Add();
  // Returns true if the block should be taken before the next state.
  bool IsFull() const { return ticks_.size() >= most_states_; }
  bool IsEmpty() const { return ticks_.empty(); }
  std::uint64_t FirstTick() const { return ticks_.front(); }
  // Returns the states since the last block, before compression, and begins the next one.
  std::string TakeBlock();

private:
  enum Column : std::uint8_t
  {
    kX,
    kY,
    kZ,
    kHeading,
    kQuaternion,  // and the three after it
    kColumns = kQuaternion + 4
  };

  void AddPoses();
  void AddColours(const char* colours);
  void AddLists(std::string_view lists, const FrameHeader& counts);
  void AddAttributes();
  // Writes the columns of an entity in the block.
  void WritePoses(std::size_t slot, std::string& bytes) const;
  bool Varies(Column column, std::size_t slot) const;
  void WriteColumn(Column column, std::size_t slot, bool varies, std::string& bytes) const;
  std::int64_t At(Column column, std::size_t state, std::size_t slot) const;

  const CSwarmanoidSpace& space_;
  FrameWriter frames_;
  std::size_t slots_;                            // movable entities
  std::size_t most_states_;                      // of a block
  std::vector<std::uint32_t> attribute_places_;  // in the space, of each number of the recording

  // These members have the states of the block; columns are indexed by state and slot.
  std::vector<std::uint64_t> ticks_;
  std::array<std::vector<std::int64_t>, kColumns> columns_;
  std::string colours_, lists_, attributes_;
  // The newest state.
  std::vector<std::int64_t> headings_;
  std::vector<char> last_colours_;
  std::string last_lists_;
  std::vector<double> last_attributes_;
  std::uint64_t attribute_revision_ = 0;
};

}  // namespace swarmanoid
