#include "argos3/plugin/labels.h"

#include <dlfcn.h>

#include <initializer_list>
#include <lua.hpp>
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
  // The names of our library, and of Lua's for functions that read scripts.
  for (const void* name :
       {reinterpret_cast<const void*>(&ControllersByLabel), reinterpret_cast<const void*>(&lua_gettop)})
    if (Dl_info found; dladdr(name, &found) != 0) ShareNames(found.dli_fname);
  std::istringstream paths(libraries);
  for (std::string path; std::getline(paths, path, ':');)
    if (const PluginLibrary& library = LoadPluginLibrary(path, {}); library.error.empty()) ShareNames(library.path);
}

}  // namespace swarmanoid::argos3
