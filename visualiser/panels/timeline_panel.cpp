// The timeline: the shown tick, the events of the run as marks, and the way back to the present.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/space/space.h"
#include "visualiser/panels/panels.h"
#include "visualiser/panels/theme.h"

namespace swarmanoid
{
namespace
{

constexpr double kReach = 5;  // pixels between the mouse and a mark

std::string EventText(const TimelineEvent& event)
{
  std::string text = fmt::format("tick {}: {}", event.tick, event.what);
  if (!event.entity.empty()) text += " " + event.entity;
  if (!event.from.empty()) text += " (" + event.from + ")";
  return text;
}

}  // namespace

float Panels::TimelineHeight() const
{
  const bool is_shown = viewer_.shown.panels && viewer_.shown.timeline && viewer_.GetPast().IsThere();
  return is_shown ? Scaled(64) + Scaled(theme::kGap) : 0;
}

void Panels::ShowTimeline()
{
  const PastCursor& past = viewer_.GetPast();
  const auto left = std::max(static_cast<float>(LeftColumn()), Scaled(theme::kGap));
  const float width = std::max(InspectorEdge() - left - Scaled(theme::kGap), Scaled(300));
  const float height = TimelineHeight() - Scaled(theme::kGap);
  ImGui::SetNextWindowPos(ImVec2(left, height_ - height - Scaled(theme::kGap)), ImGuiCond_Always);
  ImGui::SetNextWindowSize(ImVec2(width, height), ImGuiCond_Always);
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoFocusOnAppearing |
                                      ImGuiWindowFlags_NoNav;
  if (ImGui::Begin("##timeline", nullptr, kFlags))
  {
    const auto button = [&](const char* name, const char* tip, Action action)
    {
      if (ImGui::Button(name)) viewer_.Do({action});
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", tip);
    };
    button(past.IsPlaying() ? "Stop" : "Play", "from here, in real time (Z)", Action::kPlayPast);
    ImGui::SameLine();
    button("Live", "back to the present (Q)", Action::kPresent);
    ImGui::SameLine();
    button("Branch here", "copy the command that starts a new run from this tick (Shift-B)", Action::kBranch);
    ImGui::SameLine();
    const double tick_s = viewer_.GetExperiment().TickSeconds();
    const std::uint64_t tick = past.Wanted().value_or(viewer_.Present().GetTick());
    const std::string text =
        fmt::format("{}tick {}    {:.1f} s", past.IsOn() ? "" : "live    ", tick, static_cast<double>(tick) * tick_s);
    ImGui::AlignTextToFramePadding();
    ImGui::PushStyleColor(ImGuiCol_Text, past.IsOn() ? theme::kWarning : theme::kFaint);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
    ShowTrack(past);
  }
  ImGui::End();
}

// Shows the track. Dragging looks at that tick; a click at a mark goes to its event.
void Panels::ShowTrack(const PastCursor& past)
{
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 size(ImGui::GetContentRegionAvail().x, std::max(ImGui::GetContentRegionAvail().y, Scaled(16)));
  ImGui::InvisibleButton("track", size);
  const bool held = ImGui::IsItemActive();
  const bool hovered = ImGui::IsItemHovered();

  const double span = static_cast<double>(past.Last() - past.First());
  const float inset = Scaled(6);
  const float length = size.x - 2 * inset;
  const auto x_of = [&](std::uint64_t tick)
  {
    const double part = static_cast<double>(std::clamp(tick, past.First(), past.Last()) - past.First()) / span;
    return corner.x + inset + static_cast<float>(part) * length;
  };

  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const float middle = corner.y + size.y * 0.4F;
  const float handle = x_of(past.Wanted().value_or(past.Last()));
  draw.AddLine(ImVec2(corner.x + inset, middle), ImVec2(corner.x + size.x - inset, middle), theme::kFrame, Scaled(3));
  draw.AddLine(ImVec2(corner.x + inset, middle), ImVec2(handle, middle), theme::kAccent, Scaled(3));

  const float mouse = ImGui::GetIO().MousePos.x;
  const TimelineEvent* near = nullptr;
  for (const TimelineEvent& event : past.Events())
  {
    if (event.tick < past.First() || event.tick > past.Last()) continue;
    const float x = x_of(event.tick);
    draw.AddLine(ImVec2(x, middle + Scaled(5)), ImVec2(x, corner.y + size.y), theme::kWarning, Scaled(2));
    const bool nearer = near == nullptr || std::abs(x - mouse) < std::abs(x_of(near->tick) - mouse);
    if (std::abs(x - mouse) <= Scaled(kReach) && nearer) near = &event;
  }
  draw.AddCircleFilled(ImVec2(handle, middle), Scaled(6), past.IsOn() ? theme::kWarning : theme::kAccent);

  if (hovered && near != nullptr) ImGui::SetTooltip("%s", EventText(*near).c_str());
  if (!held) return;
  const double part = std::clamp(static_cast<double>(mouse - corner.x - inset) / length, 0.0, 1.0);
  const bool on_mark = near != nullptr && ImGui::GetIO().MousePos.y > middle + Scaled(4);
  const std::uint64_t tick =
      on_mark ? near->tick : past.First() + static_cast<std::uint64_t>(std::llround(part * span));
  if (tick != past.Wanted()) viewer_.LookBackAt(tick);
}

}  // namespace swarmanoid
