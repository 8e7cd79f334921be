// Whether this process computes as every other does: where it takes sin, exp and the like from, and how it rounds.
// Programs that CMake links to a library of ours take them from libswarmanoid_reproducible_math (docs/determinism.md);
// one that is linked otherwise may have libm before it, and the bits of ODE and Box2D would then depend on the
// processor.
#pragma once

#include <cfenv>
#include <string>

namespace swarmanoid
{

// Throws std::runtime_error, with the cure, if this process takes them from elsewhere, or if this thread rounds
// otherwise than to nearest or counts tiny numbers as 0.
void RequireReproducibleMath();

// Says that our libraries were loaded with RTLD_DEEPBIND by a program that has libm before them (Python): they find
// their functions among themselves first, and so do those that OpenLibrary loads from then on.
void SetOwnScope();

// Restores the floating-point modes of this thread when it ends. Libraries that were linked with -ffast-math set, when
// they are loaded, that tiny numbers count as 0, for all that the thread computes from then on.
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

// dlopen for the library of a plug-in: its code takes its functions from where ours does, and its loading leaves the
// floating-point modes of this thread as they are. nullptr: dlerror() says why not.
void* OpenLibrary(const std::string& path);

}  // namespace swarmanoid
