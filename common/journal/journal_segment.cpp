#include "common/journal/journal_segment.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>

namespace swarmanoid
{
namespace
{

constexpr std::uint64_t kReadAtOnce = std::uint64_t{1} << 20U;

std::string BlockBeginning() { return std::string(kJournalMagic) + kJournalVersion; }

// Returns the block at the offset if it is whole.
std::optional<SegmentPart> WholeBlock(const RegularFile& file, std::uint64_t offset)
{
  const std::vector<char> start = file.Read(offset, kJournalHeaderBytes);
  const auto header = JournalBlockAt(start, file.Size() - offset);
  if (!header) return std::nullopt;
  const std::uint64_t bytes = kJournalHeaderBytes + header->stored_bytes;
  std::vector<char> block = file.Read(offset, bytes);
  if (block.size() != bytes || !IsIntact(block)) return std::nullopt;
  return SegmentPart{SegmentPart::Kind::kBlock, bytes, *header, std::move(block)};
}

// Returns the offset of the next whole block after the offset; the end of the file if none follows.
std::uint64_t NextWholeBlock(const RegularFile& file, std::uint64_t offset)
{
  const std::string beginning = BlockBeginning();
  for (std::uint64_t from = offset + 1; from < file.Size(); from += kReadAtOnce)
  {
    // The magic bytes may lie across two pieces.
    const std::vector<char> piece = file.Read(from, kReadAtOnce + beginning.size() - 1);
    const std::string_view text(piece.data(), piece.size());
    for (std::size_t at = text.find(beginning); at != std::string_view::npos; at = text.find(beginning, at + 1))
      if (WholeBlock(file, from + at)) return from + at;
  }
  return file.Size();
}

// Returns whether the last bytes of a file can be an incomplete block of a killed writer. A power failure may leave
// zeros.
bool IsCutShort(const RegularFile& file, std::uint64_t offset)
{
  const std::vector<char> start = file.Read(offset, kJournalHeaderBytes);
  const std::string beginning = BlockBeginning();
  const std::string_view text(start.data(), std::min(start.size(), beginning.size()));
  if (std::all_of(start.begin(), start.end(), [](char byte) { return byte == '\0'; })) return true;
  if (!beginning.starts_with(text)) return false;
  if (start.size() < kJournalHeaderBytes) return true;
  const auto header = JournalBlockAt(start, UINT64_MAX);
  return header && header->stored_bytes > file.Size() - offset - kJournalHeaderBytes;
}

}  // namespace

SegmentPart PartAt(const RegularFile& file, std::uint64_t offset)
{
  if (auto block = WholeBlock(file, offset)) return std::move(*block);
  const std::uint64_t next = NextWholeBlock(file, offset);
  const bool torn = next == file.Size() && IsCutShort(file, offset);
  return {torn ? SegmentPart::Kind::kTorn : SegmentPart::Kind::kDamaged, next - offset};
}

}  // namespace swarmanoid
