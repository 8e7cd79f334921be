#include "common/checkpoint/checkpoint.h"

#include <fmt/format.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include "common/checkpoint/checkpoint_format.h"
#include "common/checkpoint/host_state.h"
#include "common/configuration/output_file.h"
#include "common/configuration/regular_file.h"
#include "common/configuration/wording.h"
#include "common/serialisation/fields.h"

namespace swarmanoid
{
namespace
{

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 36U;  // 64 GiB

std::uint64_t NumberAt(std::span<const char> bytes, std::size_t at)
{
  std::uint64_t number;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

std::uint64_t ChecksumOf(std::span<const char> bytes)
{
  return XXH3_64bits(bytes.data(), bytes.size() - kCheckpointChecksumBytes);
}

// Checks the header. `start`: the first bytes of the file, or the whole file if it is shorter than a header.
void CheckHeader(std::span<const char> start, std::uint64_t file_bytes)
{
  if (std::string_view(start.data(), std::min(start.size(), kCheckpointMagic.size())) != kCheckpointMagic)
    throw std::runtime_error("it is not a checkpoint");
  if (start.size() > kCheckpointMagic.size() && start[kCheckpointMagic.size()] != kCheckpointVersion)
    throw std::runtime_error(fmt::format(
        "its format has the version {}, this program reads {}; go on with the Swarmanoid that took it, or "
        "take it again",
        Quoted(std::string(1, start[kCheckpointMagic.size()])), Quoted(std::string(1, kCheckpointVersion))));
  if (start.size() < kCheckpointHeaderBytes || file_bytes < kCheckpointHeaderBytes + kCheckpointChecksumBytes)
    throw std::runtime_error(fmt::format("it is cut short: it has {} bytes", file_bytes));
  const std::uint64_t said = NumberAt(start, kCheckpointMagic.size() + 1);
  if (said != file_bytes)
    throw std::runtime_error(
        fmt::format("it is damaged: it should have {} bytes and has {}; go on from another one", said, file_bytes));
}

std::vector<char> ReadWhole(const std::string& path)
{
  const RegularFile file(path);
  // The header is checked before the rest of the file is read.
  CheckHeader(file.Read(0, kCheckpointHeaderBytes), file.Size());
  if (file.Size() > kMostBytes) throw FileError(fmt::format("it is longer than {} bytes", kMostBytes));
  return file.Read(0, file.Size());
}

enum class EndTag : std::uint8_t
{
  kStays,
  kGoes  // with the space before the element
};

// Erases the first element of this name from a text of XML, with its content.
void EraseElement(std::string& text, const std::string& name, EndTag end_tag)
{
  std::size_t start = text.find("<" + name + ">");
  std::string end_of = "</" + name + ">";
  if (start == std::string::npos) start = text.find(end_of = "<" + name + "/>");
  std::size_t end = text.find(end_of, start);
  if (start == std::string::npos || end == std::string::npos) return;
  if (end_tag == EndTag::kGoes)
  {
    end += end_of.size();
    start = text.find_last_not_of(" \n", start - 1) + 1;
  }
  text.erase(start, end - start);
}

}  // namespace

std::span<const char> Checkpoint::StateOf(const std::string& name) const
{
  for (const SavedPart& part : parts)
    if (part.name == name) return part.state;
  throw std::runtime_error("the checkpoint has no part of the " + name);
}

std::uint64_t FingerprintOf(const Experiment& experiment)
{
  // A restored run may be longer than the original run and be shown in another way, and its files may have been moved.
  // CheckpointOrigin::libraries has their contents. Two end tags stay, as in the files of earlier versions.
  std::string text = experiment.effective_xml;
  EraseElement(text, "maxclock", EndTag::kStays);
  EraseElement(text, "folder", EndTag::kStays);
  EraseElement(text, "visualisations", EndTag::kGoes);
  return XXH3_64bits(text.data(), text.size());
}

CheckpointOrigin OriginOf(const Experiment& experiment)
{
  return {FingerprintOf(experiment), LibraryBuildsOf(experiment)};
}

std::vector<char> EncodeCheckpoint(const Checkpoint& checkpoint)
{
  ByteWriter writer;
  for (const char c : kCheckpointMagic) writer.Put(c);
  writer.Put(kCheckpointVersion);
  writer.Put(std::uint64_t{0});
  FieldWriter fields(writer);
  ForEachCheckpointField(fields, checkpoint);
  writer.Put(std::uint64_t{0});
  std::vector<char> bytes = writer.Bytes();
  SealCheckpoint(bytes);
  return bytes;
}

void SealCheckpoint(std::vector<char>& bytes)
{
  bytes.resize(std::max(bytes.size(), kCheckpointHeaderBytes + kCheckpointChecksumBytes));
  const std::uint64_t size = bytes.size();
  std::memcpy(bytes.data() + kCheckpointMagic.size() + 1, &size, sizeof size);
  const std::uint64_t checksum = ChecksumOf(bytes);
  std::memcpy(bytes.data() + bytes.size() - sizeof checksum, &checksum, sizeof checksum);
}

Checkpoint DecodeCheckpoint(std::span<const char> bytes)
{
  CheckHeader(bytes.first(std::min(bytes.size(), kCheckpointHeaderBytes)), bytes.size());
  const std::size_t end = bytes.size() - kCheckpointChecksumBytes;
  if (NumberAt(bytes, end) != ChecksumOf(bytes))
    throw std::runtime_error("it is damaged: its checksum is not that of its content; go on from another one");
  ByteReader content(bytes.subspan(kCheckpointHeaderBytes, end - kCheckpointHeaderBytes));
  FieldReader fields(content);
  Checkpoint checkpoint;
  ForEachCheckpointField(fields, checkpoint);
  if (!content.AtEnd()) throw std::runtime_error("it is longer than its content");
  return checkpoint;
}

void WriteCheckpoint(const std::string& path, const Checkpoint& checkpoint)
{
  const std::vector<char> bytes = EncodeCheckpoint(checkpoint);
  const std::string unfinished = path + ".part";
  std::FILE* const file = OpenOutputFile(unfinished);
  bool good = file != nullptr && std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  int error = errno;
  if (file != nullptr && std::fclose(file) != 0) good = false, error = errno;
  if (!good)
  {
    std::error_code ignored;
    std::filesystem::remove(unfinished, ignored);
    throw std::runtime_error("cannot write the checkpoint '" + path + "': " + std::strerror(error));
  }
  std::filesystem::rename(unfinished, path);
}

Checkpoint ReadCheckpoint(const std::string& path, const Experiment& experiment, const RestoreOptions& options)
{
  try
  {
    Checkpoint checkpoint = DecodeCheckpoint(ReadWhole(path));
    if (checkpoint.origin.experiment != FingerprintOf(experiment))
      throw std::runtime_error(
          "it is of another experiment, or of other settings or another seed; restore it with the experiment.xml "
          "beside it");
    if (!options.any_build)
    {
      const std::string difference = DifferenceOfBuilds(checkpoint.origin.libraries, LibraryBuildsOf(experiment));
      if (!difference.empty())
        throw std::runtime_error("it was taken with " + difference +
                                 "; go on with that one, start again with this one, or let --any-build take it, which "
                                 "promises no equal bits");
    }
    checkpoint.parts = SharedOut(std::move(checkpoint.parts), experiment,
                                 DealRobots(experiment, options.hosts, checkpoint.snapshot.poses));
    return checkpoint;
  }
  catch (const std::exception& error)
  {
    throw std::runtime_error("checkpoint '" + path + "': " + error.what());
  }
}

std::string CheckpointName(std::uint64_t tick)
{
  std::array<char, 40> name;
  std::snprintf(name.data(), name.size(), "checkpoint-%08llu", static_cast<unsigned long long>(tick));
  return name.data();
}

void CheckCheckpointPeriod(std::uint64_t every, const Experiment& experiment)
{
  if (every % experiment.canonical_period == 0) return;
  const std::uint64_t period = experiment.canonical_period;
  throw std::invalid_argument("checkpoints every " + std::to_string(every) +
                              " ticks are not possible: the engines can " + "be saved every " + std::to_string(period) +
                              " ticks (framework.canonical_period); take " +
                              std::to_string((every / period + 1) * period) + " or change that");
}

}  // namespace swarmanoid
