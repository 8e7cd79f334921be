#include "visualiser/ogre/ogre_window.h"

#include <OgreFont.h>
#include <OgreFontManager.h>
#include <OgreHardwarePixelBuffer.h>
#include <OgreOverlayManager.h>
#include <OgreOverlaySystem.h>
#include <OgreRenderTexture.h>
#include <OgreShadowCameraSetupPSSM.h>
#include <OgreTextureManager.h>
#include <OgreViewport.h>

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "visualiser/ogre/display.h"
#include "visualiser/panels/panels.h"
#include "visualiser/panels/theme.h"

namespace swarmanoid
{
namespace
{

constexpr const char* kOpenGl = "OpenGL 3+ Rendering Subsystem";
constexpr const char* kFontGroup = "Swarmanoid";
constexpr float kShadowReach = 40;  // m from the camera
constexpr Ogre::uint16 kShadowPixels = 1024;

int KeyOf(OgreBites::Keycode key)
{
  using namespace OgreBites;
  if (key >= SDLK_F1 && key <= SDLK_F12) return keys::kFunction + 1 + key - SDLK_F1;
  if (key >= 'a' && key <= 'z') return key - 'a' + 'A';
  if (key >= SDLK_KP_1 && key <= SDLK_KP_9) return '1' + key - SDLK_KP_1;
  switch (key)
  {
    case SDLK_ESCAPE:
      return keys::kEscape;
    case '\t':
      return keys::kTab;
    case SDLK_HOME:
      return keys::kHome;
    case SDLK_END:
      return keys::kEnd;
    case SDLK_LEFT:
      return keys::kLeft;
    case SDLK_RIGHT:
      return keys::kRight;
    case SDLK_UP:
      return keys::kUp;
    case SDLK_DOWN:
      return keys::kDown;
    case SDLK_PAGEUP:
      return keys::kPageUp;
    case SDLK_PAGEDOWN:
      return keys::kPageDown;
    case SDLK_KP_PLUS:
    case '+':
      return '=';
    case SDLK_KP_MINUS:
      return '-';
    case SDLK_KP_0:
      return '0';
    default:
      return key > 0 && key < 128 ? key : 0;
  }
}

MouseButton ButtonOf(unsigned char button)
{
  if (button == OgreBites::BUTTON_MIDDLE) return MouseButton::kMiddle;
  return button == OgreBites::BUTTON_RIGHT ? MouseButton::kRight : MouseButton::kLeft;
}

}  // namespace

OgreWindow::OgreWindow(const std::string& title, int width, int height, int samples)
    : OgreBites::ApplicationContext("swarmanoid"), title_(title), width_(width), height_(height), samples_(samples)
{
  if (Ogre::Root::getSingletonPtr() != nullptr)
    throw std::runtime_error(
        "a process has one ogre_render at most, since OGRE is in it once; without --single-process each visualisation "
        "has a process of its own");
  const std::shared_ptr<void> display = ConnectToDisplay();
  // The program itself handles Ctrl-C.
  setenv("SDL_NO_SIGNAL_HANDLERS", "1", 1);
  log_ = std::make_unique<Ogre::LogManager>();
  log_->createLog("", true, false, true);
  try
  {
    initApp();
  }
  catch (const Ogre::Exception& error)
  {
    throw std::runtime_error("ogre_render cannot open a window with OpenGL 3.3: " + error.getDescription());
  }
  addInputListener(this);
}

OgreWindow::~OgreWindow()
{
  target_.reset();
  imgui_input_.reset();
  try
  {
    closeApp();
  }
  catch (const std::exception&)
  {
    // The window is gone, so its errors do not matter.
  }
}

void OgreWindow::createRoot()
{
  mRoot = OGRE_NEW Ogre::Root("", "", "");
  mRoot->loadPlugin(OGRE_PLUGIN_FOLDER "/RenderSystem_GL3Plus");
  mOverlaySystem = OGRE_NEW Ogre::OverlaySystem();
}

bool OgreWindow::oneTimeConfig()
{
  Ogre::RenderSystem* system = mRoot->getRenderSystemByName(kOpenGl);
  if (system == nullptr) throw std::runtime_error("ogre_render: OGRE has no render system for OpenGL 3");
  mRoot->setRenderSystem(system);
  return true;
}

void OgreWindow::setup()
{
  mRoot->initialise(false);
  createWindow(title_, static_cast<uint32_t>(width_), static_cast<uint32_t>(height_),
               {{"FSAA", std::to_string(samples_)}, {"vsync", "No"}});
  locateResources();
  initialiseRTShaderSystem();
  loadResources();
  mRoot->addFrameListener(this);

  manager_ = mRoot->createSceneManager();
  manager_->addRenderQueueListener(mOverlaySystem);
  Ogre::RTShader::ShaderGenerator::getSingleton().addSceneManager(manager_);
  OpenImGui();
}

void OgreWindow::OpenImGui()
{
  auto* overlay = new Ogre::ImGuiOverlay();
  ImGui::GetIO().IniFilename = nullptr;  // ImGui must not write outside the run's folder
  ApplyTheme(1);
  if (const std::string file = PanelFont(); !file.empty())
  {
    const std::filesystem::path path(file);
    Ogre::ResourceGroupManager::getSingleton().addResourceLocation(path.parent_path().string(), "FileSystem",
                                                                   kFontGroup);
    const Ogre::FontPtr font = Ogre::FontManager::getSingleton().create("panels", kFontGroup);
    font->setType(Ogre::FT_TRUETYPE);
    font->setSource(path.filename().string());
    font->setTrueTypeSize(theme::kFontSize);
    font->setTrueTypeResolution(72);
    overlay->addFont("panels", kFontGroup);
  }
  overlay->setZOrder(300);
  overlay->show();
  Ogre::OverlayManager::getSingleton().addOverlay(overlay);
  imgui_input_ = std::make_unique<OgreBites::ImGuiInputListener>();
}

void OgreWindow::Show(Ogre::Camera* camera)
{
  Ogre::Viewport* viewport = getRenderWindow()->addViewport(camera);
  viewport->setBackgroundColour(Ogre::ColourValue(0.914F, 0.933F, 0.957F));

  manager_->setShadowTextureCountPerLightType(Ogre::Light::LT_DIRECTIONAL, 3);
  manager_->setShadowTextureSettings(kShadowPixels, 3, Ogre::PF_DEPTH16);
  manager_->setShadowTextureSelfShadow(true);
  manager_->setShadowCasterRenderBackFaces(true);
  manager_->setShadowFarDistance(kShadowReach);
  auto splits = std::make_shared<Ogre::PSSMShadowCameraSetup>();
  splits->calculateSplitPoints(3, 0.1F, kShadowReach);
  splits->setSplitPadding(0.1F);
  manager_->setShadowCameraSetup(splits);
}

void OgreWindow::SetShadows(bool on)
{
  if (on == shadows_) return;
  shadows_ = on;
  auto& generator = Ogre::RTShader::ShaderGenerator::getSingleton();
  const Ogre::String& scheme = Ogre::RTShader::ShaderGenerator::DEFAULT_SCHEME_NAME;
  Ogre::RTShader::RenderState* state = generator.getRenderState(scheme);
  if (on)
  {
    auto* setup = static_cast<Ogre::PSSMShadowCameraSetup*>(manager_->getShadowCameraSetup().get());
    auto* splits = static_cast<Ogre::RTShader::IntegratedPSSM3*>(
        generator.createSubRenderState(Ogre::RTShader::IntegratedPSSM3::Type));
    splits->setSplitPoints({setup->getSplitPoints().begin(), setup->getSplitPoints().end()});
    state->addTemplateSubRenderState(splits);
  }
  else
  {
    for (Ogre::RTShader::SubRenderState* part : state->getSubRenderStates())
      if (part->getType() == Ogre::RTShader::IntegratedPSSM3::Type)
      {
        state->removeSubRenderState(part);
        break;
      }
  }
  manager_->setShadowTechnique(on ? Ogre::SHADOWTYPE_TEXTURE_ADDITIVE_INTEGRATED : Ogre::SHADOWTYPE_NONE);
  generator.invalidateScheme(scheme);
}

bool OgreWindow::TakeEvents(Viewer& viewer)
{
  happened_ = std::exchange(released_late_, false);
  viewer_ = &viewer;
  pollEvents();
  viewer_ = nullptr;
  return happened_;
}

void OgreWindow::Present(Viewer& viewer, const std::function<void()>& panels)
{
  viewer_ = &viewer;
  panels_ = panels;
  mRoot->renderOneFrame();
  panels_ = nullptr;
  viewer_ = nullptr;
  pressed_ = 0;
  for (const OgreBites::MouseButtonEvent& event : early_releases_) imgui_input_->mouseReleased(event);
  released_late_ = !early_releases_.empty();
  early_releases_.clear();
}

// Events are taken before ImGui's frame begins, since ImGui treats a key that changes within a frame as an error.
bool OgreWindow::frameStarted(const Ogre::FrameEvent& event)
{
  const bool goes_on = OgreBites::ApplicationContext::frameStarted(event);
  Ogre::ImGuiOverlay::NewFrame();
  if (panels_) panels_();
  return goes_on;
}

Picture OgreWindow::TakePicture(Ogre::Camera* camera)
{
  const auto width = static_cast<Ogre::uint32>(Width());
  const auto height = static_cast<Ogre::uint32>(Height());
  if (!target_ || target_->getWidth() != width || target_->getHeight() != height)
  {
    if (target_) Ogre::TextureManager::getSingleton().remove(target_);
    target_ = Ogre::TextureManager::getSingleton().createManual(
        "swarmanoid/picture", kFontGroup, Ogre::TEX_TYPE_2D, width, height, 0, Ogre::PF_BYTE_RGBA,
        Ogre::TU_RENDERTARGET, nullptr, false, static_cast<Ogre::uint>(samples_));
    Ogre::RenderTexture* texture = target_->getBuffer()->getRenderTarget();
    texture->setAutoUpdated(false);
    Ogre::Viewport* viewport = texture->addViewport(camera);
    viewport->setBackgroundColour(getRenderWindow()->getViewport(0)->getBackgroundColour());
    viewport->setOverlaysEnabled(false);
  }
  target_->getBuffer()->getRenderTarget()->update();
  Picture picture{static_cast<int>(width), static_cast<int>(height), {}};
  picture.pixels.resize(std::size_t{4} * width * height);
  target_->getBuffer()->blitToMemory(Ogre::PixelBox(width, height, 1, Ogre::PF_BYTE_RGBA, picture.pixels.data()));
  return picture;
}

bool OgreWindow::keyPressed(const OgreBites::KeyboardEvent& event)
{
  happened_ = true;
  imgui_input_->keyPressed(event);
  ctrl_ = (event.keysym.mod & OgreBites::KMOD_CTRL) != 0;
  shift_ = (event.keysym.mod & OgreBites::KMOD_SHIFT) != 0;
  if (viewer_ == nullptr || (ImGui::GetIO().WantTextInput && !ctrl_)) return true;
  const KeyPress press{KeyOf(event.keysym.sym), ctrl_, shift_};
  if (press.key != 0 && (event.repeat == 0 || MayRepeat(press.key))) viewer_->Press(press);
  return true;
}

bool OgreWindow::keyReleased(const OgreBites::KeyboardEvent& event)
{
  happened_ = true;
  ctrl_ = (event.keysym.mod & OgreBites::KMOD_CTRL) != 0;
  shift_ = (event.keysym.mod & OgreBites::KMOD_SHIFT) != 0;
  if (viewer_ != nullptr) viewer_->Release(KeyOf(event.keysym.sym));
  return imgui_input_->keyReleased(event);
}

bool OgreWindow::mouseMoved(const OgreBites::MouseMotionEvent& event)
{
  happened_ = true;
  imgui_input_->mouseMoved(event);
  mouse_x_ = event.x;
  mouse_y_ = event.y;
  if (viewer_ != nullptr) viewer_->MouseMove(event.x, event.y);
  return true;
}

bool OgreWindow::mouseWheelRolled(const OgreBites::MouseWheelEvent& event)
{
  happened_ = true;
  imgui_input_->mouseWheelRolled(event);
  if (viewer_ != nullptr && !PanelAt(mouse_x_, mouse_y_)) viewer_->Wheel(event.y, mouse_x_, mouse_y_);
  return true;
}

bool OgreWindow::mousePressed(const OgreBites::MouseButtonEvent& event)
{
  happened_ = true;
  pressed_ |= 1U << event.button;
  imgui_input_->mousePressed(event);
  if (viewer_ != nullptr && !PanelAt(event.x, event.y))
    viewer_->MousePress(ButtonOf(event.button), event.x, event.y, ctrl_, shift_);
  return true;
}

bool OgreWindow::mouseReleased(const OgreBites::MouseButtonEvent& event)
{
  happened_ = true;
  if ((pressed_ & 1U << event.button) != 0)
    early_releases_.push_back(event);
  else
    imgui_input_->mouseReleased(event);
  if (viewer_ != nullptr) viewer_->MouseRelease(ButtonOf(event.button));
  return true;
}

bool OgreWindow::textInput(const OgreBites::TextInputEvent& event)
{
  happened_ = true;
  return imgui_input_->textInput(event);
}

}  // namespace swarmanoid
