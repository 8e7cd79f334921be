// Whether a role can be saved, tried before a run that takes checkpoints: what cannot be is said then, not in the midst
// of it.
#pragma once

#include "common/serialisation/bytes.h"

namespace swarmanoid
{

// Throws what the role's SaveState throws.
template <class Role>
void TrySaving(const Role& role)
{
  ByteWriter scratch;
  role.SaveState(scratch);
}

}  // namespace swarmanoid
