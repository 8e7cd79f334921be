#include "visualiser/opengl/gl_window.h"

#include <fmt/format.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <stdexcept>

#include "visualiser/panels/panels.h"
#include "visualiser/panels/theme.h"

namespace swarmanoid
{
namespace
{

constexpr const char* kCure =
    "; it needs a display: run it on a desktop, or set DISPLAY, or use `ssh -X` or `xvfb-run -a`. image_render draws "
    "without one, and `swarmanoid run --no-visualisers` runs without any";

int open_windows = 0;

std::string LastError()
{
  const char* text = nullptr;
  glfwGetError(&text);
  return text == nullptr ? "no cause is given" : text;
}

// Letters follow the keyboard's layout.
int KeyOf(int key, int scancode)
{
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return keys::kFunction + 1 + key - GLFW_KEY_F1;
  if (key >= GLFW_KEY_A && key <= GLFW_KEY_Z)
  {
    const char* name = glfwGetKeyName(key, scancode);
    const bool letter = name != nullptr && name[0] >= 'a' && name[0] <= 'z' && name[1] == '\0';
    return letter ? name[0] - 'a' + 'A' : key;
  }
  switch (key)
  {
    case GLFW_KEY_ESCAPE:
      return keys::kEscape;
    case GLFW_KEY_TAB:
      return keys::kTab;
    case GLFW_KEY_HOME:
      return keys::kHome;
    case GLFW_KEY_END:
      return keys::kEnd;
    case GLFW_KEY_LEFT:
      return keys::kLeft;
    case GLFW_KEY_RIGHT:
      return keys::kRight;
    case GLFW_KEY_UP:
      return keys::kUp;
    case GLFW_KEY_DOWN:
      return keys::kDown;
    case GLFW_KEY_PAGE_UP:
      return keys::kPageUp;
    case GLFW_KEY_PAGE_DOWN:
      return keys::kPageDown;
    case GLFW_KEY_KP_ADD:
      return '=';
    case GLFW_KEY_KP_SUBTRACT:
      return '-';
    default:
      break;
  }
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return '0' + key - GLFW_KEY_KP_0;
  return key < 128 ? key : 0;
}

std::optional<MouseButton> ButtonOf(int button)
{
  if (button == GLFW_MOUSE_BUTTON_LEFT) return MouseButton::kLeft;
  if (button == GLFW_MOUSE_BUTTON_RIGHT) return MouseButton::kRight;
  if (button == GLFW_MOUSE_BUTTON_MIDDLE) return MouseButton::kMiddle;
  return std::nullopt;
}

}  // namespace

// The callbacks of GLFW. ImGui's context follows the window of the event.
struct GlWindow::Callbacks
{
  static GlWindow& Of(GLFWwindow* window)
  {
    auto& self = *static_cast<GlWindow*>(glfwGetWindowUserPointer(window));
    self.happened_ = true;
    ImGui::SetCurrentContext(self.imgui_);
    return self;
  }

  static void Key(GLFWwindow* window, int key, int scancode, int action, int mods)
  {
    GlWindow& self = Of(window);
    ImGui_ImplGlfw_KeyCallback(window, key, scancode, action, mods);
    const bool ctrl = (mods & GLFW_MOD_CONTROL) != 0;
    if (self.viewer_ != nullptr && action == GLFW_RELEASE) self.viewer_->Release(KeyOf(key, scancode));
    if (self.viewer_ == nullptr || action == GLFW_RELEASE || (ImGui::GetIO().WantTextInput && !ctrl)) return;
    const KeyPress press{KeyOf(key, scancode), ctrl, (mods & GLFW_MOD_SHIFT) != 0};
    if (press.key != 0 && (action == GLFW_PRESS || MayRepeat(press.key))) self.viewer_->Press(press);
  }

  static void Char(GLFWwindow* window, unsigned int letter)
  {
    Of(window);
    ImGui_ImplGlfw_CharCallback(window, letter);
  }

  static void Button(GLFWwindow* window, int button, int action, int mods)
  {
    GlWindow& self = Of(window);
    ImGui_ImplGlfw_MouseButtonCallback(window, button, action, mods);
    const std::optional<MouseButton> which = ButtonOf(button);
    if (self.viewer_ == nullptr || !which) return;
    if (action == GLFW_RELEASE)
      self.viewer_->MouseRelease(*which);
    else if (!PanelAt(self.mouse_x_, self.mouse_y_))
      self.viewer_->MousePress(*which, self.mouse_x_, self.mouse_y_, (mods & GLFW_MOD_CONTROL) != 0,
                               (mods & GLFW_MOD_SHIFT) != 0);
  }

