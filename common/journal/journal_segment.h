// Reads one file of a journal from any offset, also if it is damaged. JournalReader and JournalFollower use it.
#pragma once

#include <cstdint>
#include <vector>

#include "common/configuration/regular_file.h"
#include "common/journal/journal_format.h"

namespace swarmanoid
{

struct SegmentPart
{
  enum class Kind
  {
    kBlock,    // a whole block, whose checksum fits
    kDamaged,  // bytes that are no block, up to the next whole block or the end of the file
    kTorn      // the start of a block that the end of the file cuts short
  };
  Kind kind{};
  std::uint64_t bytes = 0;      // at least 1
  JournalBlockHeader header{};  // for kBlock
  std::vector<char> block{};    // for kBlock: all its bytes
};

// Returns the part that begins at the offset, which is before the end of the file. Throws FileError if the file cannot
// be read.
SegmentPart PartAt(const RegularFile& file, std::uint64_t offset);

}  // namespace swarmanoid
