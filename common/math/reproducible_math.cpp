#include "common/math/reproducible_math.h"

#include <dlfcn.h>
#include <math.h>

#include <atomic>
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

std::atomic<bool>& OwnScope()
{
  static std::atomic<bool> own_scope = false;
  return own_scope;
}

// Return the files from which this library and the program take sin.
std::string OwnFile()
{
  double (*const own)(double) = &::sin;
  return FileOf(reinterpret_cast<const void*>(own));
}
std::string FileOfProgram()
{
  const void* const found = dlsym(RTLD_DEFAULT, "sin");
  return found == nullptr ? std::string() : FileOf(found);
}

void RequireFunctions()
{
  const std::string own = OwnFile(), program = FileOfProgram();
  const bool is_ours = own.find("libswarmanoid_reproducible_math") != std::string::npos;
  if (is_ours && (program.empty() || program == own || OwnScope())) return;
  throw std::runtime_error("this program takes sin and the other functions of libm from " + (is_ours ? program : own) +
                           ", whose results depend on the processor; link it by CMake with Swarmanoid::simulation, put "
                           "-lswarmanoid_reproducible_math before other libraries, or start it with LD_PRELOAD=" +
                           own);
}

}  // namespace

void SetOwnScope() { OwnScope() = true; }

void RequireReproducibleMath()
{
  RequireFunctions();
  RequireModes();
}

void* OpenLibrary(const std::string& path)
{
  const FloatingPointGuard guard;
  return dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL | (OwnScope() ? RTLD_DEEPBIND : 0));
}

}  // namespace swarmanoid
