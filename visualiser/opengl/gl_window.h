// A window of GLFW with an OpenGL 3.3 context and Dear ImGui. Its keys and mouse go to the panels or to a Viewer.
// opengl_render uses it in the main thread. A process may have several.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "visualiser/interaction/viewer.h"

struct GLFWwindow;
struct ImGuiContext;

namespace swarmanoid
{

class GlWindow
{
public:
  // Throws std::runtime_error, saying what is missing, if there is no display or no OpenGL 3.3.
  GlWindow(const std::string& title, int width, int height);
  ~GlWindow();
  GlWindow(const GlWindow&) = delete;
  GlWindow& operator=(const GlWindow&) = delete;

  // Passes the events since the last call to the viewer. Returns true if there were any.
  bool PollEvents(Viewer& viewer);
  // Makes the context and ImGui of this window current.
  void MakeCurrent() const;
  // Draws the content of `panels` over the picture, and shows the window's new contents.
  void Present(const std::function<void()>& panels);

  bool WantsToClose() const;
  bool IsVisible() const;
  // Return the size in the unit of the mouse, and in pixels.
  int Width() const { return width_; }
  int Height() const { return height_; }
  int PixelWidth() const { return pixel_width_; }
  int PixelHeight() const { return pixel_height_; }
  float Scale() const { return scale_; }

private:
  struct Callbacks;

  void ReadSize();
  void OpenImGui();

  GLFWwindow* window_ = nullptr;
  ImGuiContext* imgui_ = nullptr;
  Viewer* viewer_ = nullptr;  // set while events are polled
  bool happened_ = false;
  // The position of the mouse at the event that is handled. GLFW would return the current position, which is several
  // events later.
  double mouse_x_ = 0, mouse_y_ = 0;
  int width_ = 0, height_ = 0;
  int pixel_width_ = 0, pixel_height_ = 0;
  float scale_ = 1;
};

}  // namespace swarmanoid
