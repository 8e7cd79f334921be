// The inspector of one entity: its owners, its pose (which can be edited), its attributes, and the status of a robot. A
// click on a value plots it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"
#include "common/space/space.h"
#include "visualiser/panels/panels.h"
#include "visualiser/panels/theme.h"

namespace swarmanoid
{
namespace
{

constexpr std::size_t kManyValues = 7;  // from this number on, bars instead of lines

ImU32 ColourOf(double value)
{
  const std::uint32_t rgb = WholeNumber(value, 0xffffff).value_or(0);
  return rgb == 0 ? IM_COL32(214, 219, 225, 255) : IM_COL32((rgb >> 16) & 255, (rgb >> 8) & 255, rgb & 255, 255);
}

bool AreNumbersOfOneKind(std::span<const EntityValue> values)
{
  const auto same = [&](const EntityValue& value)
  { return value.unit == values.front().unit && value.unit != "colour" && value.unit != "entity"; };
  return std::all_of(values.begin(), values.end(), same);
}

}  // namespace

void Panels::ShowInspector(std::size_t number)
{
  const std::uint32_t entity = viewer_.Inspected()[number];
  const CSwarmanoidSpaceEntity& body = viewer_.Space().GetEntity(entity);
  // Inspectors are placed from the right edge to the left, as long as there is space beside the left column.
  const float step = Scaled(theme::kInspectorWidth + theme::kGap);
  const int columns = InspectorColumns();
  const auto column = static_cast<float>(static_cast<int>(number) % columns);
  const auto round = static_cast<float>(static_cast<int>(number) / columns);
  const float top = Scaled(theme::kGap) * (1 + 3 * round);
  ImGui::SetNextWindowPos(ImVec2(width_ - (column + 1) * step, top), place_);
  const float inspector = Scaled(theme::kInspectorWidth);
  ImGui::SetNextWindowSizeConstraints(ImVec2(inspector, 0), ImVec2(inspector, height_ - 2 * top));

  bool open = true;
  const std::string title = fmt::format("{}###inspector{}", body.GetId(), number);
  if (ImGui::Begin(title.c_str(), &open, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings))
  {
    std::string who(TagName(body.GetKind()));
    for (const std::string& owner : {viewer_.Owner(entity), viewer_.Host(entity)})
      if (!owner.empty()) who += ", " + owner;
    ImGui::PushTextWrapPos(0);
    ImGui::TextDisabled("%s", who.c_str());
    const RobotStatus* robot = viewer_.Robot(entity);
    if (robot != nullptr)
    {
      ImGui::TextUnformatted(("controller " + robot->controller).c_str());
      if (!robot->state.empty())
      {
        ImGui::PushStyleColor(ImGuiCol_Text, theme::kAccent);
        ImGui::TextUnformatted(robot->state.c_str());
        ImGui::PopStyleColor();
      }
      if (!robot->text.empty() && robot->text != robot->state) ImGui::TextUnformatted(robot->text.c_str());
    }
    else if (!body.GetConfiguration().controller.empty())
      ImGui::TextDisabled("controller %s", body.GetConfiguration().controller.c_str());
    if (const PastCursor& past = viewer_.GetPast(); past.IsOn())
    {
      const char* inside = "";
      if (!body.GetConfiguration().controller.empty() && robot == nullptr && past.InsideError().empty())
        inside = past.IsInsideComputed()
                     ? "; what it sensed is computed when the tick stands"
                     : "; its inside is not in the journal: Shift-I copies the command that computes it";
      ImGui::TextDisabled("at tick %llu%s", static_cast<unsigned long long>(viewer_.Space().GetTick()), inside);
      if (robot == nullptr && !past.InsideError().empty()) ImGui::TextUnformatted(past.InsideError().c_str());
    }
    ImGui::PopTextWrapPos();

    for (const ValueGroup& group : ValuesOf(viewer_.Space(), entity, viewer_.Motion(entity), robot))
      ShowGroup(entity, group);
  }
  ImGui::End();
  if (!open) viewer_.CloseInspector(entity);
}

void Panels::ShowGroup(std::uint32_t entity, const ValueGroup& group)
{
  if (group.source == ValueGroup::Source::kPose) return ShowPose(entity, group);
  ImGui::PushID(static_cast<int>(group.source));
  ImGui::PushID(group.name.c_str());
  const char* const suffix = group.source == ValueGroup::Source::kActuator ? " (set)" : "";
  if (ImGui::CollapsingHeader((group.name + suffix).c_str(), ImGuiTreeNodeFlags_DefaultOpen))
  {
    if (group.values.empty())
      ImGui::TextDisabled("nothing");
    else if (group.values.size() >= kManyValues && AreNumbersOfOneKind(group.values))
      ShowBars(entity, group);
    else
    {
      // Colours form rows together; the other values have one line each.
      const std::span values(group.values);
      for (std::size_t i = 0; i < values.size();)
      {
        std::size_t end = i;
        while (end < values.size() && values[end].unit == "colour") ++end;
        if (end - i > 1)
        {
          ShowColours(entity, values.subspan(i, end - i));
          i = end;
        }
        else
          ShowValue(entity, group, values[i++]);
      }
    }
  }
  ImGui::PopID();
  ImGui::PopID();
}

void Panels::ShowPose(std::uint32_t entity, const ValueGroup& group)
{
  if (edits_.count(entity) != 0) return ShowPoseEdit(entity);
  for (const EntityValue& value : group.values) ShowValue(entity, group, value);
  if (!viewer_.CanMove() || !viewer_.Space().GetEntity(entity).IsMovable()) return;
  ImGui::PushID(static_cast<int>(entity));
  if (ImGui::Button("move ..."))
  {
    PoseEdit edit;
    for (std::size_t i = 0; i < 3; ++i)
    {
      edit.position[i] = group.values[i].value;
      edit.angles[i] = group.values[i + 3].value;
    }
    edits_[entity] = edit;
  }
  ImGui::SameLine();
  if (ImGui::Button("go there")) viewer_.Visit(entity);
  ImGui::SameLine();
  bool follows = viewer_.follows && viewer_.shown.scene.selected == entity;
  if (ImGui::Checkbox("follow", &follows))
  {
    viewer_.Select(entity);
    if (viewer_.follows != follows) viewer_.Do({Action::kFollow});
  }
  ImGui::PopID();
}

void Panels::ShowPoseEdit(std::uint32_t entity)
{
  PoseEdit& edit = edits_[entity];
  ImGui::PushID(static_cast<int>(entity));
  ImGui::SetNextItemWidth(-Scaled(60));
  ImGui::InputScalarN("m", ImGuiDataType_Double, edit.position.data(), 3, nullptr, nullptr, "%.3f");
  ImGui::SetNextItemWidth(-Scaled(60));
  ImGui::InputScalarN("degrees", ImGuiDataType_Double, edit.angles.data(), 3, nullptr, nullptr, "%.1f");
  bool done = ImGui::Button("cancel");
  ImGui::SameLine();
  if (ImGui::Button("move there"))
  {
    Pose pose;
    pose.position = Vector3(edit.position[0], edit.position[1], edit.position[2]);
    pose.orientation = QuaternionFromEuler(
        {DegreesToRadians(edit.angles[0]), DegreesToRadians(edit.angles[1]), DegreesToRadians(edit.angles[2])});
    viewer_.MoveEntity(entity, pose);
    done = true;
  }
  ImGui::PopID();
  if (done) edits_.erase(entity);
}

// Shows one line; a click starts or stops the plot of the value.
void Panels::ShowValue(std::uint32_t entity, const ValueGroup& group, const EntityValue& value)
{
  const ValueName name{entity, group.source, group.name, value.name};
  const bool plotted = viewer_.IsPlotted(name);
  ImGui::PushID(value.name.c_str());
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float line = ImGui::GetTextLineHeight();
  const bool clicked = ImGui::Selectable("##plot", false, 0, ImVec2(0, line));
  if (ImGui::IsItemHovered()) ImGui::SetTooltip(plotted ? "click: plot it no more" : "click: plot it");
  if (clicked) viewer_.SetPlotted(name, value.unit, !plotted);

  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 dot(corner.x + line * 0.35F, corner.y + line * 0.5F);
  if (plotted)
    draw.AddCircleFilled(dot, line * 0.24F, theme::kAccent);
  else
    draw.AddCircle(dot, line * 0.2F, theme::kFrame);
  draw.AddText(ImVec2(corner.x + line, corner.y), theme::kFaint, value.name.c_str());
  const std::string text = ValueText(viewer_.Space(), value);
  float x = corner.x + Scaled(132);
  if (value.unit == "colour")
  {
    draw.AddRectFilled(ImVec2(x, corner.y + 2), ImVec2(x + line, corner.y + line), ColourOf(value.value), 3);
    x += 1.5F * line;
  }
  draw.AddText(ImVec2(x, corner.y), theme::kText, text.c_str());
  ImGui::PopID();
}

void Panels::ShowColours(std::uint32_t entity, std::span<const EntityValue> values)
{
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float line = ImGui::GetTextLineHeight();
  const float width = ImGui::GetContentRegionAvail().x;
  const float step = std::min(width / static_cast<float>(values.size()), 1.3F * line);
  ImGui::PushID(static_cast<int>(entity));
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const ImVec2 from(corner.x + step * static_cast<float>(i), corner.y);
    const ImVec2 to(from.x + step - 3, from.y + line);
    draw.AddRectFilled(from, to, ColourOf(values[i].value), 3);
    if (ImGui::IsMouseHoveringRect(from, to))
      ImGui::SetTooltip("%s: %s", values[i].name.c_str(), ValueText(viewer_.Space(), values[i]).c_str());
  }
  ImGui::PopID();
  ImGui::Dummy(ImVec2(width, line));
}

