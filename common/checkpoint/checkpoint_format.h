// The format of a checkpoint file, stated once. Writers, readers, size computations and tests use
// ForEachCheckpointField.
//
//   "SWARMCP" and the version of the format (one character)
//   bytes of the whole file (u64)
//   the fields, in the order below
//   XXH3, 64 bits, of all bytes before (u64)
//
// Numbers are little-endian. Texts and arrays have their count (u64) before them; lists have the number of their
// entries.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace swarmanoid
{

inline constexpr std::string_view kCheckpointMagic = "SWARMCP";
// Change the version with each change of the fields or of their meaning.
inline constexpr char kCheckpointVersion = '4';
inline constexpr std::size_t kCheckpointHeaderBytes = 16;
inline constexpr std::size_t kCheckpointChecksumBytes = 8;

// Visits the fields of a CheckpointOrigin, a SpaceSnapshot, a SavedPart or a Checkpoint, which are const for archives
// that only read. A journal has the first three in its own blocks.
template <class Archive, class Origin>
void ForEachOriginField(Archive& archive, Origin& origin)
{
  archive.Number(origin.experiment);
  archive.List(origin.libraries,
               [&](auto& library)
               {
                 archive.Text(library.name);
                 archive.Text(library.build);
               });
}

// This bit of the tick says that cells of floor fields follow. Files without them are as in the versions before.
inline constexpr std::uint64_t kHasFieldCells = std::uint64_t{1} << 63U;

template <class Archive, class Snapshot>
void ForEachSnapshotField(Archive& archive, Snapshot& snapshot)
{
  std::uint64_t tick = snapshot.tick | (snapshot.fields.values.empty() ? 0 : kHasFieldCells);
  archive.Number(tick);
  if constexpr (!std::is_const_v<Snapshot>) snapshot.tick = tick & ~kHasFieldCells;
  archive.Array(snapshot.poses);
  archive.Array(snapshot.attributes);
  if ((tick & kHasFieldCells) == 0) return;
  archive.Array(snapshot.fields.runs);
  archive.Array(snapshot.fields.values);
}

template <class Archive, class Part>
void ForEachPartField(Archive& archive, Part& part)
{
  archive.Text(part.name);
  archive.Array(part.state);
}

template <class Archive, class Checkpoint>
void ForEachCheckpointField(Archive& archive, Checkpoint& checkpoint)
{
  ForEachOriginField(archive, checkpoint.origin);
  ForEachSnapshotField(archive, checkpoint.snapshot);
  archive.List(checkpoint.parts, [&](auto& part) { ForEachPartField(archive, part); });
}

}  // namespace swarmanoid
