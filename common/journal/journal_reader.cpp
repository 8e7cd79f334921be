#include "common/journal/journal_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace swarmanoid
{
namespace
{

// The block at that place of the file, if it is whole.
std::vector<char> BlockAt(const RegularFile& file, std::uint64_t offset)
{
  std::vector<char> block = file.Read(offset, kJournalHeaderBytes);
  const auto header = JournalBlockAt(block, file.Size() - std::min(offset, file.Size()));
  if (!header) return {};
  return file.Read(offset, kJournalHeaderBytes + header->stored_bytes);
}

}  // namespace

JournalReader::JournalReader(const std::string& path) : file_(path)
{
  std::uint64_t offset = 0;
  while (offset < file_.Size())
  {
    const std::vector<char> block = BlockAt(file_, offset);
    const auto header = JournalBlockAt(block, block.size());
    if (!header) break;
    JournalPlace place{header->kind, header->first_tick, header->ticks, {}, offset, block.size()};
    try
    {
      const std::vector<char> content = JournalContent(block);
      if (place.kind == JournalBlockKind::kPart) place.name = ReadPart(content).name;
      if (offset == 0) start_ = ReadStart(content);
    }
    catch (const std::runtime_error&)
    {
      break;
    }
    places_.push_back(std::move(place));
    offset += block.size();
  }
  torn_ = file_.Size() - offset;
  if (places_.empty() || places_.front().kind != JournalBlockKind::kStart)
    throw std::runtime_error(fmt::format("'{}' is no journal, or one of another version of Swarmanoid", path));
}

std::vector<char> JournalReader::Content(const JournalPlace& place) const
{
  return JournalContent(file_.Read(place.offset, place.bytes));
}

void JournalReader::ForEachTick(const std::function<void(const TickRecord&)>& use) const
{
  TickRecord record;
  for (const JournalPlace& place : places_)
  {
    if (place.kind != JournalBlockKind::kTicks) continue;
    TickRecordReader records(Content(place));
    while (records.Next(record)) use(record);
  }
}

std::optional<Checkpoint> JournalReader::NewestCheckpoint(const std::vector<std::string>& parts) const
{
  for (auto snapshot = places_.rbegin(); snapshot != places_.rend(); ++snapshot)
  {
    if (snapshot->kind != JournalBlockKind::kSnapshot) continue;
    Checkpoint checkpoint;
    for (const std::string& name : parts)
    {
      const auto part = std::find_if(places_.begin(), places_.end(),
                                     [&](const JournalPlace& place) {
                                       return place.kind == JournalBlockKind::kPart && place.name == name &&
                                              place.first_tick == snapshot->first_tick;
                                     });
      if (part != places_.end()) checkpoint.parts.push_back(ReadPart(Content(*part)));
    }
    if (checkpoint.parts.size() != parts.size()) continue;
    checkpoint.origin = start_.origin;
    checkpoint.snapshot = ReadSnapshot(Content(*snapshot));
    return checkpoint;
  }
  return std::nullopt;
}

std::string JournalFile(const std::string& run_folder) { return run_folder + "/journal/0"; }

}  // namespace swarmanoid
