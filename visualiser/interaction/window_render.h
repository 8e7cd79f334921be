// WindowRender: the common part of all renderers with a window: parameters, the schedule of drawing, and written
// pictures. The derived classes opengl_render and ogre_render own the window and draw. Everything runs in the thread of
// Draw and Idle.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "visualiser/interaction/frame_schedule.h"
#include "visualiser/interaction/viewer.h"
#include "visualiser/render.h"
#include "visualiser/scene/drawn_picture.h"

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

  // Opens the window. Sizes are in the unit of the mouse. Throws std::runtime_error, saying what is missing, if no
  // window can be opened.
  virtual void Open(const std::string& title, int width, int height, const Parameters& parameters) = 0;
  // Passes the events since the last call to the viewer. Returns true if there were any.
  virtual bool TakeEvents() = 0;
  // Returns true once the user has closed the window.
  virtual bool WindowWantsToClose() const = 0;
  // Returns false if the window is not visible.
  virtual bool WindowIsVisible() const = 0;
  // Draws the viewer's scene into the window, then the panels. If `take` is not empty, it gets the picture before the
  // panels are drawn, since the panels report the result.
  virtual void Show(const TakePicture& take) = 0;

  Viewer& GetViewer() { return *viewer_; }

private:
  void NoteEvents();
  void DrawFrame(bool of_a_tick);

  std::string output_folder_;
  OutputFiles files_;
  std::string frames_;  // folder and first part of the name; empty: no pictures
  std::unique_ptr<FrameSchedule> schedule_;
  std::unique_ptr<Viewer> viewer_;
};

}  // namespace swarmanoid
