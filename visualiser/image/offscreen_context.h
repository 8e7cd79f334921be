// An OpenGL context without a window or an X server, by EGL: on the first device that has one, else Mesa's surfaceless
// platform.
#pragma once

#include <memory>
#include <string>

#include "visualiser/gl/gl_object.h"
#include "visualiser/scene/picture.h"

namespace swarmanoid
{

class OffscreenContext
{
public:
  // Current in this thread, until another one is. Throws std::runtime_error, saying what was tried.
  OffscreenContext();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  // Before drawing, and before what was made in it is deleted, if the process has several contexts.
  void MakeCurrent() const;
  // "EGL device 0", "EGL surfaceless".
  const std::string& Kind() const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

// A framebuffer with one colour and no depth, to draw a finished picture into and read it.
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