// Shows many readings of one kind as bars over their common range, including zero. A click plots the value under the
// mouse.
void Panels::ShowBars(std::uint32_t entity, const ValueGroup& group)
{
  double low = 0;
  double high = 0;
  for (const EntityValue& value : group.values)
  {
    if (!std::isfinite(value.value)) continue;
    low = std::min(low, value.value);
    high = std::max(high, value.value);
  }
  const std::string range =
      fmt::format("{} values, {:.3g} to {:.3g} {}", group.values.size(), low, high, group.values.front().unit);
  const bool flat = high <= low;
  const double span = flat ? 1 : high - low;

  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, 2.6F * ImGui::GetTextLineHeight());
  const bool clicked = ImGui::InvisibleButton("bars", size);
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(corner, ImVec2(corner.x + size.x, corner.y + size.y), theme::kChart, 3);
  const float step = size.x / static_cast<float>(group.values.size());
  const double ceiling = flat ? low + span : high;
  const auto y_of = [&](double value)
  { return corner.y + 3 + static_cast<float>((ceiling - value) / span) * (size.y - 6); };
  std::optional<std::size_t> under;
  for (std::size_t i = 0; i < group.values.size(); ++i)
  {
    const EntityValue& value = group.values[i];
    const float x = corner.x + step * static_cast<float>(i);
    const bool plotted = viewer_.IsPlotted({entity, group.source, group.name, value.name});
    const double end = std::isnan(value.value) ? 0 : std::clamp(value.value, low, high);
    const float top = std::min(y_of(end), y_of(0));
    const float bottom = std::max(y_of(end), y_of(0)) + 1;
    draw.AddRectFilled(ImVec2(x + 1, top), ImVec2(x + std::max(step - 1, 2.0F), bottom),
                       plotted ? theme::kWarning : theme::kAccent);
    const float mouse = ImGui::GetIO().MousePos.x;
    if (hovered && mouse >= x && mouse < x + step) under = i;
  }
  draw.AddRect(corner, ImVec2(corner.x + size.x, corner.y + size.y), theme::kGrid, 3);
  ImGui::TextDisabled("%s", range.c_str());
  if (!under) return;
  const EntityValue& value = group.values[*under];
  ImGui::SetTooltip("%s: %s\nclick: plot it", value.name.c_str(), ValueText(viewer_.Space(), value).c_str());
  const ValueName name{entity, group.source, group.name, value.name};
  if (clicked) viewer_.SetPlotted(name, value.unit, !viewer_.IsPlotted(name));
}

}  // namespace swarmanoid
