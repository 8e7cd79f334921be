// The file of a checkpoint, stated once: whoever writes it, reads it, measures it or tests it goes through
// ForEachCheckpointField.
//
//   "SWARMCP" and the version of the format (one character)
//   bytes of the whole file (u64)
//   the fields, in the order below
//   XXH3, 64 bits, of all bytes before (u64)
//
// Numbers are little-endian; texts and arrays have their count (u64) before them, lists the number of their entries.
#pragma once

#include <cstddef>
#include <string_view>

namespace swarmanoid
{

inline constexpr std::string_view kCheckpointMagic = "SWARMCP";
// Another one for each change of the fields, or of what they mean.
inline constexpr char kCheckpointVersion = '4';
inline constexpr std::size_t kCheckpointHeaderBytes = 16;
inline constexpr std::size_t kCheckpointChecksumBytes = 8;

// Of a CheckpointOrigin, a SpaceSnapshot, a SavedPart and a Checkpoint, const for archives that only look. A journal
// has the first three in blocks of their own.
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

template <class Archive, class Snapshot>
void ForEachSnapshotField(Archive& archive, Snapshot& snapshot)
{
  archive.Number(snapshot.tick);
  archive.Array(snapshot.poses);
  archive.Array(snapshot.attributes);
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
