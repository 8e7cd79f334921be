#include "common/journal/journal_follower.h"

#include <algorithm>
#include <stdexcept>

namespace swarmanoid
{

void JournalFollower::Refresh()
{
  const std::vector<std::uint32_t> segments = SegmentsOf(path_);
  if (segments.empty()) return;
  std::erase_if(places_, [&](const JournalPlace& place) { return place.segment < segments.front(); });
  if (segment_ < segments.front())
  {
    segment_ = segments.front();
    offset_ = 0;
  }
  for (; segment_ <= segments.back(); ++segment_, offset_ = 0)
  {
    // The next one is begun when this one is complete.
    const RegularFile file(SegmentFile(path_, segment_));
    while (ReadBlock(file)) continue;
    if (segment_ == segments.back()) return;
  }
}

bool JournalFollower::ReadBlock(const RegularFile& file)
{
  const std::vector<char> start = file.Read(offset_, kJournalHeaderBytes);
  const auto header = JournalBlockAt(start, file.Size() - std::min(offset_, file.Size()));
  if (!header) return false;
  const JournalPlace place{
      header->kind, header->first_tick, header->ticks, {}, offset_, kJournalHeaderBytes + header->stored_bytes,
      segment_};
  if (places_.empty())
  {
    if (place.kind != JournalBlockKind::kStart) throw std::runtime_error("'" + path_ + "' is no journal");
    start_ = ReadStart(JournalContent(file.Read(offset_, place.bytes)));
  }
  if (place.kind == JournalBlockKind::kGoOn) DropFrom(places_, place.first_tick);
  places_.push_back(place);
  offset_ += place.bytes;
  return true;
}

std::vector<char> JournalFollower::Content(const JournalPlace& place) const
{
  return JournalContent(RegularFile(SegmentFile(path_, place.segment)).Read(place.offset, place.bytes));
}

}  // namespace swarmanoid
