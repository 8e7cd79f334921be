// A window of GLFW with an OpenGL 3.3 context and Dear ImGui, whose keys and mouse go to the panels or to a Viewer.
// Used by opengl_render, in the main thread. Several may be open in one process.
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

  // Takes what happened since the last call to the viewer. True if anything did.
  bool PollEvents(Viewer& viewer);
  // The context and ImGui of this window are current from then on.
  void MakeCurrent() const;
  // Draws what `panels` shows over the picture, and shows the window's new contents.
  void Present(const std::function<void()>& panels);

  bool WantsToClose() const;
  bool IsVisible() const;
  // In the unit of the mouse, and in pixels.
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
  Viewer* viewer_ = nullptr;  // while events are polled
  bool happened_ = false;
  // Where the mouse was at the event that is handled: GLFW would say where it is by now, several events later.
  double mouse_x_ = 0, mouse_y_ = 0;
  int width_ = 0, height_ = 0;
  int pixel_width_ = 0, pixel_height_ = 0;
  float scale_ = 1;
};

}  // namespace swarmanoid
