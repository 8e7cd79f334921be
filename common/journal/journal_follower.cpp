#include "common/journal/journal_follower.h"

#include <stdexcept>

#include "common/journal/journal_segment.h"

namespace swarmanoid
{

void JournalFollower::Refresh()
{
  const std::vector<std::uint32_t> segments = SegmentsOf(path_);
  if (segments.empty()) return;
  std::erase_if(places_, [&](const JournalPlace& place) { return place.segment < segments.front(); });
  for (const std::uint32_t segment : segments)
  {
    if (segment < segment_) continue;
    if (segment > segment_) offset_ = 0;
    segment_ = segment;
    const RegularFile file(SegmentFile(path_, segment_));
    while (offset_ < file.Size() && ReadBlock(file)) continue;
  }
}

bool JournalFollower::ReadBlock(const RegularFile& file)
{
  const SegmentPart part = PartAt(file, offset_);
  const std::uint64_t end = offset_ + part.bytes;
  if (part.kind == SegmentPart::Kind::kDamaged && end < file.Size())
  {
    offset_ = end;
    return true;
  }
  if (part.kind != SegmentPart::Kind::kBlock) return false;
  const JournalPlace place{part.header.kind, part.header.first_tick, part.header.ticks, {}, offset_, part.bytes,
                           segment_};
  if (!has_start_ && place.kind != JournalBlockKind::kStart)
    throw std::runtime_error("the journal '" + path_ + "' is damaged: its first block cannot be read");
  if (!has_start_) start_ = ReadStart(JournalContent(part.block));
  has_start_ = true;
  AddPlace(places_, place);
  offset_ = end;
  return true;
}

std::vector<char> JournalFollower::Content(const JournalPlace& place) const
{
  const std::string path = SegmentFile(path_, place.segment);
  try
  {
    return JournalContent(RegularFile(path).Read(place.offset, place.bytes));
  }
  catch (const std::runtime_error& error)
  {
    throw std::runtime_error("the journal '" + path + "' at byte " + std::to_string(place.offset) + ": " +
                             error.what());
  }
}

}  // namespace swarmanoid
