// opengl_render: a window on the arena, in which a user watches and controls the run.
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
  // The order is that of their dependencies.
  std::unique_ptr<GlWindow> window_;
  std::unique_ptr<GlScene> renderer_;
  std::unique_ptr<PictureTarget> target_;  // the target of written pictures
  std::unique_ptr<Panels> panels_;
};

}  // namespace swarmanoid
