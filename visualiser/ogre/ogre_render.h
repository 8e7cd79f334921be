// ogre_render: the rich window. OGRE draws the scene; camera, keys and panels are those of opengl_render.
#pragma once

#include <memory>
#include <string>

#include "visualiser/interaction/window_render.h"
#include "visualiser/ogre/ogre_scene.h"
#include "visualiser/ogre/ogre_window.h"
#include "visualiser/panels/panels.h"

namespace swarmanoid
{

class COgreRender : public WindowRender
{
private:
  void Open(const std::string& title, int width, int height, const Parameters& parameters) override;
  bool TakeEvents() override { return window_->TakeEvents(GetViewer()); }
  bool WindowWantsToClose() const override { return window_->WantsToClose(); }
  bool WindowIsVisible() const override { return true; }  // OGRE does not report visibility
  void Show(const TakePicture& take) override;
  void ShowPanels(const Scene& scene);

  // The order is that of their dependencies.
  std::unique_ptr<OgreWindow> window_;
  std::unique_ptr<OgreScene> scene_;
  std::unique_ptr<Panels> panels_;
};

}  // namespace swarmanoid
