// An OpenGL context without a window or an X server, by EGL. It uses the first device that provides one, else Mesa's
// surfaceless platform.
#pragma once

#include <memory>
#include <string>

#include "visualiser/gl/gl_object.h"
#include "visualiser/scene/drawn_picture.h"

namespace swarmanoid
{

class OffscreenContext
{
public:
  // Makes the context current in this thread, until another one is made current. Throws std::runtime_error with the
  // attempts.
  OffscreenContext();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  // If the process has several contexts, call it before drawing and before deleting objects of this context.
  void MakeCurrent() const;
  // Returns "EGL device 0" or "EGL surfaceless".
  const std::string& Kind() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

// A framebuffer with one colour and no depth, for drawing a finished picture and reading it.
class PictureBuffer
{
public:
  PictureBuffer(int width, int height);
  GLuint Framebuffer() const { return framebuffer_.Name(); }
  Picture Read() const;

private:
  int width_, height_;
  GlObject framebuffer_{GlObject::Kind::kFramebuffer};
  GlObject colour_{GlObject::Kind::kRenderbuffer};
};

}  // namespace swarmanoid
