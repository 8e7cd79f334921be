// WindowRender: what all renderers with a window share: its parameters, when it draws, and the pictures that it writes.
// The window and the drawing are of the renderers that derive from it: opengl_render and ogre_render. In the thread of
// Draw and Idle.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "visualiser/interaction/frame_schedule.h"
#include "visualiser/interaction/viewer.h"
#include "visualiser/render.h"
#include "visualiser/scene/picture.h"

namespace swarmanoid
{

class WindowRender : public CRender
{
public:
  void Init(const RenderSetup& setup) final;
  void Draw() final;
  void Idle() final;
  bool Terminate() final { return WindowWantsToClose() || viewer_->WantsToClose(); }
  bool IsInteractive() const final { return true; }

protected:
  using TakePicture = std::function<void(const Picture&)>;

  // Sizes in the unit of the mouse. Throws std::runtime_error, saying what is missing, if there can be no window.
  virtual void Open(const std::string& title, int width, int height, const Parameters& parameters) = 0;
  // Takes what happened since the last call to the viewer. True if anything did.
  virtual bool TakeEvents() = 0;
  virtual bool WindowWantsToClose() const = 0;
  // False if nobody could see what is drawn.
  virtual bool WindowIsVisible() const = 0;
  // Draws the viewer's scene into the window, then the panels. `take`, if it is not empty, gets the picture without
  // the panels, before they are drawn: they tell what came of it.
  virtual void Show(const TakePicture& take) = 0;

  Viewer& GetViewer() { return *viewer_; }

private:
  void NoteEvents();
  void DrawFrame(bool of_a_tick);

  std::string output_folder_;
  OutputFiles files_;
  std::string frames_;  // folder and first part of the name; empty: none are written
  std::unique_ptr<FrameSchedule> schedule_;
  std::unique_ptr<Viewer> viewer_;
};

}  // namespace swarmanoid
