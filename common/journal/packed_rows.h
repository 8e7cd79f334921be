// Packs the numbers of consecutive ticks. From the bits of each number it subtracts the bits expected from the ticks
// before. Eight ticks of one number are stored in as many bytes as the largest difference needs. Integer differences of
// doubles are from M. Burtscher and P. Ratanaworabhan, "FPC: A High-Speed Compressor for Double-Precision
// Floating-Point Data", IEEE Transactions on Computers 58(1), 2009.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "common/serialisation/reused_memory.h"

namespace swarmanoid
{

// Returns the number of ticks that are packed together. Rows so long that eight of them would take much memory give
// fewer ticks.
std::size_t TicksTogether(std::size_t row);

class RowPacker
{
public:
  // Starts rows of `row` numbers. The first `moving` numbers of a row are expected to change as between the two rows
  // before; the others are expected to stay. Packed rows are dropped; their memory is kept.
  void Begin(std::size_t row, std::size_t moving);
  // NextRow returns the memory for the numbers of the next row. The second call states that they are written.
  double* NextRow() { return Row(kBefore + waiting_); }
  void Added();
  // Packs the rows that still wait for others. No rows can be added afterwards.
  void Finish();
  // Takes over the memory for rows that are not packed yet from a packer that has finished, since it takes more than
  // packed rows.
  void TakeMemoryOf(RowPacker& finished) { std::swap(recent_, finished.recent_); }

  // Returns the bytes of each number (0 to 8), one column of TicksTogether ticks after the other.
  std::span<const char> Widths() const { return widths_; }
  // Returns the packed numbers in the same order, each with its ticks, little-endian.
  std::span<const char> Bytes() const { return {room_.Bytes(), used_}; }

  static constexpr std::size_t kBefore = 2;  // earlier rows that give the expectation

private:
  void Pack();
  // Returns one of the rows in memory, from the oldest on.
  double* Row(std::size_t place)
  {
    return reinterpret_cast<double*>(recent_.Bytes()) + (oldest_ + place) % (kBefore + together_) * row_;
  }

  std::size_t row_ = 0;
  std::size_t moving_ = 0;
  std::size_t together_ = 1;
  std::size_t packed_ = 0;   // rows
  std::size_t waiting_ = 0;  // rows
  ReusedMemory recent_;      // doubles: the last packed rows and the waiting ones, around a circle
  std::size_t oldest_ = 0;   // the place of the oldest of these rows in the memory
  std::vector<char> widths_;
  ReusedMemory room_;
  std::size_t used_ = 0;  // used bytes of the memory
};

// Returns the numbers bit by bit, row after row. Throws std::runtime_error if the packed bytes are not `ticks` such
// rows.
std::vector<double> UnpackRows(std::span<const char> widths, std::span<const char> bytes, std::size_t ticks,
                               std::size_t row, std::size_t moving);

}  // namespace swarmanoid
