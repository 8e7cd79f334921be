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
inline constexpr char kCheckpointVersion = '2';
inline constexpr std::size_t kCheckpointHeaderBytes = 16;
inline constexpr std::size_t kCheckpointChecksumBytes = 8;

// `checkpoint`: a Checkpoint, const for archives that only look.
template <class Archive, class Checkpoint>
void ForEachCheckpointField(Archive& archive, Checkpoint& checkpoint)
{
  archive.Number(checkpoint.origin.experiment);
  archive.List(checkpoint.origin.libraries,
               [&](auto& library)
               {
                 archive.Text(library.name);
                 archive.Text(library.build);
               });
  archive.Number(checkpoint.snapshot.tick);
  archive.Array(checkpoint.snapshot.poses);
  archive.Array(checkpoint.snapshot.attributes);
  archive.List(checkpoint.parts,
               [&](auto& part)
               {
                 archive.Text(part.name);
                 archive.Array(part.state);
               });
}

}  // namespace swarmanoid
