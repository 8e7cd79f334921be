#include "simulation/playback/journal_loss.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "common/errors/print_error.h"
#include "simulation/run_folder.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kMostShown = 8;  // limit for listed ranges of ticks, and for positions of damage

std::string DamageText(const JournalDamage& damage)
{
  if (damage.bytes == 0) return fmt::format("the journal is damaged: its segment '{}' is missing", damage.file);
  return fmt::format("the journal '{}' is damaged at byte {}: {} bytes cannot be read", damage.file, damage.offset,
                     damage.bytes);
}

// Returns the ticks from `first` up to the one before `end` that are in none of the ranges.
std::vector<TickRange> Without(const std::vector<TickRange>& ranges, std::uint64_t first, std::uint64_t end)
{
  std::vector<TickRange> rest;
  for (const TickRange& range : ranges)
  {
    if (range.first > first) rest.push_back({first, std::min(range.first, end)});
    first = std::max(first, range.end);
  }
  if (first < end) rest.push_back({first, end});
  return rest;
}

std::string RangesText(const std::vector<TickRange>& ranges)
{
  std::string text;
  for (std::size_t k = 0; k < std::min(ranges.size(), kMostShown); ++k)
  {
    const auto [first, end] = ranges[k];
    text += k == 0 ? "" : ", ";
    text += end == first + 1 ? fmt::format("{}", first) : fmt::format("{} to {}", first, end - 1);
  }
  if (ranges.size() > kMostShown) text += fmt::format(" and {} more ranges", ranges.size() - kMostShown);
  return text;
}

}  // namespace

RecordedEnd RecordedEndOf(const std::string& run_folder)
{
  RecordedEnd end;
  const std::string path = run_folder + "/manifest.json";
  // Processes that were started by hand keep no manifest.
  if (!std::filesystem::exists(path)) return end;
  try
  {
    const nlohmann::json manifest = ReadManifest(run_folder);
    if (manifest.contains("ticks")) end.last_tick = manifest["ticks"].get<std::uint64_t>();
    for (const auto& word : manifest.at("command"))
      end.has_budget = end.has_budget || word.get<std::string>().starts_with("--journal-budget");
  }
  catch (const std::exception& error)
  {
    end.trouble =
        fmt::format("'{}' is damaged, so that it is not known at which tick the run ended: {}", path, error.what());
  }
  return end;
}

JournalLoss FindLoss(const JournalReader& journal, const RecordedEnd& end)
{
  JournalLoss loss;
  const std::vector<JournalDamage>& damages = journal.Damages();
  for (std::size_t k = 0; k < std::min(damages.size(), kMostShown); ++k) loss.notes.push_back(DamageText(damages[k]));
  if (damages.size() > kMostShown)
    loss.notes.push_back(fmt::format("the journal is damaged at {} more places", damages.size() - kMostShown));
  if (!journal.HasStart())
    loss.notes.push_back("the block that says what run the journal is of, and which controller hosts it had, is lost");
  if (!end.trouble.empty()) loss.notes.push_back(end.trouble);
  const std::uint32_t oldest = journal.Places().front().segment;
  const bool lacks_beginning = oldest != 0 && !end.has_budget && end.trouble.empty();
  if (lacks_beginning)
    loss.notes.push_back(fmt::format("the journal is damaged: its segments before '{}' are missing",
                                     SegmentFile(journal.Path(), oldest)));
  loss.is_damaged = !loss.notes.empty();

  const std::uint64_t written_end = EndTickOf(journal.StartAsFarAsKnown(), journal.Places());
  if (journal.TornBytes() != 0)
    loss.notes.push_back(
        fmt::format("the journal '{}' has a torn end: its last {} bytes, after tick {}, are an unfinished block; the "
                    "run {}",
                    SegmentFile(journal.Path(), journal.NewestSegment()), journal.TornBytes(),
                    written_end == 0 ? 0 : written_end - 1,
                    end.last_tick ? "ended later (manifest.json)" : "was killed while it wrote them, or goes on"));
  loss.is_damaged = loss.is_damaged || (journal.TornBytes() != 0 && end.last_tick);
  if (end.last_tick && written_end > *end.last_tick + 1)
  {
    loss.is_damaged = true;
    loss.notes.push_back(fmt::format("the journal has ticks up to {}, but the run ended at tick {} (manifest.json)",
                                     written_end - 1, *end.last_tick));
  }

  const std::uint64_t first = lacks_beginning ? journal.StartAsFarAsKnown().first_tick : journal.FirstTick();
  const std::uint64_t all_end = std::max(written_end, end.last_tick ? *end.last_tick + 1 : 0);
  const std::vector<TickRange> lost =
      Without(ReadableTicks(journal.StartAsFarAsKnown(), journal.Places()), first, all_end);
  std::uint64_t count = 0;
  for (const TickRange& range : lost) count += range.end - range.first;
  if (count == 0 && loss.is_damaged) loss.notes.emplace_back("no state is lost");
  if (count == 0) return loss;
  loss.is_damaged = true;
  loss.notes.push_back(fmt::format("{} of {} states are lost: ticks {}", count, all_end - first, RangesText(lost)));
  return loss;
}

void PrintLoss(const JournalLoss& loss)
{
  for (const std::string& note : loss.notes)
    PrintError("swarmanoid: {}: {}\n", loss.is_damaged ? "warning" : "note", note);
}

}  // namespace swarmanoid
