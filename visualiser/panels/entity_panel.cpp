// The list of entities, with a filter. Only visible rows are made.
#include <fmt/format.h>

#include "common/space/space.h"
#include "visualiser/panels/panels.h"
#include "visualiser/panels/theme.h"

namespace swarmanoid
{

void Panels::ShowEntities()
{
  const float top = run_bottom_ > 0 ? run_bottom_ + Scaled(theme::kGap) : Scaled(theme::kGap);
  EntityFilter& filter = viewer_.Filter();
  const std::vector<std::uint32_t>& rows = filter.Matching(filter_.data());
  const std::string title = rows.size() == viewer_.Space().Size()
                                ? fmt::format("{} entities###entities", rows.size())
                                : fmt::format("{} of {} entities###entities", rows.size(), viewer_.Space().Size());
  // The panel is below the run panel, as high as its rows and the window allow.
  ImGui::SetNextWindowPos(ImVec2(Scaled(theme::kGap), top), ImGuiCond_Always);
  const float line = ImGui::GetTextLineHeight() + 2 * ImGui::GetStyle().CellPadding.y;
  const float wanted = Scaled(66) + line * static_cast<float>(std::max<std::size_t>(rows.size(), 3) + 1);
  const float room = std::max(height_ - top - Scaled(theme::kGap), Scaled(120));
  ImGui::SetNextWindowSize(ImVec2(Scaled(theme::kLeftWidth), std::min(wanted, room)), ImGuiCond_Always);
  constexpr ImGuiWindowFlags kFlags =
      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize;
  if (ImGui::Begin(title.c_str(), &viewer_.shown.entities, kFlags))
  {
    ImGui::SetNextItemWidth(-1);
    ImGui::InputTextWithHint("##filter", "filter: id, kind, controller, owner", filter_.data(), filter_.size());
    constexpr ImGuiTableFlags kTable =
        ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp;
    if (ImGui::BeginTable("entities", 4, kTable))
    {
      ImGui::TableSetupScrollFreeze(0, 1);
      ImGui::TableSetupColumn("id", 0, 3);
      ImGui::TableSetupColumn("kind", 0, 2.4F);
      ImGui::TableSetupColumn("x", 0, 1.5F);
      ImGui::TableSetupColumn("y", 0, 1.5F);
      ImGui::TableHeadersRow();
      ImGuiListClipper clipper;
      clipper.Begin(static_cast<int>(rows.size()));
      while (clipper.Step())
        for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row)
          ShowEntityRow(rows[static_cast<std::size_t>(row)]);
      ImGui::EndTable();
    }
  }
  ImGui::End();
}

void Panels::ShowEntityRow(std::uint32_t entity)
{
  const CSwarmanoidSpaceEntity& body = viewer_.Space().GetEntity(entity);
  const Vector3 place = body.GetPosition();
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const bool selected = viewer_.shown.scene.selected == entity;
  if (ImGui::Selectable(body.GetId().c_str(), selected,
                        ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowDoubleClick))
  {
    viewer_.Select(entity, ImGui::GetIO().KeyCtrl);
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) viewer_.Visit(entity);
  }
  if (ImGui::IsItemHovered())
  {
    const std::string owner = viewer_.Owner(entity);
    const std::string host = viewer_.Host(entity);
    ImGui::SetTooltip("%s%s%s\ndouble click: go there", owner.empty() ? "no engine moves it" : owner.c_str(),
                      host.empty() ? "" : "\n", host.c_str());
  }
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", DescriptionOf(body.GetKind()).short_word.c_str());
  ImGui::TableNextColumn();
  if (!viewer_.Space().IsPresent(entity))
  {
    ImGui::TextDisabled("absent");
    return;
  }
  ImGui::Text("%.2f", place.x());
  ImGui::TableNextColumn();
  ImGui::Text("%.2f", place.y());
}

}  // namespace swarmanoid
