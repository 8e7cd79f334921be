#include "common/math/reproducible_math.h"

#include <dlfcn.h>
#include <math.h>

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

}  // namespace

void RequireReproducibleMath()
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

}  // namespace swarmanoid
