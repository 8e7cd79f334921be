#include "common/space/checkpoint.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace swarmanoid
{
namespace
{

constexpr std::array<char, 8> kMagic{'S', 'W', 'A', 'R', 'M', 'C', 'P', '1'};

}  // namespace

std::span<const char> Checkpoint::StateOf(const std::string& name) const
{
  for (const SavedPart& part : parts)
    if (part.name == name) return part.state;
  throw std::runtime_error("the checkpoint has no part of the " + name);
}

std::uint64_t FingerprintOf(const Experiment& experiment)
{
  // A restored run may be longer than the one that it goes on from.
  std::string text = experiment.effective_xml;
  const std::string_view open = "<maxclock>";
  const std::size_t start = text.find(open);
  const std::size_t end = text.find("</maxclock>", start);
  if (start != std::string::npos && end != std::string::npos)
    text.erase(start + open.size(), end - start - open.size());
  return XXH3_64bits(text.data(), text.size());
}

std::vector<char> EncodeCheckpoint(const Checkpoint& checkpoint)
{
  ByteWriter bytes;
  bytes.Put(kMagic);
  bytes.Put(checkpoint.experiment);
  bytes.Put(checkpoint.snapshot.tick);
  bytes.PutArray(checkpoint.snapshot.poses);
  bytes.PutArray(checkpoint.snapshot.attributes);
  bytes.Put(static_cast<std::uint64_t>(checkpoint.parts.size()));
  for (const SavedPart& part : checkpoint.parts)
  {
    bytes.PutText(part.name);
    bytes.PutArray(part.state);
  }
  return bytes.Bytes();
}

Checkpoint DecodeCheckpoint(std::span<const char> bytes)
{
  ByteReader reader(bytes);
  if (bytes.size() < kMagic.size() || reader.Get<std::array<char, 8>>() != kMagic)
    throw std::runtime_error("it is not a checkpoint");
  Checkpoint checkpoint;
  checkpoint.experiment = reader.Get<std::uint64_t>();
  checkpoint.snapshot.tick = reader.Get<std::uint64_t>();
  checkpoint.snapshot.poses = reader.GetArray<double>();
  checkpoint.snapshot.attributes = reader.GetArray<double>();
  for (auto count = reader.Get<std::uint64_t>(); count > 0; --count)
  {
    SavedPart& part = checkpoint.parts.emplace_back();
    part.name = reader.GetText();
    part.state = reader.GetArray<char>();
  }
  if (!reader.AtEnd()) throw std::runtime_error("it is longer than its content");
  return checkpoint;
}

void WriteCheckpoint(const std::string& path, const Checkpoint& checkpoint)
{
  const std::vector<char> bytes = EncodeCheckpoint(checkpoint);
  const std::string unfinished = path + ".part";
  std::ofstream file(unfinished, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file)
  {
    const int error = errno;
    std::error_code ignored;
    std::filesystem::remove(unfinished, ignored);
    throw std::runtime_error("cannot write the checkpoint '" + path + "': " + std::strerror(error));
  }
  std::filesystem::rename(unfinished, path);
}

Checkpoint ReadCheckpoint(const std::string& path, const Experiment& experiment, std::size_t hosts)
{
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read the checkpoint '" + path + "': " + std::strerror(errno));
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  try
  {
    Checkpoint checkpoint = DecodeCheckpoint(bytes);
    if (checkpoint.experiment != FingerprintOf(experiment))
      throw std::runtime_error(
          "it is of another experiment, or of other settings or another seed; restore it with the experiment.xml "
          "beside it");
    const std::size_t parts = checkpoint.parts.size();
    const std::size_t others = 1 + experiment.engines.size();
    if (parts != others + hosts)
      throw std::runtime_error("it was taken with --controller-hosts " +
                               std::to_string(parts > others ? parts - others : 0) + "; restore it with as many");
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
