#include "common/plugins/own_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <stdexcept>

#include "common/math/reproducible_math.h"
#include "common/plugins/plugin_library.h"
#include "common/version/version.h"

namespace swarmanoid
{

std::string OwnLibraryFile(const std::string& name)
{
  return fmt::format("{}/libswarmanoid_{}.so.{}.{}", OwnLibraryFolder(), name, SWARMANOID_VERSION_MAJOR,
                     SWARMANOID_VERSION_MINOR);
}

void* FunctionOfOwnLibrary(const std::string& name, const char* function)
{
  void* const library = OpenLibrary(OwnLibraryFile(name));
  void* const found = library == nullptr ? nullptr : dlsym(library, function);
  if (found == nullptr) throw std::runtime_error(dlerror());
  return found;
}

}  // namespace swarmanoid
