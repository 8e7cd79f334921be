#include "visualiser/renderer_library.h"

#include <dlfcn.h>

#include <filesystem>

#include "common/math/reproducible_math.h"

namespace swarmanoid
{
namespace
{

// Returns the folder of the library that contains this code.
std::filesystem::path OwnFolder()
{
  Dl_info place{};
  dladdr(reinterpret_cast<const void*>(&OwnFolder), &place);
  return std::filesystem::path(place.dli_fname).parent_path();
}

}  // namespace

void* FunctionOfRendererLibrary(const std::string& name, const std::string& packages, const char* function)
{
  const std::string path = (OwnFolder() / "swarmanoid" / ("libswarmanoid_" + name + ".so")).string();
  if (!std::filesystem::exists(path))
    throw ConfigurationError(name + " is not installed, there is no " + path +
                             "; install the package swarmanoid, or for a build of your own " + packages +
                             ", and build again");
  void* library = OpenLibrary(path);
  if (library == nullptr) throw ConfigurationError(name + " cannot be loaded: " + dlerror());
  void* const found = dlsym(library, function);
  if (found == nullptr) throw ConfigurationError(path + " holds no " + function);
  return found;
}

std::function<std::unique_ptr<CRender>()> RendererFromLibrary(const std::string& name, const std::string& packages,
                                                              const char* create)
{
  return [name, packages, create]
  {
    void* const function = FunctionOfRendererLibrary(name, packages, create);
    return std::unique_ptr<CRender>(reinterpret_cast<CRender* (*)()>(function)());
  };
}

}  // namespace swarmanoid
