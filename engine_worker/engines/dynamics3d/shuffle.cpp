// Problem: ODE draws the order of constraints from one generator for all threads, so that a world's results would
// depend on the worlds that other threads solve.
//
// Method: ODE's library calls dRandInt as a dynamic symbol. The dynamic linker takes the first definition in the order
// of the libraries, and this library stands before ODE's, since it needs it. The numbers are those of ODE's function.
#include "engine_worker/engines/dynamics3d/shuffle.h"

#include <ode/ode.h>

namespace
{

thread_local std::uint32_t number = 0;
thread_local bool is_called = false;

// Returns `value` folded until its lowest `bits` depend on all of it.
std::uint32_t Folded(std::uint32_t value, unsigned bits)
{
  for (unsigned half = 16; half >= bits; half /= 2) value ^= value >> half;
  return value;
}

}  // namespace

// ODE declares the same function.
int dRandInt(int count)
{
  is_called = true;
  number = 1664525U * number + 1013904223U;
  const auto n = static_cast<std::uint64_t>(count);
  const unsigned bits = n <= 2 ? 1 : n <= 4 ? 2 : n <= 0x10 ? 4 : n <= 0x100 ? 8 : n <= 0x10000 ? 16 : 32;
  const std::uint64_t part = Folded(number, bits) & ((std::uint64_t{1} << bits) - 1);
  if (n <= 2) return static_cast<int>(part & (n >> 1));
  return static_cast<int>((part * n) >> bits);
}

namespace swarmanoid::dynamics3d
{

void SeedShuffle(std::uint32_t seed) { number = seed; }

bool IsShuffleOurs()
{
  is_called = false;
  const dWorldID world = dWorldCreate();
  const dBodyID body = dBodyCreate(world);
  dJointAttach(dJointCreateBall(world, nullptr), body, nullptr);
  dWorldSetQuickStepNumIterations(world, 20);
  dWorldQuickStep(world, 0.01);
  dWorldDestroy(world);
  return is_called;
}

}  // namespace swarmanoid::dynamics3d
