// The fields of every message, as idl/generate.py writes them from idl/swarmanoid.idl, and the checks across fields.
// The code that counts, writes, reads and checks the bytes of a message (cdr.h) visits the fields. Used only by the
// bus.
#pragma once

#include <numeric>

#include "common/bus/topics/cdr.h"
#include "common/messages/attribute_changes.h"
#include "idl/message_fields.h"

namespace swarmanoid
{

// Poses, and the flags behind them.
template <class Archive>
void PoseFields(Archive& archive, std::vector<double>& poses, std::initializer_list<FlagBit> flags)
{
  if constexpr (Archive::kReads)
  {
    archive.Poses("poses", poses, flags);
  }
  else
  {
    const std::uint32_t uniform = UniformColumns(poses);
    archive.Columns(poses, uniform);
    archive.Flags("flags", flags, uniform * kFlagUniformX);
  }
}

inline void CheckFields(const AttributeChanges& changes)
{
  if (!IsOrdered(changes)) RefuseField("slots", "they do not ascend, or are not as many as the values");
}

inline void CheckFields(const RegionMessage& message)
{
  if (std::accumulate(message.sizes.begin(), message.sizes.end(), std::uint64_t{0}) != message.bytes.size())
    RefuseField("sizes", "they are not those of the bytes");
}

}  // namespace swarmanoid
