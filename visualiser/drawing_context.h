// DrawingContext: the OpenGL context that a renderer leaves current in its thread. It finds it again, and other
// renderers of the thread do not: libraries of windows think theirs stays current, and GLX and EGL refuse where the
// other one is.
#pragma once

namespace swarmanoid
{

class DrawingContext
{
public:
  DrawingContext() = default;
  ~DrawingContext();
  DrawingContext(const DrawingContext&) = delete;
  DrawingContext& operator=(const DrawingContext&) = delete;

  // Before code of its renderer runs. Costs nothing if that ran last.
  void Enter();

private:
  void Store();
  void Restore() const;

  struct Glx
  {
    void* display = nullptr;
    unsigned long draw = 0, read = 0;
    void* context = nullptr;  // none: it has no context of GLX
  };
  struct Egl
  {
    void* display = nullptr;
    void *draw = nullptr, *read = nullptr;
    void* context = nullptr;
  };

  Glx glx_;
  Egl egl_;
};

}  // namespace swarmanoid
