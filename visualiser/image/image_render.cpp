// Pictures are drawn at ticks on a grid of `every` ticks from the first one on; ticks in between cost nothing, unless
// trails are drawn, which need every tick. A visualiser that is attached may miss a tick of the grid, and then the next
// tick is drawn and the grid goes on. Names of files and size are checked before the run, so that a long run does not
// end without its pictures.
#include "visualiser/image/image_render.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "common/space/space.h"
#include "visualiser/gl/quality.h"
#include "visualiser/renderer_library.h"
#include "visualiser/scene/floor_grid.h"
#include "visualiser/scene/viewpoints.h"
#include "visualiser/status_line.h"

namespace swarmanoid
{
namespace
{

constexpr int kSmallest = 16;
constexpr int kLargest = 16384;
constexpr float kHeightOfPlainText = 1080;  // pixels; texts grow with larger pictures
constexpr std::uint64_t kNever = std::numeric_limits<std::uint64_t>::max();

std::string Numbered(const std::string& name, std::uint64_t tick) { return fmt::format("{}_{:06}.png", name, tick); }

}  // namespace

CImageRender::~CImageRender()
{
  if (context_ != nullptr) context_->MakeCurrent();
}

void CImageRender::Init(const RenderSetup& setup)
{
  const Parameters& parameters = setup.parameters;
  space_ = &setup.space;
  const Vector2 size = parameters.Vector2Of("size");
  if (size.minCoeff() < kSmallest || size.maxCoeff() > kLargest || size != Vector2(size.array().round()))
    throw ConfigurationError(parameters.Tree().ValueLocation("size"),
                             fmt::format("size is {}, {}; width and height are whole numbers from {} to {}", size.x(),
                                         size.y(), kSmallest, kLargest));
  width_ = static_cast<int>(size.x());
  height_ = static_cast<int>(size.y());
  ReadTicks(parameters);

  const Viewpoints viewpoints(parameters);
  const double aspect = size.x() / size.y();
  const std::string camera = parameters.Text("camera");
  if (!camera.empty())
    camera_ =
        CameraFromText(camera, viewpoints, space_->GetExperiment(), aspect, parameters.Tree().ValueLocation("camera"));
  else
    camera_ = viewpoints.First().value_or(DefaultView(space_->GetExperiment(), aspect));
  draw_options_ = DrawOptionsOf(parameters);
  draw_options_.says_enlargement = true;
  scene_options_ = SceneOptionsOf(parameters);
  if (parameters.Boolean("show_owners")) NameOwners(setup);
  if (parameters.Boolean("show_status")) monitor_ = setup.monitor;
  show_clock_ = parameters.Boolean("show_clock");
  if (parameters.Boolean("show_scale"))
  {
    if (!draw_options_.textures)
      throw ConfigurationError(
          parameters.Tree().ValueLocation("show_scale"),
          "show_scale gives the distance of the floor's lines, but use_textures=\"false\" draws none");
    scale_ = fmt::format("{} m between lines", FloorSpacing(space_->GetExperiment().arena_size));
  }

  scene_ = std::make_unique<Scene>(*space_);
  context_ = std::make_unique<OffscreenContext>();
  buffer_ = std::make_unique<PictureBuffer>(width_, height_);
  renderer_ = std::make_unique<GlScene>(std::max(1.0F, static_cast<float>(height_) / kHeightOfPlainText));
  ReadOutputs(setup);
}

// Sets names such as "fb_1: engine 'ground', controller host 0".
void CImageRender::NameOwners(const RenderSetup& setup)
{
  for (std::size_t e = 0; e < space_->Size(); ++e)
  {
    std::string owners = OwnerName(space_->GetExperiment(), setup.assignment, e);
    const std::string host = HostNameOf(setup.assignment, e);
    if (!owners.empty() && !host.empty()) owners += ", ";
    owners += host;
    const std::string& id = space_->GetEntity(e).GetId();
    names_.push_back(owners.empty() ? id : id + ": " + owners);
  }
  scene_options_.names = names_;
  scene_options_.ids = true;
}

void CImageRender::ReadTicks(const Parameters& parameters)
{
  every_ = static_cast<std::uint64_t>(parameters.Integer("every"));
  next_ = static_cast<std::uint64_t>(parameters.Integer("from"));
  last_ = static_cast<std::uint64_t>(parameters.Integer("to"));
  stop_ = parameters.Boolean("stop");
  speed_ = parameters.Number("speed");
  if (last_ == 0) last_ = kNever;
  if (const long long at = parameters.Integer("at"); at >= 0) next_ = last_ = static_cast<std::uint64_t>(at);
  if (last_ < next_)
    throw ConfigurationError(
        parameters.Tree().ValueLocation("to"),
        fmt::format("to is {}, but the pictures start from {}; it must be the later tick", last_, next_));
}

void CImageRender::ReadOutputs(const RenderSetup& setup)
{
  const Parameters& parameters = setup.parameters;
  const std::string file = parameters.Text("file");
  const std::string video = parameters.Text("video");
  std::string directory = parameters.Text("directory");
  if (file.empty() && video.empty() && directory.empty()) directory = "frames";
  files_ = setup.Files();
  file_ = file;
  if (!file.empty()) setup.CheckFile("file", file);
  if (!directory.empty())
  {
    numbered_ = (std::filesystem::path(directory) / parameters.Text("filename")).string();
    setup.CheckFile("directory", Numbered(numbered_, next_));
  }
  if (video.empty()) return;
  video_ = setup.MakeOutputFile("video");
  const double seconds = static_cast<double>(every_) * space_->GetTickSeconds() / speed_;
  video_writer_ = std::make_unique<VideoWriter>(video_, width_, height_, seconds);
}

void CImageRender::Draw()
{
  const std::uint64_t tick = space_->GetTick();
  if (scene_options_.trails && !done_) scene_->Track();
  if (done_ || tick < next_) return;
  scene_->Update(scene_options_);
  draw_options_.caption = Caption(tick);
  context_->MakeCurrent();
  renderer_->Draw(*scene_, camera_, buffer_->Framebuffer(), width_, height_, draw_options_);
  Write(buffer_->Read(), tick);

  // Pictures are at multiples of `every` from the first tick on. An attached visualiser may have missed some.
  next_ += ((tick - next_) / every_ + 1) * every_;
  done_ = next_ > last_;
}

std::string CImageRender::Caption(std::uint64_t tick) const
{
  std::vector<std::string> parts;
  if (show_clock_) parts.push_back(fmt::format("{:.1f} s", static_cast<double>(tick) * space_->GetTickSeconds()));
  if (!scale_.empty()) parts.push_back(scale_);
  if (monitor_ != nullptr)
  {
    RunStatus status = monitor_->Status();
    status.tick = tick;
    const bool is_known = status.phase != RunStatus::Phase::kUnknown;
    parts.push_back(is_known ? StatusLine(status) : fmt::format("tick {}", tick));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

void CImageRender::Write(const Picture& picture, std::uint64_t tick)
{
  if (!file_.empty()) WritePng(picture, files_.Claim(file_));
  if (!numbered_.empty()) WritePng(picture, files_.Claim(Numbered(numbered_, tick)));
  if (video_writer_ == nullptr) return;
  if (!video_start_) video_start_ = tick;
  video_writer_->Add(picture, static_cast<double>(tick - *video_start_) * space_->GetTickSeconds() / speed_);
}

void CImageRender::Finish()
{
  if (video_writer_ != nullptr) video_writer_->Finish();
}

}  // namespace swarmanoid

EXPORT_RENDERER(swarmanoid::CImageRender)
