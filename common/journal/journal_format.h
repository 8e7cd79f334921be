// The blocks of a journal: what stands in its files, and what a process that takes the place of another one is sent. A
// journal is one file, or several, its segments, of which the oldest may have been deleted. Each is one block after
// another, each whole by itself:
//
//   "SWARMJB" and the version of the format (one character)
//   kind (u32), ticks in it (u32), first tick (u64)
//   bytes of the content (u64) and of its compressed form (u64)
//   XXH3, 64 bits, of all of the block but these eight bytes (u64)
//   the content, compressed by zstd
//
// Numbers are little-endian. The first block of each segment is of kind kStart; its first tick is that of the segment.
// All commands and states of controller hosts in a segment are of those that this block says, each with its robots.
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
// Another one for each change of the blocks, or of what they mean.
inline constexpr char kJournalVersion = '9';
inline constexpr std::size_t kJournalHeaderBytes = 48;

enum class JournalBlockKind : std::uint32_t
{
  kStart = 1,     // of a run: JournalStart
  kTicks = 2,     // TickRecords
  kSnapshot = 3,  // the space at a tick: SpaceSnapshot
  kPart = 4,      // what one process remembers before it steps at a tick: SavedPart
  kFrames = 5,    // the sensor frames of a tick that is not done yet; in recoveries alone
  kGoOn = 6,      // the run goes on at first_tick: what stands before it of later ticks does not count
};

struct JournalBlockHeader
{
  JournalBlockKind kind{};
  std::uint32_t ticks = 0;
  std::uint64_t first_tick = 0;
  std::uint64_t content_bytes = 0;
  std::uint64_t stored_bytes = 0;
};

// A whole block, which stays until the next call in this thread. Throws std::runtime_error if the content cannot be
// compressed.
std::span<const char> EncodeJournalBlock(JournalBlockKind kind, std::uint64_t first_tick, std::uint32_t ticks,
                                         std::span<const char> content);
// The header at the start of the bytes; nothing if there is none of this version, or the block is longer than what is
// left of its file.
std::optional<JournalBlockHeader> JournalBlockAt(std::span<const char> bytes, std::uint64_t left);
// Whether the bytes are one whole block, with the checksum that it was written with.
bool IsIntact(std::span<const char> block);
// The content of a whole block. Throws std::runtime_error if it is damaged.
std::vector<char> JournalContent(std::span<const char> block);

}  // namespace swarmanoid
