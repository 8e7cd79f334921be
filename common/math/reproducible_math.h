// Checks that this process computes with the same bits as every other: its sources of sin, exp and similar functions,
// and its rounding. Programs that CMake links to our libraries take these functions from
// libswarmanoid_reproducible_math (docs/determinism.md). In a program linked in another way, libm may come first; then
// the bits of ODE and Box2D would depend on the processor.
#pragma once

#include <cfenv>
#include <string>

namespace swarmanoid
{

// Throws std::runtime_error with the cure if this process takes the functions from elsewhere. Also throws if this
// thread does not round to nearest, or treats subnormal numbers as 0.
void RequireReproducibleMath();

// States that a program with libm in front (Python) loaded our libraries with RTLD_DEEPBIND. They then find their
// functions among themselves first, and so do libraries that OpenLibrary loads later.
void SetOwnScope();

// Restores the floating-point modes of this thread when it ends. Libraries linked with -ffast-math change the modes
// when they are loaded, so that subnormal numbers count as 0 in this thread.
class FloatingPointGuard
{
public:
  FloatingPointGuard() { std::fegetenv(&modes_); }
  ~FloatingPointGuard() { std::fesetenv(&modes_); }
  FloatingPointGuard(const FloatingPointGuard&) = delete;
  FloatingPointGuard& operator=(const FloatingPointGuard&) = delete;

private:
  std::fenv_t modes_;
};

// Calls dlopen for the library of a plug-in. Its code uses the same mathematical functions as ours, and the
// floating-point modes of this thread do not change. Returns nullptr on failure; dlerror() says why.
void* OpenLibrary(const std::string& path);

}  // namespace swarmanoid
