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

void DropFrom(std::vector<JournalPlace>& places, std::uint64_t tick)
{
  std::erase_if(places,
                [&](const JournalPlace& place)
                {
                  if (place.kind == JournalBlockKind::kTicks) return place.first_tick + place.ticks > tick;
                  const bool saved = place.kind == JournalBlockKind::kSnapshot || place.kind == JournalBlockKind::kPart;
                  return saved && place.first_tick > tick;
                });
}

JournalReader::JournalReader(const std::string& path) : path_(path), file_(path)
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
    if (place.kind == JournalBlockKind::kGoOn) DropFrom(places_, place.first_tick);
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

KnownFaults JournalReader::FaultsFrom(std::uint64_t tick) const
{
  KnownFaults known;
  ForEachTick(
      [&](const TickRecord& record)
      {
        if (record.state.tick < tick || record.commands.empty()) return;
        known.until = record.state.tick + 1;
        for (const ControlCommands& commands : record.commands)
          for (std::size_t k = 0; k < commands.faults.robots.size(); ++k)
            known.faults.push_back({record.state.tick, commands.faults.robots[k], commands.faults.kinds[k]});
      });
  return known;
}

const JournalPlace* JournalReader::PlaceOf(JournalBlockKind kind, std::uint64_t tick, const std::string& name) const
{
  const auto found = std::find_if(places_.begin(), places_.end(),
                                  [&](const JournalPlace& place)
                                  { return place.kind == kind && place.first_tick == tick && place.name == name; });
  return found == places_.end() ? nullptr : &*found;
}

std::optional<std::uint64_t> JournalReader::TickToGoOn(const std::function<bool(std::uint64_t)>& usable) const
{
  std::uint64_t end = start_.first_tick;  // of the ticks of which none is lacking
  for (const JournalPlace& place : places_)
    if (place.kind == JournalBlockKind::kTicks && place.first_tick == end) end += place.ticks;
  std::optional<std::uint64_t> newest;
  for (const JournalPlace& place : places_)
  {
    const std::uint64_t tick = place.first_tick;
    if (place.kind != JournalBlockKind::kSnapshot || tick >= end || (newest && tick < *newest)) continue;
    if (PlaceOf(JournalBlockKind::kPart, tick, kServerPart) != nullptr && usable(tick)) newest = tick;
  }
  return newest;
}

std::optional<TickRecord> JournalReader::RecordOf(std::uint64_t tick) const
{
  for (const JournalPlace& place : places_)
  {
    if (place.kind != JournalBlockKind::kTicks || tick < place.first_tick || tick - place.first_tick >= place.ticks)
      continue;
    TickRecordReader records(Content(place));
    TickRecord record;
    while (records.Next(record))
      if (record.state.tick == tick) return record;
  }
  return std::nullopt;
}

std::optional<Checkpoint> JournalReader::CheckpointAt(std::uint64_t tick, const std::vector<std::string>& parts) const
{
  const JournalPlace* snapshot = PlaceOf(JournalBlockKind::kSnapshot, tick, {});
  if (snapshot == nullptr) return std::nullopt;
  Checkpoint checkpoint;
  for (const std::string& name : parts)
  {
    const JournalPlace* part = PlaceOf(JournalBlockKind::kPart, tick, name);
    if (part == nullptr) return std::nullopt;
    checkpoint.parts.push_back(ReadPart(Content(*part)));
  }
  checkpoint.origin = start_.origin;
  checkpoint.snapshot = ReadSnapshot(Content(*snapshot));
  return checkpoint;
}

std::optional<Checkpoint> JournalReader::NewestCheckpoint(const std::vector<std::string>& parts) const
{
  for (auto snapshot = places_.rbegin(); snapshot != places_.rend(); ++snapshot)
  {
    if (snapshot->kind != JournalBlockKind::kSnapshot) continue;
    if (auto checkpoint = CheckpointAt(snapshot->first_tick, parts)) return checkpoint;
  }
  return std::nullopt;
}

std::string JournalFile(const std::string& run_folder) { return run_folder + "/journal/0"; }

KnownFaults FaultsOfRun(const std::string& run_folder, const Experiment& experiment, std::uint64_t tick)
{
  if (!experiment.HasGuards()) return {};
  const JournalReader journal(JournalFile(run_folder));
  if (journal.Start().origin.experiment != FingerprintOf(experiment))
    throw std::runtime_error(fmt::format("'{}' is of another experiment, or of other settings of it", journal.Path()));
  return journal.FaultsFrom(tick);
}

}  // namespace swarmanoid
