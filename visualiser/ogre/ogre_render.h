// ogre_render: the rich window. OGRE draws the scene; camera, keys and panels are those of opengl_render.
#pragma once

#include <memory>
#include <string>

#include "visualiser/interaction/frame_schedule.h"
#include "visualiser/interaction/viewer.h"
#include "visualiser/ogre/ogre_scene.h"
#include "visualiser/ogre/ogre_window.h"
#include "visualiser/panels/panels.h"
#include "visualiser/render.h"

namespace swarmanoid
{

class COgreRender : public CRender
{
public:
  void Init(const RenderSetup& setup) override;
  void Draw() override;
  void Idle() override;
  bool Terminate() override { return window_->WantsToClose() || viewer_->WantsToClose(); }
  bool IsInteractive() const override { return true; }

private:
  void TakeEvents();
  void DrawFrame(bool of_a_tick);
  void ShowPanels(const Scene& scene);
  void WritePicture(const std::string& path);

  std::string output_folder_;
  std::string frames_;  // folder and first part of the name; empty: none are written
  std::unique_ptr<FrameSchedule> schedule_;
  // In the order in which they need one another.
  std::unique_ptr<Viewer> viewer_;
  std::unique_ptr<OgreWindow> window_;
  std::unique_ptr<OgreScene> scene_;
  std::unique_ptr<Panels> panels_;
};

}  // namespace swarmanoid
