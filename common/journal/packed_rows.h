// The numbers of some ticks in a row, in little room: the bits of each number less those that are to be expected from
// the ticks before, of which eight ticks of one number at a time are stored in as many bytes as the largest one needs.
// Integer differences of doubles, as in M. Burtscher and P. Ratanaworabhan, "FPC: A High-Speed Compressor for
// Double-Precision Floating-Point Data", IEEE Transactions on Computers 58(1), 2009.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "common/serialisation/reused_memory.h"

namespace swarmanoid
{

// Ticks that are packed together: fewer where a row is so long that eight of them would take much memory.
std::size_t TicksTogether(std::size_t row);

class RowPacker
{
public:
  // Of rows of `row` numbers. The first `moving` numbers of a row are expected to go on as between the two rows before,
  // the others to stay. What was packed is gone; its room is kept.
  void Begin(std::size_t row, std::size_t moving);
  // Where the numbers of the next row are to be put, and then, that they are there.
  double* NextRow() { return Row(kBefore + waiting_); }
  void Added();
  // Packs the rows that still wait for others; none can be added any more.
  void Finish();

  // Bytes of a number (0 to 8), a column of TicksTogether ticks after the other.
  std::span<const char> Widths() const { return widths_; }
  // In the same order, of each number its ticks, little-endian.
  std::span<const char> Bytes() const { return {room_.Bytes(), used_}; }

private:
  static constexpr std::size_t kBefore = 2;  // rows that tell what to expect

  void Pack();
  double* Row(std::size_t place) { return reinterpret_cast<double*>(recent_.Bytes()) + place * row_; }

  std::size_t row_ = 0;
  std::size_t moving_ = 0;
  std::size_t together_ = 1;
  std::size_t packed_ = 0;   // rows
  std::size_t waiting_ = 0;  // rows
  ReusedMemory recent_;      // doubles: the last rows that were packed, then those that wait
  std::vector<char> widths_;
  ReusedMemory room_;
  std::size_t used_ = 0;  // of the room
};

// The same numbers, bit by bit, row after row. Throws std::runtime_error if the packed ones are not of `ticks` such
// rows.
std::vector<double> UnpackRows(std::span<const char> widths, std::span<const char> bytes, std::size_t ticks,
                               std::size_t row, std::size_t moving);

}  // namespace swarmanoid
