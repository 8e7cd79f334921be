// GlScene: draws a scene with OpenGL 3.3 core. image_render (a context without a window) and opengl_render (a window's
// context) use it. It makes no context: the same context must be current in the thread of every call.
#pragma once

#include <memory>
#include <string>

#include "visualiser/scene/camera.h"
#include "visualiser/scene/drawn_picture.h"
#include "visualiser/scene/scene.h"

namespace swarmanoid
{

struct DrawOptions
{
  bool shadows = true;
  bool textures = true;
  int samples = 4;          // samples a pixel, for smooth edges; 0 or 1: none
  bool glass_walls = true;  // cuts tall walls at the edge of the arena open, so that they hide nothing
  std::string caption{};    // a line in the lower left corner; empty: none
  // Adds to the caption how much wider than they are robots are drawn, if they are.
  bool says_enlargement = false;
};

// Numbers of the last frame, for a status line.
struct DrawStatistics
{
  std::size_t instances = 0;
  std::size_t triangles = 0;  // including those of the shadow map
  std::size_t points = 0;     // robots that are discs
  float enlargement = 1;      // how much wider than they are robots are drawn, at most
};

class GlScene
{
public:
  // `text_scale`: of labels and the caption. Throws std::runtime_error if the context is older than 3.3 or rejects the
  // shaders.
  explicit GlScene(float text_scale = 1);
  ~GlScene();

  // Draws the state of the scene's last Update into a framebuffer object (0: the window's). Every call must get the
  // same scene. Leaves OpenGL's state at its defaults except for the viewport.
  void Draw(const Scene& scene, const Camera& camera, unsigned framebuffer, int width, int height,
            const DrawOptions& options);

  const DrawStatistics& Statistics() const;
  // Returns a text such as "llvmpipe (LLVM 15.0.6, 256 bits), OpenGL 4.5 (Core Profile) Mesa 22.3.6".
  static std::string ContextDescription();

private:
  struct State;
  std::unique_ptr<State> state_;
};

// Returns the picture in a framebuffer object, once drawing has ended.
Picture ReadPicture(unsigned framebuffer, int width, int height);

}  // namespace swarmanoid
