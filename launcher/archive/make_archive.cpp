#include "launcher/archive/make_archive.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "common/configuration/configuration_tree.h"
#include "common/configuration/wording.h"
#include "common/configuration/xml_reader.h"
#include "common/configuration/xml_writer.h"
#include "common/errors/print_error.h"
#include "common/experiment/settings.h"
#include "common/program/interrupts.h"
#include "common/program/usage_error.h"
#include "common/run/hash_log.h"
#include "common/space/space.h"
#include "common/space/state_checks.h"
#include "launcher/archive/experiment_files.h"
#include "launcher/archive/picture_export.h"
#include "launcher/archive/tar_file.h"
#include "launcher/supervision/progress_display.h"
#include "launcher/system/scratch_folder.h"
#include "simulation/load.h"
#include "simulation/playback/recorded_run.h"
#include "simulation/run_folder.h"

namespace swarmanoid
{
namespace
{

namespace fs = std::filesystem;

constexpr std::size_t kPortionBytes = std::size_t{1} << 16U;

// A member of the archive before it is written: a text, or the content of a file.
struct Content
{
  std::string text;
  std::string path;  // empty: the text
};
using Contents = std::map<std::string, Content>;

// Calls `use` with the parts of the content, up to `most_bytes`.
template <class Use>
void ForEachPart(const Content& content, std::uint64_t most_bytes, const Use& use)
{
  if (content.path.empty()) return use(std::span<const char>(content.text));
  const RegularFile file(content.path);
  for (std::uint64_t at = 0; at < most_bytes;)
  {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(kPortionBytes, most_bytes - at));
    const std::vector<char> part = file.Read(at, count);
    if (part.empty()) return;
    use(std::span<const char>(part));
    at += part.size();
  }
}

// The folder of a run as its manifest and its experiment describe it.
struct ArchivedRun
{
  std::string folder;
  nlohmann::json manifest;
  std::string text;  // of experiment.xml
  std::unique_ptr<const Experiment> experiment;

