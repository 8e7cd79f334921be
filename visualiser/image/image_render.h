// image_render: pictures and videos without a window. It draws at chosen ticks; the video runs in simulated time.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "visualiser/gl/gl_scene.h"
#include "visualiser/image/offscreen_context.h"
#include "visualiser/image/video_writer.h"
#include "visualiser/render.h"

namespace swarmanoid
{

class CImageRender : public CRender
{
public:
  ~CImageRender() override;
  void Init(const RenderSetup& setup) override;
  void Draw() override;
  bool Terminate() override { return stop_ && done_; }
  void Finish() override;

private:
  void ReadTicks(const Parameters& parameters);
  void ReadOutputs(const RenderSetup& setup);
  void NameOwners(const RenderSetup& setup);
  std::string Caption(std::uint64_t tick) const;
  void Write(const Picture& picture, std::uint64_t tick);

  const CSwarmanoidSpace* space_ = nullptr;
  int width_ = 0, height_ = 0;
  Camera camera_;
  DrawOptions draw_options_;
  SceneOptions scene_options_;
  RunMonitor* monitor_ = nullptr;  // not null if the pictures show the status of the run
  bool show_clock_ = false;
  std::string scale_;               // the distance of the floor's lines, if the pictures show it
  std::vector<std::string> names_;  // names of the entities and their owners
  std::uint64_t every_ = 1;
  std::uint64_t next_ = 0;  // the next picture is drawn at this tick or the first later one
  std::uint64_t last_ = 0;
  bool stop_ = false;
  bool done_ = false;
  double speed_ = 1;

  OutputFiles files_;
  std::string file_;                          // empty: none
  std::string numbered_;                      // folder and first part of the name; empty: none
  std::string video_;                         // empty: none
  std::optional<std::uint64_t> video_start_;  // tick

  // The order is that of their dependencies.
  std::unique_ptr<OffscreenContext> context_;
  std::unique_ptr<PictureBuffer> buffer_;
  std::unique_ptr<Scene> scene_;
  std::unique_ptr<GlScene> renderer_;
  std::unique_ptr<VideoWriter> video_writer_;
};

}  // namespace swarmanoid
