#include "visualiser/panels/theme.h"

#include <array>
#include <filesystem>

namespace swarmanoid
{

ImU32 theme::CurveColour(std::size_t n)
{
  static constexpr std::array<ImU32, 8> kCurves{IM_COL32(46, 110, 166, 255), IM_COL32(214, 108, 40, 255),
                                                IM_COL32(62, 145, 92, 255),  IM_COL32(155, 81, 154, 255),
                                                IM_COL32(190, 60, 66, 255),  IM_COL32(120, 105, 60, 255),
                                                IM_COL32(60, 150, 165, 255), IM_COL32(95, 95, 105, 255)};
  return kCurves[n % kCurves.size()];
}

void ApplyTheme(float scale)
{
  ImGui::StyleColorsLight();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = style.FrameRounding = style.PopupRounding = style.ChildRounding = 5;
  style.GrabRounding = style.ScrollbarRounding = 5;
  style.WindowBorderSize = style.FrameBorderSize = 1;
  style.WindowPadding = ImVec2(10, 8);
  style.FramePadding = ImVec2(7, 3);
  style.ItemSpacing = ImVec2(7, 5);
  style.CellPadding = ImVec2(5, 2);
  style.ScrollbarSize = 11;
  style.WindowMenuButtonPosition = ImGuiDir_None;
  style.WindowTitleAlign = ImVec2(0, 0.5F);
  style.ScaleAllSizes(scale);

  const auto set = [&](ImGuiCol which, ImU32 colour, float opacity = 1)
  {
    style.Colors[which] = ImGui::ColorConvertU32ToFloat4(colour);
    style.Colors[which].w = opacity;
  };
  constexpr ImU32 kPanel = IM_COL32(250, 251, 252, 255);
  constexpr ImU32 kField = IM_COL32(255, 255, 255, 255);
  constexpr ImU32 kSoft = IM_COL32(232, 236, 241, 255);
  constexpr ImU32 kSofter = IM_COL32(220, 227, 235, 255);
  constexpr ImU32 kPressed = IM_COL32(200, 214, 228, 255);
  set(ImGuiCol_Text, theme::kText);
  set(ImGuiCol_TextDisabled, theme::kFaint);
  set(ImGuiCol_WindowBg, kPanel, 0.94F);
  set(ImGuiCol_PopupBg, kPanel, 0.98F);
  set(ImGuiCol_Border, theme::kFrame, 0.75F);
  set(ImGuiCol_FrameBg, kField);
  set(ImGuiCol_FrameBgHovered, kSoft);
  set(ImGuiCol_FrameBgActive, kSofter);
  for (const ImGuiCol title : {ImGuiCol_TitleBg, ImGuiCol_TitleBgActive, ImGuiCol_TitleBgCollapsed})
    set(title, kSofter, 0.96F);
  set(ImGuiCol_Button, kSoft);
  set(ImGuiCol_ButtonHovered, kSofter);
  set(ImGuiCol_ButtonActive, kPressed);
  set(ImGuiCol_Header, kSoft);
  set(ImGuiCol_HeaderHovered, kSofter);
  set(ImGuiCol_HeaderActive, kPressed);
  set(ImGuiCol_CheckMark, theme::kAccent);
  set(ImGuiCol_SliderGrab, theme::kAccent);
  set(ImGuiCol_ScrollbarBg, kSoft, 0.5F);
  set(ImGuiCol_TableHeaderBg, kSoft);
  set(ImGuiCol_TableRowBgAlt, kSoft, 0.35F);
  set(ImGuiCol_TableBorderLight, kSoft);
  set(ImGuiCol_TableBorderStrong, kSofter);
  set(ImGuiCol_Separator, kSofter);
  set(ImGuiCol_TextSelectedBg, kPressed);
}

std::string PanelFont()
{
  const std::string path = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf";
  std::error_code ignored;
  return std::filesystem::exists(path, ignored) ? path : std::string();
}

}  // namespace swarmanoid
