// Keys of runs for tests.
#pragma once

#include "common/run/access/run_key.h"

namespace swarmanoid::test
{

// Returns a key whose bytes all have this value.
inline RunKey KeyOfByte(unsigned char byte)
{
  RunKey key;
  key.fill(byte);
  return key;
}

}  // namespace swarmanoid::test
