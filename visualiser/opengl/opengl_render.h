// opengl_render: a window on the arena, in which a person watches and steers the run.
#pragma once

#include <memory>
#include <string>

#include "visualiser/gl/gl_scene.h"
#include "visualiser/gl/targets.h"
#include "visualiser/interaction/window_render.h"
#include "visualiser/opengl/gl_window.h"
#include "visualiser/panels/panels.h"

namespace swarmanoid
{

class COpenGlRender : public WindowRender
{
public:
  ~COpenGlRender() override;

private:
  void Open(const std::string& title, int width, int height, const Parameters& parameters) override;
  bool TakeEvents() override { return window_->PollEvents(GetViewer()); }
  bool WindowWantsToClose() const override { return window_->WantsToClose(); }
  bool WindowIsVisible() const override { return window_->IsVisible(); }
  void Show(const TakePicture& take) override;

  int samples_ = 4;
  // In the order in which they need one another.
  std::unique_ptr<GlWindow> window_;
  std::unique_ptr<GlScene> renderer_;
  std::unique_ptr<PictureTarget> target_;  // of pictures that are to be written
  std::unique_ptr<Panels> panels_;
};

}  // namespace swarmanoid
