// The blocks of a journal: the content of its files, and the input of a replacement process. A journal is one file or
// several files, its segments; the oldest segments may have been deleted. Each file is a sequence of self-contained
// blocks:
//
//   "SWARMJB" and the version of the format (one character)
//   kind (u32), ticks in it (u32), first tick (u64)
//   bytes of the content (u64) and of its compressed form (u64)
//   XXH3, 64 bits, of all of the block but these eight bytes (u64)
//   the content, compressed by zstd
//
// Numbers are little-endian. The first block of each segment is of kind kStart; its first tick is that of the segment.
// It names the controller hosts, with their robots, to which all commands and host states of the segment belong.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace swarmanoid
{

inline constexpr std::string_view kJournalMagic = "SWARMJB";
// Change the version with each change of the blocks or of their meaning.
inline constexpr char kJournalVersion = '9';
inline constexpr std::size_t kJournalHeaderBytes = 48;

enum class JournalBlockKind : std::uint32_t
{
  kStart = 1,     // the start of a run: JournalStart
  kTicks = 2,     // TickRecords
  kSnapshot = 3,  // the space at a tick: SpaceSnapshot
  kPart = 4,      // the state of one process before it steps at a tick: SavedPart
  kFrames = 5,    // the sensor frames of an unfinished tick; only in recoveries
  kGoOn = 6,      // the run continues at first_tick: earlier blocks with later ticks are void
};

struct JournalBlockHeader
{
  JournalBlockKind kind{};
  std::uint32_t ticks = 0;
  std::uint64_t first_tick = 0;
  std::uint64_t content_bytes = 0;
  std::uint64_t stored_bytes = 0;
};

// Returns a whole block, which stays valid until the next call in this thread. Throws std::runtime_error if the content
// cannot be compressed.
std::span<const char> EncodeJournalBlock(JournalBlockKind kind, std::uint64_t first_tick, std::uint32_t ticks,
                                         std::span<const char> content);
// Returns the header at the start of the bytes. Returns nothing if the version differs, or if the block is longer than
// the rest of its file.
std::optional<JournalBlockHeader> JournalBlockAt(std::span<const char> bytes, std::uint64_t left);
// Returns whether the bytes are one whole block with the right checksum.
bool IsIntact(std::span<const char> block);
// Returns the content of a whole block. Throws std::runtime_error if it is damaged.
std::vector<char> JournalContent(std::span<const char> block);

}  // namespace swarmanoid
