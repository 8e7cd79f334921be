// Checkpoints: all that is needed to go on from a tick with the same bits as if nothing had happened. Each role saves a
// part; whoever runs the roles puts them together. The same file serves a run in one process and a cluster; its format
// is in checkpoint_format.h.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/checkpoint/library_builds.h"
#include "common/experiment/experiment.h"
#include "common/messages/tick_messages.h"
#include "common/serialisation/bytes.h"

namespace swarmanoid
{

// What one role remembers. Names are those of the processes of a cluster: "engine 'ground'", "controller host 0".
struct SavedPart
{
  std::string name;
  std::vector<char> state;
};
inline constexpr const char* kServerPart = "space server";

// What a checkpoint was taken from.
struct CheckpointOrigin
{
  std::uint64_t experiment = 0;  // FingerprintOf
  std::vector<LibraryBuild> libraries;
};
CheckpointOrigin OriginOf(const Experiment& experiment);

struct Checkpoint
{
  CheckpointOrigin origin;
  SpaceSnapshot snapshot;
  std::vector<SavedPart> parts;

  // Reads the part of a role with `load`, all of it. Throws std::runtime_error naming a part that is missing, damaged,
  // or of another experiment.
  template <class Load>
  void LoadPart(const std::string& name, const Load& load) const
  {
    ByteReader state(StateOf(name));
    try
    {
      load(state);
      if (!state.AtEnd()) throw std::runtime_error("it is longer than its content");
    }
    catch (const std::exception& error)
    {
      throw std::runtime_error("the checkpoint's part of the " + name + ": " + error.what());
    }
  }
  std::span<const char> StateOf(const std::string& name) const;
};

// Equal for experiments whose runs differ in nothing but their length.
std::uint64_t FingerprintOf(const Experiment& experiment);

std::vector<char> EncodeCheckpoint(const Checkpoint& checkpoint);
// Throws std::runtime_error if the bytes are no checkpoint, of another version of the format, cut short or damaged.
Checkpoint DecodeCheckpoint(std::span<const char> bytes);
// Gives bytes that were changed on purpose the length and checksum that they need to be read; for tests of readers.
void SealCheckpoint(std::vector<char>& bytes);

// The file is complete or absent: it is written beside and renamed. Throws std::runtime_error with the path.
void WriteCheckpoint(const std::string& path, const Checkpoint& checkpoint);

struct RestoreOptions
{
  // Controller hosts of the run that goes on: its robots are shared out among them by where they are (DealRobots).
  unsigned hosts = 1;
  bool any_build = false;  // take what other builds of the libraries saved
};
// Throws std::runtime_error, with the path and the cure, if the file cannot be read, is damaged, is of another
// experiment or of other builds of its libraries.
Checkpoint ReadCheckpoint(const std::string& path, const Experiment& experiment, const RestoreOptions& options);

// "checkpoint-00000500"
std::string CheckpointName(std::uint64_t tick);
// Throws std::invalid_argument, with the cure, if checkpoints cannot be taken every so many ticks.
void CheckCheckpointPeriod(std::uint64_t every, const Experiment& experiment);

}  // namespace swarmanoid
