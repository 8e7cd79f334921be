#include "common/math/reproducible_math.h"

#include <dlfcn.h>
#include <math.h>

#include <limits>
#include <stdexcept>
#include <string>

namespace swarmanoid
{
namespace
{

std::string FileOf(const void* function)
{
  Dl_info place{};
  return dladdr(function, &place) != 0 && place.dli_fname != nullptr ? place.dli_fname : "an unknown file";
}

void RequireModes()
{
  volatile double tiny = std::numeric_limits<double>::min();
  if (std::fegetround() != FE_TONEAREST)
    throw std::runtime_error("this thread does not round to nearest; call std::fesetround(FE_TONEAREST) before a run");
  if (tiny / 2 == 0)
    throw std::runtime_error(
        "this thread counts numbers below 2.2e-308 as 0, as no other program does; link this one without -ffast-math");
}

void RequireFunctions()
{
  // What this library was linked against, and what others find who were linked against libm.
  double (*const own)(double) = &::sin;
  const void* const found = dlsym(RTLD_DEFAULT, "sin");
  const std::string ours = FileOf(reinterpret_cast<const void*>(own));
  if (found == nullptr || FileOf(found) == ours) return;
  throw std::runtime_error("this program takes sin and the other functions of libm from " + FileOf(found) +
                           ", whose results depend on the processor; link it by CMake with Swarmanoid::simulation, put "
                           "-lswarmanoid_reproducible_math before other libraries, or start it with LD_PRELOAD=" +
                           ours);
}

}  // namespace

void RequireReproducibleMath()
{
  RequireFunctions();
  RequireModes();
}

}  // namespace swarmanoid
