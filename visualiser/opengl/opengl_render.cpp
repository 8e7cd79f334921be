#include "visualiser/opengl/opengl_render.h"

#include <fmt/format.h>

#include <filesystem>

#include "common/logging/log.h"
#include "visualiser/gl/quality.h"
#include "visualiser/renderer_library.h"

namespace swarmanoid
{
namespace
{

constexpr int kSmallest = 160;
constexpr int kLargest = 16384;

}  // namespace

COpenGlRender::~COpenGlRender()
{
  // What lives in the window's context goes while that is current.
  if (window_ != nullptr) window_->MakeCurrent();
}

void COpenGlRender::Init(const RenderSetup& setup)
{
  const Parameters& parameters = setup.parameters;
  const Vector2 size = parameters.Vector2Of("window_size");
  if (size.minCoeff() < kSmallest || size.maxCoeff() > kLargest || size != Vector2(size.array().round()))
    throw ConfigurationError(parameters.Tree().ValueLocation("window_size"),
                             fmt::format("window_size is {}, {}; width and height are whole numbers from {} to {}",
                                         size.x(), size.y(), kSmallest, kLargest));
  output_folder_ = setup.output_folder;
  const bool write_frames = parameters.Boolean("write_frames");
  if (write_frames)
    frames_ =
        (std::filesystem::path(output_folder_) / parameters.Text("frame_directory") / parameters.Text("frame_filename"))
            .string();
  schedule_ = std::make_unique<FrameSchedule>(static_cast<std::uint64_t>(parameters.Integer("every")),
                                              parameters.Number("max_frame_rate"), write_frames);
  samples_ = DrawOptionsOf(parameters).samples;

  // Mistakes in viewpoints are found before a window opens.
  viewer_ = std::make_unique<Viewer>(setup, static_cast<int>(size.x()), static_cast<int>(size.y()));
  std::string title = parameters.Text("window_title");
  if (title.empty()) title = setup.space.GetExperiment().name;
  window_ = std::make_unique<GlWindow>(title, static_cast<int>(size.x()), static_cast<int>(size.y()));
  renderer_ = std::make_unique<GlScene>();
  target_ = std::make_unique<PictureTarget>();
  panels_ = std::make_unique<Panels>(*viewer_, window_->Scale());
  viewer_->shown.panels = parameters.Boolean("show_panels");
  LogInfo("window '{}' is open, drawn by {}", title, GlScene::ContextDescription());
  viewer_->Say("F1 lists the keys");
}

double COpenGlRender::Now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void COpenGlRender::TakeEvents()
{
  if (window_->PollEvents(*viewer_)) schedule_->Activity(Now());
}

void COpenGlRender::Draw()
{
  TakeEvents();
  viewer_->StateCame();
  if (schedule_->AtTick(viewer_->Space().GetTick(), Now())) DrawFrame(true);
}

void COpenGlRender::Idle()
{
  TakeEvents();
  if (schedule_->AtIdle(Now())) DrawFrame(false);
}

void COpenGlRender::DrawFrame(bool of_a_tick)
{
  schedule_->Drawn(Now());
  const bool write_frame = of_a_tick && !frames_.empty();
  const bool write_picture = viewer_->TakePictureWish();
  if (!window_->IsVisible() && !write_frame && !write_picture) return;
  window_->MakeCurrent();
  viewer_->SetSize(window_->Width(), window_->Height(), panels_->LeftColumn());
  const Scene& scene = viewer_->Refresh();
  const DrawOptions options{viewer_->shown.shadows, viewer_->shown.textures, samples_, true};
  const int width = std::max(window_->PixelWidth(), 1);
  const int height = std::max(window_->PixelHeight(), 1);

  if (write_frame || write_picture)
  {
    // By way of a buffer of our own: a window may be covered.
    target_->Resize(width, height, 0);
    renderer_->Draw(scene, viewer_->camera, target_->Framebuffer(), width, height, options);
    const Picture picture = ReadPicture(target_->Framebuffer(), width, height);
    const std::uint64_t tick = viewer_->Space().GetTick();
    if (write_frame) WritePicture(fmt::format("{}_{:06}.png", frames_, tick), picture);
    if (write_picture)
    {
      const std::string path = fmt::format("{}/picture_{:06}.png", output_folder_, tick);
      WritePicture(path, picture);
      viewer_->Say("written: " + path);
    }
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target_->Framebuffer());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
  }
  else
    renderer_->Draw(scene, viewer_->camera, 0, width, height, options);
  window_->Present([&] { panels_->Show(static_cast<float>(window_->Width()), static_cast<float>(window_->Height())); });
}

void COpenGlRender::WritePicture(const std::string& path, const Picture& picture)
{
  std::error_code ignored;  // what cannot be made cannot be written to either, and that is reported
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), ignored);
  WritePng(picture, path);
}

}  // namespace swarmanoid

EXPORT_RENDERER(swarmanoid::COpenGlRender)
