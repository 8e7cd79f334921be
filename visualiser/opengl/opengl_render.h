// opengl_render: a window on the arena, in which a person watches and steers the run.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "visualiser/gl/gl_scene.h"
#include "visualiser/gl/targets.h"
#include "visualiser/interaction/frame_schedule.h"
#include "visualiser/interaction/viewer.h"
#include "visualiser/opengl/gl_window.h"
#include "visualiser/panels/panels.h"
#include "visualiser/render.h"

namespace swarmanoid
{

class COpenGlRender : public CRender
{
public:
  ~COpenGlRender() override;
  void Init(const RenderSetup& setup) override;
  void Draw() override;
  void Idle() override;
  bool Terminate() override { return window_->WantsToClose() || viewer_->WantsToClose(); }
  bool IsInteractive() const override { return true; }

private:
  static double Now();
  void TakeEvents();
  void DrawFrame(bool of_a_tick);
  void WritePicture(const std::string& path, const Picture& picture);

  int samples_ = 4;
  std::string output_folder_;
  std::string frames_;  // folder and first part of the name; empty: none are written
  std::unique_ptr<FrameSchedule> schedule_;
  // In the order in which they need one another.
  std::unique_ptr<GlWindow> window_;
  std::unique_ptr<Viewer> viewer_;
  std::unique_ptr<GlScene> renderer_;
  std::unique_ptr<PictureTarget> target_;  // of pictures that are to be written
  std::unique_ptr<Panels> panels_;
};

}  // namespace swarmanoid
