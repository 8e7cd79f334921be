// The plots of chosen values: one chart for each unit.
#include <algorithm>

#include "visualiser/panels/chart.h"
#include "visualiser/panels/panels.h"
#include "visualiser/panels/theme.h"

namespace swarmanoid
{

void Panels::ShowPlots()
{
  std::vector<Plot>& plots = viewer_.Plots();
  std::vector<std::string> units;
  for (const Plot& plot : plots)
    if (std::find(units.begin(), units.end(), plot.unit) == units.end()) units.push_back(plot.unit);

  const auto left = std::max(static_cast<float>(LeftColumn()), Scaled(theme::kGap));
  const float width = InspectorEdge() - left - Scaled(theme::kGap);
  const float chart = Scaled(130);
  const float height = std::min((chart + Scaled(34)) * static_cast<float>(units.size()) + Scaled(34), 0.5F * height_);
  // The panel is as high as its charts, until the user changes its size.
  if (units.size() != charts_) place_ = ImGuiCond_Always;
  charts_ = units.size();
  if (const float below = TimelineHeight(); below != above_timeline_)
  {
    above_timeline_ = below;
    place_ = ImGuiCond_Always;
  }
  PlaceNext(left, height_ - height - Scaled(theme::kGap) - above_timeline_, std::max(width, Scaled(240)), height);
  if (ImGui::Begin("Plots", &viewer_.shown.plots, ImGuiWindowFlags_NoSavedSettings))
  {
    std::vector<ValueName> closed;
    for (const std::string& unit : units)
    {
      const bool plain = unit.empty() || unit == "colour" || unit == "entity" || unit == "yes/no";
      std::vector<Curve> curves;
      bool first = true;
      for (std::size_t i = 0; i < plots.size(); ++i)
      {
        if (plots[i].unit != unit) continue;
        const ImU32 colour = theme::CurveColour(i);
        curves.push_back({&plots[i].history, colour});
        const std::string title = plain ? plots[i].title : plots[i].title + ", " + unit;
        if (!first)
        {
          ImGui::SameLine(0, Scaled(16));
          const float wanted = ImGui::CalcTextSize(title.c_str()).x + Scaled(30);
          if (ImGui::GetContentRegionAvail().x < wanted) ImGui::NewLine();
        }
        first = false;
        ImGui::PushID(static_cast<int>(i));
        ImGui::PushStyleColor(ImGuiCol_Text, colour);
        ImGui::TextUnformatted(title.c_str());
        ImGui::PopStyleColor();
        ImGui::SameLine(0, Scaled(4));
        if (ImGui::SmallButton("x")) closed.push_back(plots[i].value);
        ImGui::PopID();
      }
      const float room = units.size() == 1 ? ImGui::GetContentRegionAvail().y : chart;
      ShowChart("chart " + unit, curves, ImVec2(ImGui::GetContentRegionAvail().x, std::max(room, Scaled(70))),
                Scaled(1.6F));
    }
    for (const ValueName& value : closed) viewer_.SetPlotted(value, "", false);
  }
  ImGui::End();
}

}  // namespace swarmanoid
