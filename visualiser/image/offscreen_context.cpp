// Machines of a cluster have no display, and some have no graphics card. All EGL devices are tried in their order, then
// Mesa's surfaceless platform, which draws in software; the first one that gives an OpenGL 3.3 core context is kept.
// What was tried and why it failed is part of the error, because users can seldom see the machine.
#include "visualiser/image/offscreen_context.h"

#include <dlfcn.h>
#include <epoxy/egl.h>

#include <array>
#include <stdexcept>

#include "visualiser/gl/gl_scene.h"

namespace swarmanoid
{

struct OffscreenContext::State
{
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
  std::string kind;
  std::string tried;

  ~State()
  {
    // The display stays open, since other contexts of this process may use it.
    if (context == EGL_NO_CONTEXT) return;
    if (eglGetCurrentContext() == context) eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display, context);
  }

  bool Try(EGLDisplay candidate, const std::string& name);
  bool TryDevices();
  bool TrySurfaceless();
};

bool OffscreenContext::State::Try(EGLDisplay candidate, const std::string& name)
{
  const auto refuse = [&](const char* why)
  {
    tried += (tried.empty() ? "" : "; ") + name + ": " + why;
    return false;
  };
  if (candidate == EGL_NO_DISPLAY || eglInitialize(candidate, nullptr, nullptr) == EGL_FALSE)
    return refuse("it does not start");
  if (!epoxy_has_egl_extension(candidate, "EGL_KHR_surfaceless_context")) return refuse("it needs a window");
  if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) return refuse("it has no OpenGL");
  constexpr std::array<EGLint, 5> kWanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint configs = 0;
  if (eglChooseConfig(candidate, kWanted.data(), &config, 1, &configs) == EGL_FALSE || configs == 0)
    return refuse("it has no OpenGL");
  constexpr std::array<EGLint, 7> kVersion{
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  const EGLContext made = eglCreateContext(candidate, config, EGL_NO_CONTEXT, kVersion.data());
  if (made == EGL_NO_CONTEXT) return refuse("it has no OpenGL 3.3");
  if (eglMakeCurrent(candidate, EGL_NO_SURFACE, EGL_NO_SURFACE, made) == EGL_FALSE)
  {
    eglDestroyContext(candidate, made);
    return refuse("its context cannot be used");
  }
  display = candidate;
  context = made;
  kind = name;
  return true;
}

bool OffscreenContext::State::TryDevices()
{
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration") &&
      !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_base"))
    return false;
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  if (eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_FALSE) return false;
  for (EGLint i = 0; i < count; ++i)
    if (Try(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(i)], nullptr),
            "EGL device " + std::to_string(i)))
      return true;
  return false;
}

bool OffscreenContext::State::TrySurfaceless()
{
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) return false;
  return Try(eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr), "EGL surfaceless");
}

OffscreenContext::OffscreenContext() : state_(std::make_unique<State>())
{
  // The library of OpenGL's entry points ends the program if this library is missing.
  if (dlopen("libEGL.so.1", RTLD_LAZY | RTLD_LOCAL) == nullptr)
    throw std::runtime_error(
        "pictures need OpenGL, and there is no libEGL.so.1; install the packages libegl1 and "
        "libgl1-mesa-dri (which draws without a graphics card)");
  if (state_->TryDevices() || state_->TrySurfaceless()) return;
  throw std::runtime_error("pictures need an OpenGL 3.3 context without a window, and EGL gives none (" +
                           (state_->tried.empty() ? std::string("it knows no device") : state_->tried) +
                           "); install the package libgl1-mesa-dri, which draws without a graphics card");
}

OffscreenContext::~OffscreenContext() = default;

void OffscreenContext::MakeCurrent() const
{
  if (eglGetCurrentContext() != state_->context)
    eglMakeCurrent(state_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, state_->context);
}

const std::string& OffscreenContext::Kind() const { return state_->kind; }

PictureBuffer::PictureBuffer(int width, int height) : width_(width), height_(height)
{
  glBindRenderbuffer(GL_RENDERBUFFER, colour_.Name());
  glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.Name());
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_.Name());
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw std::runtime_error("OpenGL cannot make a picture of " + std::to_string(width) + " by " +
                             std::to_string(height) + " pixels");
}

Picture PictureBuffer::Read() const { return ReadPicture(framebuffer_.Name(), width_, height_); }

}  // namespace swarmanoid