  bool HasJournal() const { return fs::exists(JournalFile(folder)); }
  std::string InManifest(const char* name) const { return manifest.value(name, std::string()); }
  // The last state, if the run ended in good order.
  std::optional<TickHash> End() const
  {
    if (!manifest.contains("state_hash")) return std::nullopt;
    return TickHash{manifest.at("ticks").get<std::uint64_t>(), std::stoull(InManifest("state_hash"), nullptr, 16)};
  }
};

ArchivedRun OpenRun(const std::string& run)
{
  std::error_code none;
  ArchivedRun opened;
  opened.folder = fs::canonical(run, none).string();
  if (fs::exists(opened.folder + "/study.sqlite", none))
    throw UsageError(
        fmt::format("archive: '{}' is a study; an archive has one run: run the one in question alone, with the values "
                    "of its row of "
                    "table.csv as --set and --seed, and archive that run",
                    run));
  if (opened.folder.empty() || !fs::is_regular_file(opened.folder + "/manifest.json", none))
    throw UsageError(fmt::format("archive: '{}' is no folder of a run: it has no manifest.json", run));
  opened.manifest = ReadManifest(opened.folder);
  opened.text = ReadTextFile(opened.folder + "/experiment.xml");
  if (fmt::format("{:016x}", TextHash(opened.text)) != opened.InManifest("experiment_hash"))
    throw UsageError(fmt::format(
        "archive: '{}/experiment.xml' was changed after the run: its hash is not that of manifest.json; run it again",
        run));
  LoadOptions options;
  options.check_files = false;
  opened.experiment = LoadOrComplain(opened.folder + "/experiment.xml", options);
  if (!opened.experiment) throw UsageError(fmt::format("archive: the experiment of '{}' cannot be read", run));
  return opened;
}

// Returns what computed the run, as the manifest has it. Throws UsageError if a file has another content since.
std::vector<LibraryBuild> BuildsOf(const ArchivedRun& run)
{
  const std::vector<LibraryBuild> now = LibraryBuildsOf(*run.experiment);
  std::vector<LibraryBuild> then;
  for (const auto& [name, build] : run.manifest.at("libraries").items())
  {
    then.push_back({name, build.get<std::string>()});
    const LibraryBuild& one = then.back();
    if (!NameInText(one).starts_with("the file")) continue;
    const auto found = std::ranges::find(now, one.name, &LibraryBuild::name);
    if (found == now.end() || found->build != one.build)
      throw UsageError(
          fmt::format("archive: the file {} has changed since the run, or is missing; put the old one back, or run "
                      "the experiment again",
                      Quoted(one.name)));
  }
  return then;
}

// Returns the hash log of the run if it is still there, which its end tells.
std::vector<TickHash> HashesOfLog(const ArchivedRun& run)
{
  const std::string path = run.InManifest("hash_log");
  if (path.empty() || !run.End() || !fs::is_regular_file(path)) return {};
  try
  {
    std::vector<TickHash> hashes = ReadHashLog(path);
    if (!hashes.empty() && hashes.back() == *run.End()) return hashes;
  }
  catch (const std::runtime_error&)
  {
    // Another program has written over it.
  }
  return {};
}

std::vector<TickHash> HashesOfJournal(const ArchivedRun& run)
{
  RecordedRun recorded(run.folder);
  PrintLoss(recorded.Loss());
  std::vector<TickHash> hashes;
  WorkProgress progress("reading the journal", recorded.LastTick() + 1 - recorded.FirstTick());
  while (!Interrupted() && recorded.Next())
  {
    hashes.push_back({recorded.Space().GetTick(), recorded.Space().Hash()});
    progress.At(hashes.size());
  }
  return hashes;
}

std::optional<Checkpoint> ReadCheckpointOf(const ArchivedRun& run, const std::string& path)
{
  try
  {
    return ReadCheckpoint(path, *run.experiment, {.hosts = 1, .any_build = true});
  }
  catch (const std::runtime_error&)
  {
    return std::nullopt;
  }
}

TickHash HashOf(const Checkpoint& checkpoint, CSwarmanoidSpace& space)
{
  CheckSnapshot(space, checkpoint.snapshot);
  space.Apply(checkpoint.snapshot);
  return {space.GetTick(), space.Hash()};
}

std::vector<TickHash> HashesOfCheckpoints(const ArchivedRun& run)
{
  std::map<std::uint64_t, std::uint64_t> hashes;
  CSwarmanoidSpace space(*run.experiment);
  for (const fs::directory_entry& entry : fs::directory_iterator(run.folder))
    if (entry.path().filename().string().starts_with("checkpoint-"))
      if (const auto checkpoint = ReadCheckpointOf(run, entry.path()))
      {
        const TickHash found = HashOf(*checkpoint, space);
        hashes[found.tick] = found.hash;
      }
  std::vector<TickHash> all;
  for (const auto& [tick, hash] : hashes) all.push_back({tick, hash});
  return all;
}

// Returns the hashes of as many ticks as the run has: of its log, of its journal, or of its checkpoints and its end.
std::vector<TickHash> HashesOf(const ArchivedRun& run)
{
  std::vector<TickHash> hashes = HashesOfLog(run);
  if (hashes.empty() && run.HasJournal()) hashes = HashesOfJournal(run);
  if (hashes.empty()) hashes = HashesOfCheckpoints(run);
  const auto end = run.End();
  if (Interrupted() || !end) return hashes;
  if (hashes.empty() || hashes.back().tick < end->tick) hashes.push_back(*end);
  if (hashes.back() != *end)
    throw UsageError(
        fmt::format("archive: the journal of '{}' ends with another state than its manifest.json says", run.folder));
  return hashes;
}

// Returns the checkpoint that the run began with; nothing if it began at tick 0.
std::optional<Checkpoint> StartOf(const ArchivedRun& run, const std::vector<TickHash>& hashes)
{
  const std::string path = run.InManifest("restored_from");
  if (path.empty()) return std::nullopt;
  // The file may be another one meanwhile.
  if (auto checkpoint = ReadCheckpointOf(run, path))
  {
    CSwarmanoidSpace space(*run.experiment);
    const TickHash start = HashOf(*checkpoint, space);
    if (const auto same = std::ranges::find(hashes, start.tick, &TickHash::tick);
        start.tick <= hashes.front().tick && (same == hashes.end() || *same == start))
      return checkpoint;
  }
  if (run.HasJournal())
  {
    const JournalReader journal(JournalFile(run.folder));
    if (auto checkpoint = journal.WholeCheckpointAt(journal.FirstTick(), *run.experiment, journal.Hosts()))
      return checkpoint;
  }
  throw UsageError(fmt::format(
      "archive: the run began with the checkpoint '{}', which is missing or another one now; put it back", path));
}

// The experiment with the folder of its files in the archive.
std::string ArchivedExperiment(const ArchivedRun& run, const std::string& folder)
{
  return WriteXml(*WithSetting(ReadXml(run.text, "experiment.xml"), "framework.folder", folder));
}

// Adds the segments of the journal, whose names are numbers.
void AddJournal(const ArchivedRun& run, Contents& contents)
{
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(JournalFile(run.folder)).parent_path()))
    if (const std::string name = entry.path().filename().string();
        name.find_first_not_of("0123456789") == std::string::npos)
      contents["journal/" + name] = {{}, entry.path().string()};
}