  static void Move(GLFWwindow* window, double x, double y)
  {
    GlWindow& self = Of(window);
    self.mouse_x_ = x;
    self.mouse_y_ = y;
    if (self.viewer_ != nullptr) self.viewer_->MouseMove(x, y);
  }

  static void Scroll(GLFWwindow* window, double right, double up)
  {
    GlWindow& self = Of(window);
    ImGui_ImplGlfw_ScrollCallback(window, right, up);
    if (self.viewer_ != nullptr && !PanelAt(self.mouse_x_, self.mouse_y_))
      self.viewer_->Wheel(up, self.mouse_x_, self.mouse_y_);
  }

  static void Focus(GLFWwindow* window, int focused)
  {
    Of(window);
    ImGui_ImplGlfw_WindowFocusCallback(window, focused);
  }

  static void Enter(GLFWwindow* window, int entered)
  {
    Of(window);
    ImGui_ImplGlfw_CursorEnterCallback(window, entered);
  }

  static void Refresh(GLFWwindow* window) { Of(window); }
  static void Resize(GLFWwindow* window, int, int) { Of(window).ReadSize(); }
};

GlWindow::GlWindow(const std::string& title, int width, int height)
{
  if (open_windows == 0 && glfwInit() != GLFW_TRUE)
    throw std::runtime_error("opengl_render cannot open a window: " + LastError() + kCure);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_FALSE);
  window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
  if (window_ == nullptr)
  {
    const std::string cause = LastError();
    if (open_windows == 0) glfwTerminate();
    throw std::runtime_error("opengl_render cannot open a window with OpenGL 3.3: " + cause + kCure);
  }
  ++open_windows;
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(0);  // the run waits for pictures, never for the screen's refresh
  float horizontal = 1;
  glfwGetWindowContentScale(window_, &horizontal, &scale_);
  OpenImGui();
  ReadSize();
}

GlWindow::~GlWindow()
{
  MakeCurrent();
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext(imgui_);
  glfwDestroyWindow(window_);
  if (--open_windows == 0) glfwTerminate();
}

void GlWindow::OpenImGui()
{
  IMGUI_CHECKVERSION();
  imgui_ = ImGui::CreateContext();
  ImGui::SetCurrentContext(imgui_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // ImGui must not write outside the run's folder
  ApplyTheme(scale_);
  if (const std::string font = PanelFont(); !font.empty())
    io.Fonts->AddFontFromFileTTF(font.c_str(), theme::kFontSize * scale_);
  ImGui_ImplGlfw_InitForOpenGL(window_, false);
  ImGui_ImplOpenGL3_Init("#version 330 core");
  glfwSetWindowUserPointer(window_, this);
  glfwSetKeyCallback(window_, Callbacks::Key);
  glfwSetCharCallback(window_, Callbacks::Char);
  glfwSetMouseButtonCallback(window_, Callbacks::Button);
  glfwSetCursorPosCallback(window_, Callbacks::Move);
  glfwSetScrollCallback(window_, Callbacks::Scroll);
  glfwSetWindowFocusCallback(window_, Callbacks::Focus);
  glfwSetCursorEnterCallback(window_, Callbacks::Enter);
  glfwSetWindowRefreshCallback(window_, Callbacks::Refresh);
  glfwSetFramebufferSizeCallback(window_, Callbacks::Resize);
}

void GlWindow::ReadSize()
{
  glfwGetWindowSize(window_, &width_, &height_);
  glfwGetFramebufferSize(window_, &pixel_width_, &pixel_height_);
}

bool GlWindow::PollEvents(Viewer& viewer)
{
  happened_ = false;
  viewer_ = &viewer;
  glfwPollEvents();
  viewer_ = nullptr;
  return happened_;
}

void GlWindow::MakeCurrent() const
{
  glfwMakeContextCurrent(window_);
  ImGui::SetCurrentContext(imgui_);
}

void GlWindow::Present(const std::function<void()>& panels)
{
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  panels();
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glfwSwapBuffers(window_);
}

bool GlWindow::WantsToClose() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }

bool GlWindow::IsVisible() const
{
  return pixel_width_ > 0 && pixel_height_ > 0 && glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == GLFW_FALSE;
}

}  // namespace swarmanoid
