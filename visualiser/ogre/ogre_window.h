// A window of OGRE: root, render system, shader generator, shadows, and the Dear ImGui of its overlay. Its keys and
// mouse go to the panels or to a Viewer. ogre_render uses it in the main thread; a process has at most one.
#pragma once

#include <OgreApplicationContext.h>
#include <OgreImGuiInputListener.h>
#include <OgreImGuiOverlay.h>
#include <OgreLogManager.h>
#include <OgreRTShaderSystem.h>
#include <OgreRenderWindow.h>
#include <OgreRoot.h>
#include <OgreSceneManager.h>
#include <OgreTexture.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "visualiser/interaction/viewer.h"
#include "visualiser/scene/drawn_picture.h"

namespace swarmanoid
{

class OgreWindow : public OgreBites::ApplicationContext, public OgreBites::InputListener
{
public:
  // Throws std::runtime_error, saying what is missing, if there is no display or no OpenGL 3.3.
  OgreWindow(const std::string& title, int width, int height, int samples);
  ~OgreWindow() override;

  Ogre::SceneManager& Manager() { return *manager_; }
  // Makes the window show the view of this camera.
  void Show(Ogre::Camera* camera);
  void SetShadows(bool on);
  // Passes the events since the last call to the viewer. Returns true if there were any.
  bool TakeEvents(Viewer& viewer);
  // Draws the window again, with the content of `panels` over it.
  void Present(Viewer& viewer, const std::function<void()>& panels);
  // Returns the same picture without panels.
  Picture TakePicture(Ogre::Camera* camera);

  bool WantsToClose() const { return getRoot()->endRenderingQueued(); }
  int Width() const { return static_cast<int>(getRenderWindow()->getWidth()); }
  int Height() const { return static_cast<int>(getRenderWindow()->getHeight()); }

private:
  // These functions override ApplicationContext.
  void createRoot() override;
  bool oneTimeConfig() override;
  void setup() override;
  bool frameStarted(const Ogre::FrameEvent& event) override;

  // These functions override InputListener.
  bool keyPressed(const OgreBites::KeyboardEvent& event) override;
  bool keyReleased(const OgreBites::KeyboardEvent& event) override;
  bool mouseMoved(const OgreBites::MouseMotionEvent& event) override;
  bool mouseWheelRolled(const OgreBites::MouseWheelEvent& event) override;
  bool mousePressed(const OgreBites::MouseButtonEvent& event) override;
  bool mouseReleased(const OgreBites::MouseButtonEvent& event) override;
  bool textInput(const OgreBites::TextInputEvent& event) override;

  void OpenImGui();

  std::string title_;
  int width_, height_, samples_;
  std::unique_ptr<Ogre::LogManager> log_;  // made before the root, which would write a file otherwise
  Ogre::SceneManager* manager_ = nullptr;
  std::unique_ptr<OgreBites::ImGuiInputListener> imgui_input_;
  std::function<void()> panels_;
  Viewer* viewer_ = nullptr;  // set while events are taken
  bool happened_ = false;
  // Buttons pressed since the last frame, and releases that came before it. ImGui sees a click only if a frame lies
  // between the two.
  unsigned pressed_ = 0;
  std::vector<OgreBites::MouseButtonEvent> early_releases_;
  bool released_late_ = false;
  bool shadows_ = false;
  bool ctrl_ = false, shift_ = false;
  int mouse_x_ = 0, mouse_y_ = 0;
  Ogre::TexturePtr target_;  // the target of written pictures
};

}  // namespace swarmanoid
