#include "visualiser/ogre/ogre_render.h"

#include "common/logging/log.h"
#include "visualiser/panels/theme.h"
#include "visualiser/renderer_library.h"
#include "visualiser/scene/enlargement.h"

namespace swarmanoid
{

void COgreRender::Open(const std::string& title, int width, int height, const Parameters& parameters)
{
  window_ = std::make_unique<OgreWindow>(title, width, height, static_cast<int>(parameters.Integer("antialiasing")));
  scene_ = std::make_unique<OgreScene>(window_->Manager(), GetViewer().Refresh());
  window_->Show(scene_->OgreCamera());
  panels_ = std::make_unique<Panels>(GetViewer(), 1.0F);
  LogInfo("window '{}' is open, drawn by OGRE", title);
}

void COgreRender::Show(const TakePicture& take)
{
  Viewer& viewer = GetViewer();
  viewer.SetSize(window_->Width(), window_->Height(), panels_->Hidden());
  const Scene& scene = viewer.Refresh();
  window_->SetShadows(viewer.shown.shadows);
  scene_->Update(scene, viewer.camera, window_->Height(), viewer.shown.textures);
  viewer.note = EnlargementText(scene_->MostEnlargement());
  if (take) take(window_->TakePicture(scene_->OgreCamera()));
  window_->Present(viewer, [&] { ShowPanels(scene); });
}

namespace
{

ImU32 WindowColour(Colour colour, float opacity)
{
  return IM_COL32(colour >> 16 & 0xff, colour >> 8 & 0xff, colour & 0xff, static_cast<int>(opacity * 255));
}

}  // namespace

void COgreRender::ShowPanels(const Scene& scene)
{
  const auto width = static_cast<float>(window_->Width());
  const auto height = static_cast<float>(window_->Height());
  for (const SceneLabel& label : scene.Labels())
  {
    const Vector3 place = GetViewer().camera.Project(label.position.cast<double>(), width, height);
    if (place.z() <= 0) continue;
    const ImVec2 size = ImGui::CalcTextSize(label.text.data(), label.text.data() + label.text.size());
    ImGui::GetBackgroundDrawList()->AddText(
        {static_cast<float>(place.x()) - size.x / 2, static_cast<float>(place.y()) - size.y}, theme::kText,
        label.text.data(), label.text.data() + label.text.size());
  }
  for (const DrawnMarks::Dot& dot : scene.Drawn().dots)
  {
    const Vector3 place = GetViewer().camera.Project(dot.place.cast<double>(), width, height);
    if (place.z() > 0)
      ImGui::GetBackgroundDrawList()->AddCircleFilled({static_cast<float>(place.x()), static_cast<float>(place.y())},
                                                      dot.diameter / 2, WindowColour(dot.colour, dot.opacity));
  }
  for (const DrawnMarks::Text& text : scene.Drawn().texts)
  {
    const Vector3 place = GetViewer().camera.Project(text.place.cast<double>(), width, height);
    if (place.z() <= 0) continue;
    ImGui::GetBackgroundDrawList()->AddText(
        {static_cast<float>(place.x()), static_cast<float>(place.y()) - ImGui::GetTextLineHeight()},
        WindowColour(text.colour, text.opacity), text.text.data(), text.text.data() + text.text.size());
  }
  panels_->Show(width, height);
}

}  // namespace swarmanoid

EXPORT_RENDERER(swarmanoid::COgreRender)
