#include "argos3/plugin/labels.h"

#include <dlfcn.h>

#include <sstream>

#include "argos3/library/running.h"

namespace swarmanoid::argos3
{

void ShareNames(const std::string& library)
{
  if (void* handle = dlopen(library.c_str(), RTLD_NOW | RTLD_NOLOAD | RTLD_GLOBAL)) dlclose(handle);
}

void LoadBefore(const std::string& libraries)
{
  Dl_info api;
  if (dladdr(reinterpret_cast<const void*>(&ControllersByLabel), &api) != 0) ShareNames(api.dli_fname);
  std::istringstream paths(libraries);
  for (std::string path; std::getline(paths, path, ':');)
    if (const PluginLibrary& library = LoadPluginLibrary(path, {}); library.error.empty()) ShareNames(library.path);
}

}  // namespace swarmanoid::argos3