// Returns the members, and sets the files of the index that have absolute paths in the experiment.
Contents ContentsOf(const ArchivedRun& run, const ArchiveRequest& request, const std::vector<TickHash>& hashes,
                    ArchiveIndex& index)
{
  const ExperimentFiles files = FilesOf(*run.experiment, request.files);
  const auto inside = [&](const std::string& path)
  { return (fs::path("files") / fs::path(path).lexically_relative(files.root)).lexically_normal().string(); };
  std::string folder = inside(run.experiment->folder);
  if (folder.ends_with("/")) folder.pop_back();

  Contents contents;
  contents["experiment.xml"] = {ArchivedExperiment(run, folder), {}};
  for (const std::string& path : files.paths) contents[inside(path)] = {{}, path};
  for (const std::string& path : files.absolute) index.moved[path] = inside(path);
  // Paths such as ../maps/hills.png lead through the folder of the experiment, so it must exist.
  if (!files.paths.empty() &&
      !std::ranges::any_of(contents, [&](const auto& member) { return member.first.starts_with(folder + "/"); }))
    contents[folder + "/README"] = {"The paths in the experiment start in this folder.\n", {}};
  for (const char* name : {"manifest.json", "events.csv"})
    if (const std::string path = run.folder + "/" + name; fs::is_regular_file(path)) contents[name] = {{}, path};
  std::string lines;
  for (const TickHash& one : hashes) lines += HashLogLine(one);
  contents[kArchivedHashes] = {lines, {}};
  if (const auto start = StartOf(run, hashes))
  {
    const std::vector<char> bytes = EncodeCheckpoint(*start);
    contents[kArchivedStart] = {std::string(bytes.begin(), bytes.end()), {}};
  }
  if (request.journal && !run.HasJournal())
    throw UsageError(fmt::format(
        "--journal: the run '{}' kept no journal; runs as a cluster do, unless they have --no-journal", request.run));
  if (request.page && !run.HasJournal())
    throw UsageError(fmt::format(
        "--page: the run '{}' kept no journal; runs as a cluster do, unless they have --no-journal", request.run));
  // The journal has the failures of controllers, which a run again repeats instead of measuring times.
  if (request.journal || (run.HasJournal() && run.experiment->HasGuards())) AddJournal(run, contents);
  return contents;
}

void FillIndex(const ArchivedRun& run, const std::vector<TickHash>& hashes, const Contents& contents,
               ArchiveIndex& index)
{
  index.experiment = run.experiment->name;
  index.seed = run.experiment->seed;
  index.version = run.InManifest("swarmanoid");
  index.revision = run.InManifest("revision");
  index.builds = BuildsOf(run);
  index.first_tick = hashes.front().tick;
  index.last_tick = hashes.back().tick;
  index.has_ended = run.End().has_value();
  for (const auto& [name, content] : contents)
  {
    ArchiveMember member{name, content.text.size(), {}};
    if (!content.path.empty()) member.bytes = RegularFile(content.path).Size();
    Sha256 digest;
    ForEachPart(content, member.bytes, [&](std::span<const char> part) { digest.Add(part); });
    member.digest = digest.Text();
    index.members.push_back(std::move(member));
  }
}

void WriteMember(TarWriter& tar, const std::string& name, const Content& content, std::uint64_t bytes)
{
  tar.Begin(name, bytes);
  ForEachPart(content, bytes, [&](std::span<const char> part) { tar.Write(part); });
  tar.End();
}

MadeArchive Make(const ArchiveRequest& request)
{
  const ArchivedRun run = OpenRun(request.run);
  const std::vector<TickHash> hashes = HashesOf(run);
  if (Interrupted()) return {};
  if (hashes.empty())
    throw UsageError(fmt::format(
        "archive: the run '{}' has no state to compare: it has not ended, and kept no journal and no checkpoint",
        request.run));
  MadeArchive made;
  Contents contents = ContentsOf(run, request, hashes, made.index);
  const ScratchFolder scratch;
  if (request.page)
  {
    const std::string page = scratch.Path() + "/" + kArchivedPage;
    if (!WritePageOf(run.folder, page)) return {};
    contents[kArchivedPage] = {{}, page};
  }
  FillIndex(run, hashes, contents, made.index);
  made.hashes = hashes.size();
  made.path = request.output.empty() ? fs::path(run.folder).filename().string() + ".tar.gz" : request.output;
  std::uint64_t all = 0, done = 0;
  for (const ArchiveMember& member : made.index.members) all += member.bytes;
  WorkProgress progress("writing", all);
  TarWriter tar("--output", made.path);
  const std::string top = run.experiment->name + "/";
  const std::string index = made.index.Text();
  WriteMember(tar, top + kArchiveIndex, {index, {}}, index.size());
  for (const ArchiveMember& member : made.index.members)
  {
    if (Interrupted()) return {};
    WriteMember(tar, top + member.name, contents.at(member.name), member.bytes);
    progress.At(done += member.bytes);
  }
  made.digest = tar.Close();
  made.bytes = fs::file_size(made.path);
  return made;
}

}  // namespace

MadeArchive MakeArchive(const ArchiveRequest& request)
{
  try
  {
    return Make(request);
  }
  catch (const nlohmann::json::exception& error)
  {
    throw UsageError(fmt::format("archive: '{}/manifest.json' is damaged: {}", request.run, error.what()));
  }
}

}  // namespace swarmanoid
