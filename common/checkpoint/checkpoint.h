// Checkpoints: the state that is needed to continue from a tick with the same bits as the uninterrupted run. Each role
// saves its part, and the process that runs the roles joins the parts. A run in one process and a cluster use the same
// file; checkpoint_format.h has its format.
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

// It has the saved state of one role. Names are those of the processes of a cluster: "engine 'ground'", "controller
// host 0".
struct SavedPart
{
  std::string name;
  std::vector<char> state;
};
inline constexpr const char* kServerPart = "space server";

// The run that a checkpoint was taken from.
struct CheckpointOrigin
{
  std::uint64_t experiment = 0;  // FingerprintOf
  std::vector<LibraryBuild> libraries;
};
// Returns the origin of checkpoints that this process would take of the experiment.
CheckpointOrigin OriginOf(const Experiment& experiment);

struct Checkpoint
{
  CheckpointOrigin origin;
  SpaceSnapshot snapshot;
  std::vector<SavedPart> parts;

  // Reads the whole part of a role with `load`. Throws std::runtime_error naming a part that is missing, damaged, or of
  // another experiment.
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
  // Returns the state of a part. Throws std::runtime_error if the checkpoint does not have it.
  std::span<const char> StateOf(const std::string& name) const;
};

// Returns equal numbers for experiments that differ only in the length of the run and in the folder of their files.
std::uint64_t FingerprintOf(const Experiment& experiment);

// Returns the bytes of the file.
std::vector<char> EncodeCheckpoint(const Checkpoint& checkpoint);
// Throws std::runtime_error if the bytes are no checkpoint, have another version of the format, or are cut short or
// damaged.
Checkpoint DecodeCheckpoint(std::span<const char> bytes);
// Writes the correct length and checksum into bytes that were changed on purpose; for tests of readers.
void SealCheckpoint(std::vector<char>& bytes);

// Writes the file under another name and renames it, so that it is complete or absent. Throws std::runtime_error with
// the path.
void WriteCheckpoint(const std::string& path, const Checkpoint& checkpoint);

struct RestoreOptions
{
  // The number of controller hosts of the restored run. Robots are assigned to them by position (DealRobots).
  unsigned hosts = 1;
  bool any_build = false;  // accepts what other builds of the libraries saved
};
// Reads a checkpoint of the experiment. Throws std::runtime_error, with the path and the cure, if the file cannot be
// read or is damaged. Throws the same if it is of another experiment, or of other builds of its libraries.
Checkpoint ReadCheckpoint(const std::string& path, const Experiment& experiment, const RestoreOptions& options);

// Returns a name such as "checkpoint-00000500".
std::string CheckpointName(std::uint64_t tick);
// Checks that checkpoints can be taken every so many ticks. Throws std::invalid_argument with the cure otherwise.
void CheckCheckpointPeriod(std::uint64_t every, const Experiment& experiment);

}  // namespace swarmanoid
