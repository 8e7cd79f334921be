// Tests before a run with checkpoints whether a role can be saved, so that the error does not come in the middle of the
// run.
#pragma once

#include "common/serialisation/bytes.h"

namespace swarmanoid
{

// Throws the exception of the role's SaveState.
template <class Role>
void TrySaving(const Role& role)
{
  ByteWriter scratch;
  role.SaveState(scratch);
}

}  // namespace swarmanoid
