// Renderers that need a heavy library (OpenGL, OGRE, a web server) are libraries of their own, loaded when one is made:
// a process holds only what it shows with, and a build without a renderer's packages still knows its name
// (common/plugin_descriptions).
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "visualiser/render.h"

namespace swarmanoid
{

inline constexpr const char* kWebPackages = "esbuild gzip nlohmann-json3-dev";

// A factory that loads lib<swarmanoid_NAME>.so from the folder swarmanoid beside our own libraries and makes its
// renderer. `packages`: the Debian packages without which the build leaves it out. The factory throws
// ConfigurationError, naming them, if the library is missing or cannot be loaded.
std::function<std::unique_ptr<CRender>()> RendererFromLibrary(const std::string& name, const std::string& packages);
// The address of a function of such a library, which is loaded; throws likewise.
void* FunctionOfRendererLibrary(const std::string& name, const std::string& packages, const char* function);

}  // namespace swarmanoid

// EXPORT_RENDERER(CMyRender): once in each such library.
#define EXPORT_RENDERER(CLASS)                                                                        \
  extern "C" __attribute__((visibility("default"))) ::swarmanoid::CRender* CreateSwarmanoidRenderer() \
  {                                                                                                   \
    return new CLASS;                                                                                 \
  }
