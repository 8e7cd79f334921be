#include "visualiser/interaction/window_render.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include "common/space/space.h"

namespace swarmanoid
{
namespace
{

constexpr int kSmallest = 160;
constexpr int kLargest = 16384;

double Now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

std::string Numbered(const std::string& name, std::uint64_t tick) { return fmt::format("{}_{:06}.png", name, tick); }

void WriteWithFolder(const std::string& path, const Picture& picture)
{
  std::error_code ignored;  // a folder that cannot be made gives an error at the file
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), ignored);
  WritePng(picture, path);
}

}  // namespace

void WindowRender::Init(const RenderSetup& setup)
{
  const Parameters& parameters = setup.parameters;
  const Vector2 size = parameters.Vector2Of("window_size");
  if (size.minCoeff() < kSmallest || size.maxCoeff() > kLargest || size != Vector2(size.array().round()))
    throw ConfigurationError(parameters.Tree().ValueLocation("window_size"),
                             fmt::format("window_size is {}, {}; width and height are whole numbers from {} to {}",
                                         size.x(), size.y(), kSmallest, kLargest));
  output_folder_ = setup.output_folder;
  const bool write_frames = parameters.Boolean("write_frames");
  files_ = setup.Files();
  if (write_frames)
  {
    frames_ = (std::filesystem::path(parameters.Text("frame_directory")) / parameters.Text("frame_filename")).string();
    setup.CheckFile("frame_directory", Numbered(frames_, 0));
  }
  schedule_ = std::make_unique<FrameSchedule>(static_cast<std::uint64_t>(parameters.Integer("every")),
                                              parameters.Number("max_frame_rate"), write_frames);

  // Mistakes in viewpoints are found before a window opens.
  const auto width = static_cast<int>(size.x());
  const auto height = static_cast<int>(size.y());
  viewer_ = std::make_unique<Viewer>(setup, width, height);
  std::string title = parameters.Text("window_title");
  if (title.empty()) title = setup.space.GetExperiment().name;
  Open(title, width, height, parameters);
  viewer_->shown.panels = parameters.Boolean("show_panels");
  viewer_->Say("F1 lists the keys");
}

void WindowRender::NoteEvents()
{
  const bool acted = TakeEvents();
  if (viewer_->FollowPast() || acted) schedule_->Activity(Now());
}

void WindowRender::Draw()
{
  NoteEvents();
  viewer_->StateCame();
  if (schedule_->AtTick(viewer_->Present().GetTick(), Now())) DrawFrame(true);
}

void WindowRender::Idle()
{
  NoteEvents();
  if (schedule_->AtIdle(Now())) DrawFrame(false);
}

void WindowRender::DrawFrame(bool of_a_tick)
{
  schedule_->Drawn(Now());
  const bool write_frame = of_a_tick && !frames_.empty();
  const bool write_picture = viewer_->TakePictureRequest();
  if (!write_frame && !write_picture)
  {
    if (WindowIsVisible()) Show({});
    return;
  }
  Show(
      [&](const Picture& picture)
      {
        const std::uint64_t tick = viewer_->Space().GetTick();
        if (write_frame) WritePng(picture, files_.Claim(Numbered(frames_, tick)));
        if (!write_picture) return;
        const std::string path = fmt::format("{}/picture_{:06}.png", output_folder_, tick);
        WriteWithFolder(path, picture);
        viewer_->Say("written: " + path);
      });
}

}  // namespace swarmanoid
