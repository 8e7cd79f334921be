// DrawingContext: keeps the OpenGL context that a renderer leaves current in its thread, and restores it before the
// renderer runs again. Window libraries assume that their context stays current. GLX and EGL refuse to make one current
// while the other's is.
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

  // Call it before code of its renderer runs. It costs nothing if that renderer ran last.
  void Enter();

private:
  void Store();
  void Restore() const;

  struct Glx
  {
    void* display = nullptr;
    unsigned long draw = 0, read = 0;
    void* context = nullptr;  // nullptr: the renderer has no GLX context
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
