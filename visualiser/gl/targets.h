// The framebuffers: the picture with several samples a pixel, and the shadow map.
#pragma once

#include "visualiser/gl/gl_object.h"

namespace swarmanoid
{

// A picture with depth. With more than one sample it must be copied before it is read.
class PictureTarget
{
public:
  // Does nothing if the size is unchanged. Throws std::runtime_error if OpenGL refuses.
  void Resize(int width, int height, int samples);
  GLuint Framebuffer() const { return framebuffer_.Name(); }

private:
  int width_ = 0, height_ = 0, samples_ = -1;
  GlObject framebuffer_, colour_, depth_;
};

class ShadowMap
{
public:
  static constexpr int kSide = 2048;

  ShadowMap();
  GLuint Framebuffer() const { return framebuffer_.Name(); }
  GLuint Texture() const { return texture_.Name(); }

private:
  GlObject framebuffer_{GlObject::Kind::kFramebuffer};
  GlObject texture_{GlObject::Kind::kTexture};
};

}  // namespace swarmanoid
