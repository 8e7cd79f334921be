// Keys of runs for tests.
#pragma once

#include "common/bus/run_key.h"

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
