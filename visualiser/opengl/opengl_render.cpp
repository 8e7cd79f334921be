#include "visualiser/opengl/opengl_render.h"

#include <algorithm>

#include "common/logging/log.h"
#include "visualiser/gl/quality.h"
#include "visualiser/renderer_library.h"
#include "visualiser/scene/enlargement.h"

namespace swarmanoid
{

COpenGlRender::~COpenGlRender()
{
  // Objects of the window's context must be deleted while it is current.
  if (window_ != nullptr) window_->MakeCurrent();
}

void COpenGlRender::Open(const std::string& title, int width, int height, const Parameters& parameters)
{
  samples_ = DrawOptionsOf(parameters).samples;
  window_ = std::make_unique<GlWindow>(title, width, height);
  renderer_ = std::make_unique<GlScene>();
  target_ = std::make_unique<PictureTarget>();
  panels_ = std::make_unique<Panels>(GetViewer(), window_->Scale());
  LogInfo("window '{}' is open, drawn by {}", title, GlScene::ContextDescription());
}

void COpenGlRender::Show(const TakePicture& take)
{
  Viewer& viewer = GetViewer();
  window_->MakeCurrent();
  viewer.SetSize(window_->Width(), window_->Height(), panels_->Hidden());
  const Scene& scene = viewer.Refresh();
  DrawOptions options{viewer.shown.shadows, viewer.shown.textures, samples_, true};
  options.says_enlargement = take != nullptr;  // a panel says it otherwise
  const int width = std::max(window_->PixelWidth(), 1);
  const int height = std::max(window_->PixelHeight(), 1);

  if (take)
  {
    // The picture is drawn into a separate buffer, since the window may be covered.
    target_->Resize(width, height, 0);
    renderer_->Draw(scene, viewer.camera, target_->Framebuffer(), width, height, options);
    take(ReadPicture(target_->Framebuffer(), width, height));
    glBindFramebuffer(GL_READ_FRAMEBUFFER, target_->Framebuffer());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
    glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
  }
  else
    renderer_->Draw(scene, viewer.camera, 0, width, height, options);
  viewer.note = EnlargementText(renderer_->Statistics().enlargement);
  window_->Present([&] { panels_->Show(static_cast<float>(window_->Width()), static_cast<float>(window_->Height())); });
}

}  // namespace swarmanoid

EXPORT_RENDERER(swarmanoid::COpenGlRender)
