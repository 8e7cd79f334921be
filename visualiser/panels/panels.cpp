#include "visualiser/panels/panels.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>

#include "common/math/elementary.h"
#include "common/space/space.h"
#include "visualiser/panels/theme.h"

namespace swarmanoid
{

bool PanelAt(double x, double y)
{
  // io.WantCaptureMouse would be wrong: it is for the mouse position of the last frame, which may be old.
  const ImVec2 place(static_cast<float>(x), static_cast<float>(y));
  for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
    if (window->WasActive && !window->Hidden && (window->Flags & ImGuiWindowFlags_NoMouseInputs) == 0 &&
        window->Rect().Contains(place))
      return true;
  return false;
}

void Panels::Show(float width, float height)
{
  place_ = width != width_ || height != height_ ? ImGuiCond_Always : ImGuiCond_Appearing;
  width_ = width;
  height_ = height;
  if (const std::string copy = viewer_.TakeCopy(); !copy.empty()) ImGui::SetClipboardText(copy.c_str());
  ShowMove();
  ShowMessages();
  if (!viewer_.shown.panels) return;
  run_bottom_ = 0;
  if (viewer_.shown.run) ShowRun();
  if (viewer_.shown.entities) ShowEntities();
  // The loop uses indices, since closing an inspector changes the list.
  for (std::size_t i = 0; i < viewer_.Inspected().size(); ++i) ShowInspector(i);
  if (viewer_.shown.plots && !viewer_.Plots().empty()) ShowPlots();
  if (TimelineHeight() > 0) ShowTimeline();
  if (viewer_.shown.help) ShowHelp();
}

int Panels::LeftColumn() const
{
  const Viewer::Shown& shown = viewer_.shown;
  return shown.panels && (shown.run || shown.entities) ? static_cast<int>(Scaled(theme::kLeftWidth + 2 * theme::kGap))
                                                       : 0;
}

int Panels::InspectorColumns() const
{
  const float step = Scaled(theme::kInspectorWidth + theme::kGap);
  return std::max(1, static_cast<int>((width_ - static_cast<float>(LeftColumn())) / step));
}

float Panels::InspectorEdge() const
{
  const int shown = viewer_.shown.panels ? static_cast<int>(viewer_.Inspected().size()) : 0;
  return width_ -
         static_cast<float>(std::min(shown, InspectorColumns())) * Scaled(theme::kInspectorWidth + theme::kGap);
}

void Panels::PlaceNext(float x, float y, float w, float h)
{
  ImGui::SetNextWindowPos(ImVec2(x, y), place_);
  ImGui::SetNextWindowSize(ImVec2(w, h), place_);
}

void Panels::ShowHelp()
{
  ImGui::SetNextWindowPos(ImVec2(width_ / 2, height_ / 2), ImGuiCond_Always, ImVec2(0.5F, 0.5F));
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse |
                                      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoMove;
  ImGui::SetNextWindowFocus();
  ImGui::SetNextWindowBgAlpha(1);
  if (ImGui::Begin("Keys and mouse", &viewer_.shown.help, kFlags))
  {
    // The help has two columns of sections.
    constexpr std::array kColumns{std::array<std::string_view, 3>{"Run", "Entities", "Panels"},
                                  std::array<std::string_view, 3>{"Camera", "Show", "Look back"}};
    for (const auto& sections : kColumns)
    {
      if (&sections != &kColumns.front()) ImGui::SameLine(0, Scaled(28));
      ImGui::BeginGroup();
      for (const std::string_view section : sections)
      {
        if (section.empty()) continue;
        ImGui::PushStyleColor(ImGuiCol_Text, theme::kAccent);
        ImGui::TextUnformatted(section.data(), section.data() + section.size());
        ImGui::PopStyleColor();
        for (const KeyBinding& binding : KeyBindings())
        {
          if (binding.section != section || binding.keys.empty()) continue;
          ImGui::TextUnformatted(binding.keys.data(), binding.keys.data() + binding.keys.size());
          ImGui::SameLine(Scaled(135));
          ImGui::TextDisabled("%.*s", static_cast<int>(binding.meaning.size()), binding.meaning.data());
        }
        ImGui::Spacing();
      }
      ImGui::EndGroup();
    }
  }
  ImGui::End();
}

void Panels::ShowMessages()
{
  const auto& messages = viewer_.Messages();
  if (messages.empty()) return;
  // The message is in the middle of the area that no panel hides.
  const auto left = static_cast<float>(LeftColumn());
  const float right = InspectorEdge();
  ImGui::SetNextWindowPos(ImVec2((left + std::max(right, left)) / 2, Scaled(theme::kGap)), ImGuiCond_Always,
                          ImVec2(0.5F, 0));
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                      ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
  if (ImGui::Begin("##messages", nullptr, kFlags))
  {
    const float most = std::max(right - left - Scaled(4 * theme::kGap), Scaled(160));
    ImGui::PushTextWrapPos(most);
    for (const Viewer::Message& message : messages)
    {
      ImGui::PushStyleColor(ImGuiCol_Text, message.refused ? theme::kBad : theme::kText);
      ImGui::TextUnformatted(message.text.c_str());
      ImGui::PopStyleColor();
    }
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
}

// Shows the new position of a dragged entity: a ring on the floor with its heading, and a line from its old position.
void Panels::ShowMove()
{
  const auto& move = viewer_.MoveUnderWay();
  if (!move) return;
  ImDrawList& draw = *ImGui::GetBackgroundDrawList();
  const auto at = [&](const Vector3& point) -> std::optional<ImVec2>
  {
    const Vector3 place = viewer_.camera.Project(point, width_, height_);
    if (place.z() <= 0) return std::nullopt;
    return ImVec2(static_cast<float>(place.x()), static_cast<float>(place.y()));
  };
  const auto line = [&](const Vector3& from, const Vector3& to)
  {
    const auto a = at(from);
    const auto b = at(to);
    if (a && b) draw.AddLine(*a, *b, theme::kWarning, Scaled(2));
  };

  const CSwarmanoidSpaceEntity& entity = viewer_.Space().GetEntity(move->entity);
  const double radius = std::max(entity.GetSize().head<2>().maxCoeff(), 0.03) * 1.2;
  constexpr int kCorners = 40;
  for (int i = 0; i < kCorners; ++i)
  {
    const auto corner = [&](int n)
    {
      const double angle = 2 * kPi * n / kCorners;
      return Vector3(move->pose.position + radius * Vector3(Cos(angle), Sin(angle), 0));
    };
    line(corner(i), corner(i + 1));
  }
  line(move->pose.position, move->pose.Apply(Vector3(1.6 * radius, 0, 0)));
  line(entity.GetPosition(), move->pose.position);
  if (const auto place = at(move->pose.position))
  {
    const std::string text = fmt::format("{}: {:.2f}, {:.2f} m, {:.0f}°", entity.GetId(), move->pose.position.x(),
                                         move->pose.position.y(), RadiansToDegrees(YawOf(move->pose.orientation)));
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 corner(place->x + Scaled(18), place->y + Scaled(14));
    draw.AddRectFilled(ImVec2(corner.x - 6, corner.y - 3), ImVec2(corner.x + size.x + 6, corner.y + size.y + 3),
                       IM_COL32(250, 251, 252, 235), 4);
    draw.AddText(corner, theme::kText, text.c_str());
  }
}

}  // namespace swarmanoid
