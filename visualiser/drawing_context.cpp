#include "visualiser/drawing_context.h"

#include <dlfcn.h>

namespace swarmanoid
{
namespace
{

// The context of the renderer whose code ran last in this thread.
thread_local DrawingContext* present = nullptr;

constexpr int kEglDraw = 0x3059, kEglRead = 0x305A;

// Returns a function of a library that a renderer has loaded; nullptr if the library is not loaded.
template <class Function>
Function* Find(const char* library, const char* name)
{
  void* const handle = dlopen(library, RTLD_LAZY | RTLD_NOLOAD);
  if (handle == nullptr) return nullptr;
  auto* const found = reinterpret_cast<Function*>(dlsym(handle, name));
  dlclose(handle);
  return found;
}

template <class Function>
Function* FindInGlx(const char* name)
{
  return Find<Function>("libGLX.so.0", name);
}

template <class Function>
Function* FindInEgl(const char* name)
{
  return Find<Function>("libEGL.so.1", name);
}

using Pointer = void*();
using Drawable = unsigned long();
using Surface = void*(int);
using MakeGlxCurrent = int(void* display, unsigned long draw, unsigned long read, void* context);
using MakeEglCurrent = unsigned(void* display, void* draw, void* read, void* context);

template <class Result, class... Arguments>
Result Call(Result (*function)(Arguments...), Arguments... arguments)
{
  return function == nullptr ? Result() : function(arguments...);
}

}  // namespace

DrawingContext::~DrawingContext()
{
  if (present == this) present = nullptr;
}

void DrawingContext::Enter()
{
  if (present == this) return;
  if (present != nullptr) present->Store();
  present = this;
  Restore();
}

void DrawingContext::Store()
{
  glx_ = {};
  egl_ = {};
  if (void* const context = Call(FindInGlx<Pointer>("glXGetCurrentContext")))
  {
    glx_ = {Call(FindInGlx<Pointer>("glXGetCurrentDisplay")), Call(FindInGlx<Drawable>("glXGetCurrentDrawable")),
            Call(FindInGlx<Drawable>("glXGetCurrentReadDrawable")), context};
    Call(FindInGlx<MakeGlxCurrent>("glXMakeContextCurrent"), glx_.display, 0UL, 0UL, static_cast<void*>(nullptr));
  }
  if (void* const context = Call(FindInEgl<Pointer>("eglGetCurrentContext")))
  {
    egl_ = {Call(FindInEgl<Pointer>("eglGetCurrentDisplay")),
            Call(FindInEgl<Surface>("eglGetCurrentSurface"), kEglDraw),
            Call(FindInEgl<Surface>("eglGetCurrentSurface"), kEglRead), context};
    void* const none = nullptr;
    Call(FindInEgl<MakeEglCurrent>("eglMakeCurrent"), egl_.display, none, none, none);
  }
}

void DrawingContext::Restore() const
{
  if (glx_.context != nullptr)
    Call(FindInGlx<MakeGlxCurrent>("glXMakeContextCurrent"), glx_.display, glx_.draw, glx_.read, glx_.context);
  if (egl_.context != nullptr)
    Call(FindInEgl<MakeEglCurrent>("eglMakeCurrent"), egl_.display, egl_.draw, egl_.read, egl_.context);
}

}  // namespace swarmanoid
