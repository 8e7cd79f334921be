// A journal may have lost its end, whole segments, or blocks in the middle, and one run may have been continued several
// times in it. Reading goes through all segments in order and makes a list of places of good blocks. Content is read
// from the file when it is asked for. A mark of a continuation, or ticks that come again, drop what the earlier process
// wrote of later ticks (AddPlace).
//
// Invariants: the places ascend in the order of writing, and their ticks do not overlap. A damaged block is in
// damages_, and never in places_.
#include "common/journal/journal_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "common/checkpoint/host_state.h"

namespace swarmanoid
{
namespace
{

// During a run, the controller hosts may change, so they are not compared.
bool IsOfOneRun(const JournalStart& start, JournalStart other)
{
  other.hosts = start.hosts;
  return ContentOf(start) == ContentOf(other);
}

}  // namespace

void AddPlace(std::vector<JournalPlace>& places, JournalPlace place)
{
  const auto drop = [&](std::uint64_t ticks_from)
  {
    std::erase_if(places,
                  [&](const JournalPlace& other)
                  {
                    if (other.kind == JournalBlockKind::kTicks) return other.first_tick >= ticks_from;
                    return other.kind != JournalBlockKind::kStart && other.kind != JournalBlockKind::kGoOn &&
                           other.first_tick > place.first_tick;
                  });
    for (JournalPlace& other : places)
      if (other.kind == JournalBlockKind::kTicks && other.first_tick + other.ticks > ticks_from)
        other.ticks = static_cast<std::uint32_t>(ticks_from - other.first_tick);
  };
  if (place.kind == JournalBlockKind::kGoOn) drop(place.first_tick + 1);
  if (place.kind == JournalBlockKind::kTicks)
  {
    const auto before = std::find_if(places.rbegin(), places.rend(),
                                     [](const JournalPlace& other) { return other.kind == JournalBlockKind::kTicks; });
    if (before != places.rend() && place.first_tick < before->first_tick + before->ticks) drop(place.first_tick);
  }
  places.push_back(std::move(place));
}

std::uint64_t FirstTickOf(const JournalStart& start, const std::vector<JournalPlace>& places)
{
  if (places.empty() || places.front().segment == 0) return start.first_tick;
  const auto ticks = std::find_if(places.begin(), places.end(),
                                  [](const JournalPlace& place) { return place.kind == JournalBlockKind::kTicks; });
  // A segment that begins with new controller hosts may first have a state that is older than its ticks.
  for (const JournalPlace& place : places)
    if (place.kind == JournalBlockKind::kSnapshot && (ticks == places.end() || place.first_tick >= ticks->first_tick))
      return place.first_tick;
  return places.front().first_tick;
}

std::uint64_t EndTickOf(const JournalStart& start, const std::vector<JournalPlace>& places)
{
  for (auto place = places.rbegin(); place != places.rend(); ++place)
    if (place->kind == JournalBlockKind::kTicks) return place->first_tick + place->ticks;
  return FirstTickOf(start, places);
}

std::vector<TickRange> ReadableTicks(const JournalStart& start, const std::vector<JournalPlace>& places)
{
  std::vector<TickRange> ranges;
  std::vector<std::uint64_t> saved;
  for (const JournalPlace& place : places)
  {
    if (place.kind == JournalBlockKind::kSnapshot) saved.push_back(place.first_tick);
    if (place.kind != JournalBlockKind::kTicks) continue;
    if (ranges.empty() || place.first_tick > ranges.back().end) ranges.push_back({place.first_tick, place.first_tick});
    ranges.back().end = std::max(ranges.back().end, place.first_tick + place.ticks);
  }
  std::sort(saved.begin(), saved.end());
  std::vector<TickRange> readable;
  for (TickRange range : ranges)
  {
    if (range.first != start.first_tick)
    {
      // The first tick of the range turns a state that was saved one tick before into its own state.
      const auto state = std::lower_bound(saved.begin(), saved.end(), range.first == 0 ? 0 : range.first - 1);
      if (state == saved.end() || *state >= range.end) continue;
      range.first = std::max(range.first, *state);
    }
    readable.push_back(range);
  }
  return readable;
}

JournalReader::JournalReader(const std::string& path) : path_(path)
{
  try
  {
    ReadAll();
  }
  catch (const FileError& error)
  {
    throw std::runtime_error(fmt::format("the journal '{}' cannot be read: {}", path, error.what()));
  }
}

void JournalReader::ReadAll()
{
  // A run that continues may delete its oldest segments meanwhile. Then the segments are listed again.
  std::vector<std::uint32_t> segments = SegmentsOf(path_);
  for (std::vector<std::uint32_t> again = SegmentsOf(path_); again != segments; again = SegmentsOf(path_))
    segments = std::move(again);
  if (segments.empty()) segments.push_back(0);
  for (std::size_t k = 0; k < segments.size(); ++k)
  {
    for (std::uint32_t missing = k == 0 ? segments[k] : segments[k - 1] + 1; missing < segments[k]; ++missing)
      damages_.push_back({SegmentFile(path_, missing), 0, 0});
    if (!ReadSegment(segments[k], k + 1 == segments.size())) break;
  }
  if (places_.empty())
    throw std::runtime_error(fmt::format("'{}' is no journal, or one of another version of Swarmanoid",
                                         SegmentFile(path_, segments.front())));
  if (!HasStart() && places_.front().kind == JournalBlockKind::kSnapshot)
    start_.first_tick = places_.front().first_tick;
}

bool JournalReader::ReadSegment(std::uint32_t segment, bool is_newest)
{
  const std::string path = SegmentFile(path_, segment);
  files_.emplace_back(segment, std::make_unique<RegularFile>(path));
  const RegularFile& file = *files_.back().second;
  std::uint32_t table = kUnknownTable;
  std::uint64_t whole = 0;  // bytes up to the end of the newest whole block
  for (std::uint64_t offset = 0; offset < file.Size();)
  {
    const SegmentPart part = PartAt(file, offset);
    const std::uint64_t end = offset + part.bytes;
    if (part.kind == SegmentPart::Kind::kTorn && is_newest)
    {
      torn_ = part.bytes;
      break;
    }
    const JournalPlace place{
        part.header.kind, part.header.first_tick, part.header.ticks, {}, offset, part.bytes, segment, table};
    bool good = part.kind == SegmentPart::Kind::kBlock;
    try
    {
      if (good && offset == 0 && part.header.kind == JournalBlockKind::kStart)
      {
        JournalStart start = ReadStart(JournalContent(part.block));
        if (!HasStart()) start_ = start;
        // Another run may have left its segments in this folder.
        if (!IsOfOneRun(start, start_)) return false;
        if (tables_.empty() || start.hosts != tables_.back()) tables_.push_back(std::move(start.hosts));
        table = static_cast<std::uint32_t>(tables_.size() - 1);
        places_.push_back(place);
        places_.back().table = table;
      }
      else if (good)
        good = Take(part, place);
    }
    catch (const std::runtime_error&)
    {
      good = false;
    }
    if (good)
      whole = end;
    else
      damages_.push_back({path, offset, part.bytes});
    offset = end;
  }
  bytes_ += is_newest ? whole : file.Size();
  if (whole == 0 || table == kUnknownTable) return true;
  newest_ = segment;
  newest_bytes_ = whole;
  return true;
}

bool JournalReader::Take(const SegmentPart& part, JournalPlace place)
{
  if (place.kind == JournalBlockKind::kStart) return false;
  if (place.kind == JournalBlockKind::kPart)
  {
    place.name = ReadPart(JournalContent(part.block)).name;
    // The state of a controller host is useless if its robots are unknown.
    if (place.table == kUnknownTable) return true;
  }
  AddPlace(places_, std::move(place));
  return true;
}

const JournalStart& JournalReader::Start() const
{
  if (HasStart()) return start_;
  throw std::runtime_error(
      fmt::format("the journal '{}' is damaged: its first block, which says what run it is of, cannot be read", path_));
}

const HostTable& JournalReader::Hosts() const
{
  Start();
  return tables_.back();
}

std::vector<char> JournalReader::Content(const JournalPlace& place) const
{
  for (const auto& [segment, file] : files_)
    if (segment == place.segment) try
      {
        return JournalContent(file->Read(place.offset, place.bytes));
      }
      catch (const std::runtime_error& error)
      {
        throw std::runtime_error(
            fmt::format("the journal '{}' at byte {}: {}", SegmentFile(path_, segment), place.offset, error.what()));
      }
  throw std::runtime_error(fmt::format("the journal '{}' has no segment {}", path_, place.segment));
}

void JournalReader::ForEachTick(const std::function<void(const TickRecord&)>& use) const
{
  TickRecord record;
  for (const JournalPlace& place : places_)
  {
    if (place.kind != JournalBlockKind::kTicks) continue;
    TickRecordReader records(Content(place), place.ticks);
    while (records.Next(record)) use(record);
  }
}

RecordedFaults JournalReader::FaultsFrom(std::uint64_t tick, std::uint32_t ahead) const
{
  RecordedFaults known;
  ForEachTick(
      [&](const TickRecord& record)
      {
        if (record.state.tick < tick + ahead || record.commands.empty()) return;
        const std::uint64_t step = record.state.tick - ahead;
        known.until = step + 1;
        for (const ControlCommands& commands : record.commands)
          for (std::size_t k = 0; k < commands.faults.robots.size(); ++k)
            known.faults.push_back({step, commands.faults.robots[k], commands.faults.kinds[k]});
      });
  return known;
}

const JournalPlace* JournalReader::PlaceOf(JournalBlockKind kind, std::uint64_t tick, const std::string& name,
                                           std::optional<std::uint32_t> table) const
{
  const auto found = std::find_if(places_.rbegin(), places_.rend(),
                                  [&](const JournalPlace& place) {
                                    return place.kind == kind && place.first_tick == tick && place.name == name &&
                                           (!table || place.table == *table);
                                  });
  return found == places_.rend() ? nullptr : &*found;
}

std::optional<std::uint64_t> JournalReader::RestartTick(const std::function<bool(std::uint64_t)>& usable) const
{
  std::uint64_t end = FirstTick();  // the end of the ticks without a gap
  for (const JournalPlace& place : places_)
    if (place.kind == JournalBlockKind::kTicks && place.first_tick <= end)
      end = std::max(end, place.first_tick + place.ticks);
  std::optional<std::uint64_t> newest;
  for (const JournalPlace& place : places_)
  {
    const std::uint64_t tick = place.first_tick;
    if (place.kind != JournalBlockKind::kSnapshot || tick >= end || (newest && tick < *newest)) continue;
    // At this tick the run starts as before: from its checkpoint.
    if (tick == start_.first_tick) continue;
    if (PlaceOf(JournalBlockKind::kPart, tick, kServerPart) != nullptr && usable(tick)) newest = tick;
  }
  return newest;
}

const JournalPlace* JournalReader::TicksWith(std::uint64_t tick) const
{
  const auto found = std::find_if(places_.begin(), places_.end(),
                                  [tick](const JournalPlace& place)
                                  {
                                    return place.kind == JournalBlockKind::kTicks && tick >= place.first_tick &&
                                           tick - place.first_tick < place.ticks;
                                  });
  return found == places_.end() ? nullptr : &*found;
}

std::optional<TickRecord> JournalReader::RecordOf(std::uint64_t tick) const
{
  const JournalPlace* place = TicksWith(tick);
  if (place == nullptr) return std::nullopt;
  TickRecordReader records(Content(*place), place->ticks);
  TickRecord record;
  while (records.Next(record))
    if (record.state.tick == tick) return record;
  return std::nullopt;
}

const HostTable& JournalReader::HostsAt(std::uint64_t tick) const
{
  const JournalPlace* place = TicksWith(tick);
  if (place == nullptr) throw std::runtime_error(fmt::format("the journal '{}' has no tick {}", path_, tick));
  if (place->table == kUnknownTable)
    throw std::runtime_error(fmt::format(
        "the journal '{}' does not say which controller hosts had the robots at tick {}: it is damaged", path_, tick));
  return tables_[place->table];
}

bool JournalReader::KnowsHostsAt(std::uint64_t tick) const
{
  const JournalPlace* place = TicksWith(tick);
  return place != nullptr && place->table != kUnknownTable;
}

std::optional<Checkpoint> JournalReader::CheckpointAt(std::uint64_t tick, const std::vector<std::string>& parts,
                                                      std::optional<std::uint32_t> table) const
{
  const JournalPlace* snapshot = PlaceOf(JournalBlockKind::kSnapshot, tick, {});
  if (snapshot == nullptr) return std::nullopt;
  Checkpoint checkpoint;
  for (const std::string& name : parts)
  {
    const JournalPlace* part = PlaceOf(JournalBlockKind::kPart, tick, name, table);
    if (part == nullptr) return std::nullopt;
    checkpoint.parts.push_back(ReadPart(Content(*part)));
  }
  checkpoint.origin = start_.origin;
  checkpoint.snapshot = ReadSnapshot(Content(*snapshot));
  return checkpoint;
}

std::optional<Checkpoint> JournalReader::WholeCheckpointAt(std::uint64_t tick, const Experiment& experiment,
                                                           const HostTable& hosts) const
{
  // At a tick at which robots were assigned to other hosts, the old and the new hosts may both have been saved.
  std::set<std::uint32_t> numbers;
  for (const JournalPlace& place : places_)
    if (place.kind == JournalBlockKind::kPart && place.first_tick == tick) numbers.insert(place.table);
  for (const std::uint32_t number : numbers)
  {
    auto checkpoint = CheckpointAt(tick, PartsOf(experiment, tables_[number].hosts), number);
    if (!checkpoint) continue;
    if (tables_[number] != hosts) checkpoint->parts = SharedOut(std::move(checkpoint->parts), experiment, hosts);
    return checkpoint;
  }
  return std::nullopt;
}

std::optional<Checkpoint> JournalReader::WholeCheckpointUntil(std::uint64_t tick, const Experiment& experiment,
                                                              const HostTable& hosts) const
{
  std::set<std::uint64_t, std::greater<>> ticks;
  for (const JournalPlace& place : places_)
    if (place.kind == JournalBlockKind::kSnapshot && place.first_tick <= tick) ticks.insert(place.first_tick);
  for (const std::uint64_t saved : ticks)
    if (auto checkpoint = WholeCheckpointAt(saved, experiment, hosts)) return checkpoint;
  return std::nullopt;
}

bool JournalReader::NewestHostsSavedUntil(std::uint64_t tick, const std::vector<std::string>& parts) const
{
  const auto table = static_cast<std::uint32_t>(tables_.size() - 1);
  return std::ranges::any_of(places_,
                             [&](const JournalPlace& place)
                             {
                               return place.kind == JournalBlockKind::kSnapshot && place.first_tick <= tick &&
                                      std::ranges::all_of(
                                          parts, [&](const std::string& name)
                                          { return PlaceOf(JournalBlockKind::kPart, place.first_tick, name, table); });
                             });
}

bool IsBegun(const std::string& path)
{
  const std::vector<std::uint32_t> segments = SegmentsOf(path);
  std::error_code none;
  return !segments.empty() && std::filesystem::file_size(SegmentFile(path, segments.front()), none) > 0;
}

std::string JournalFile(const std::string& run_folder) { return run_folder + "/journal/0"; }

RecordedFaults FaultsOfRun(const std::string& run_folder, const Experiment& experiment, std::uint64_t tick)
{
  if (!experiment.HasGuards()) return {};
  const JournalReader journal(JournalFile(run_folder));
  if (journal.Start().origin.experiment != FingerprintOf(experiment))
    throw std::runtime_error(fmt::format("'{}' is of another experiment, or of other settings of it", journal.Path()));
  return journal.FaultsFrom(tick, experiment.ahead);
}

}  // namespace swarmanoid
