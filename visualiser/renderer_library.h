// Loads renderers that need a heavy library (OpenGL, OGRE, a web server) when one is made, from libraries of their
// own. So a process loads only what it needs, and a build without a renderer's packages still knows its name
// (common/plugin_descriptions).
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "visualiser/render.h"

namespace swarmanoid
{

inline constexpr const char* kWebPackages = "esbuild gzip nlohmann-json3-dev";

// Returns a factory that loads lib<swarmanoid_NAME>.so from the folder swarmanoid beside our own libraries and makes
// its renderer. `packages`: the Debian packages without which the build leaves it out. The factory throws
// ConfigurationError if the library is missing or cannot be loaded. The message names the package swarmanoid, since
// swarmanoid-core has no renderers of pictures and windows, and `packages`. `create`: the function that makes the
// renderer.
std::function<std::unique_ptr<CRender>()> RendererFromLibrary(const std::string& name, const std::string& packages,
                                                              const char* create = "CreateSwarmanoidRenderer");
// Returns the address of a function of such a library, which it loads. Throws as the factory does.
void* FunctionOfRendererLibrary(const std::string& name, const std::string& packages, const char* function);

}  // namespace swarmanoid

// EXPORT_RENDERER(CMyRender) is used once in each such library.
#define EXPORT_RENDERER(CLASS)                                                                        \
  extern "C" __attribute__((visibility("default"))) ::swarmanoid::CRender* CreateSwarmanoidRenderer() \
  {                                                                                                   \
    return new CLASS;                                                                                 \
  }
