#include "visualiser/ogre/ogre_render.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "common/logging/log.h"
#include "visualiser/panels/theme.h"
#include "visualiser/renderer_library.h"

namespace swarmanoid
{
namespace
{

constexpr int kSmallest = 160;
constexpr int kLargest = 16384;

double Now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

void COgreRender::Init(const RenderSetup& setup)
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
  const auto width = static_cast<int>(size.x());
  const auto height = static_cast<int>(size.y());
  // Mistakes in viewpoints are found before a window opens.
  viewer_ = std::make_unique<Viewer>(setup, width, height);
  std::string title = parameters.Text("window_title");
  if (title.empty()) title = setup.space.GetExperiment().name;
  window_ = std::make_unique<OgreWindow>(title, width, height, static_cast<int>(parameters.Integer("antialiasing")));
  scene_ = std::make_unique<OgreScene>(window_->Manager(), viewer_->Refresh());
  window_->Show(scene_->OgreCamera());
  panels_ = std::make_unique<Panels>(*viewer_, 1.0F);
  viewer_->shown.panels = parameters.Boolean("show_panels");
  LogInfo("window '{}' is open, drawn by OGRE", title);
  viewer_->Say("F1 lists the keys");
}

void COgreRender::TakeEvents()
{
  if (window_->TakeEvents(*viewer_)) schedule_->Activity(Now());
}

void COgreRender::Draw()
{
  TakeEvents();
  viewer_->StateCame();
  if (schedule_->AtTick(viewer_->Space().GetTick(), Now())) DrawFrame(true);
}

void COgreRender::Idle()
{
  TakeEvents();
  if (schedule_->AtIdle(Now())) DrawFrame(false);
}

void COgreRender::DrawFrame(bool of_a_tick)
{
  schedule_->Drawn(Now());
  viewer_->SetSize(window_->Width(), window_->Height(), panels_->LeftColumn());
  const Scene& scene = viewer_->Refresh();
  window_->SetShadows(viewer_->shown.shadows);
  scene_->Update(scene, viewer_->camera, window_->Height(), viewer_->shown.textures);

  const std::uint64_t tick = viewer_->Space().GetTick();
  if (of_a_tick && !frames_.empty()) WritePicture(fmt::format("{}_{:06}.png", frames_, tick));
  if (viewer_->TakePictureWish())
  {
    const std::string path = fmt::format("{}/picture_{:06}.png", output_folder_, tick);
    WritePicture(path);
    viewer_->Say("written: " + path);
  }
  window_->Present(*viewer_, [&] { ShowPanels(scene); });
}

void COgreRender::ShowPanels(const Scene& scene)
{
  const auto width = static_cast<float>(window_->Width());
  const auto height = static_cast<float>(window_->Height());
  for (const SceneLabel& label : scene.Labels())
  {
    const Vector3 place = viewer_->camera.Project(label.position.cast<double>(), width, height);
    if (place.z() <= 0) continue;
    const ImVec2 size = ImGui::CalcTextSize(label.text.data(), label.text.data() + label.text.size());
    ImGui::GetBackgroundDrawList()->AddText(
        {static_cast<float>(place.x()) - size.x / 2, static_cast<float>(place.y()) - size.y}, theme::kText,
        label.text.data(), label.text.data() + label.text.size());
  }
  panels_->Show(width, height);
}

void COgreRender::WritePicture(const std::string& path)
{
  std::error_code ignored;  // what cannot be made cannot be written to either, and that is reported
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), ignored);
  WritePng(window_->TakePicture(scene_->OgreCamera()), path);
}

}  // namespace swarmanoid

EXPORT_RENDERER(swarmanoid::COgreRender)
