// The panel of the run: its status, its processes, the view options, and the viewpoints.
#include <fmt/format.h>

#include <algorithm>

#include "common/space/space.h"
#include "visualiser/panels/panels.h"
#include "visualiser/panels/theme.h"

namespace swarmanoid
{
namespace
{

constexpr double kVeryLate = 1;  // s: delay from which the list of processes opens by itself

struct PhaseLook
{
  const char* text;
  ImU32 colour;
};

PhaseLook LookOf(RunStatus::Phase phase)
{
  switch (phase)
  {
    case RunStatus::Phase::kWaiting:
      return {"waiting for processes", theme::kWarning};
    case RunStatus::Phase::kRunning:
      return {"running", theme::kGood};
    case RunStatus::Phase::kPaused:
      return {"paused", theme::kWarning};
    case RunStatus::Phase::kFinished:
      return {"finished", theme::kFaint};
    case RunStatus::Phase::kUnknown:
      break;
  }
  return {"not heard of yet", theme::kFaint};
}

void Text(const std::string& text) { ImGui::TextUnformatted(text.c_str()); }

void Coloured(ImU32 colour, const std::string& text)
{
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  Text(text);
  ImGui::PopStyleColor();
}

std::string SpeedText(double speed) { return speed == 0 ? "as fast as possible" : fmt::format("{:g} x", speed); }

}  // namespace

void Panels::ShowRun()
{
  ImGui::SetNextWindowPos(ImVec2(Scaled(theme::kGap), Scaled(theme::kGap)), place_);
  const float width = Scaled(theme::kLeftWidth);
  // The panel fits its content, up to three fifths of the picture.
  ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0), ImVec2(width, 0.62F * height_));
  const std::string title = viewer_.GetExperiment().name + "###run";
  if (ImGui::Begin(title.c_str(), &viewer_.shown.run,
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings))
  {
    const RunStatus& status = viewer_.Status();
    ShowPace(status);
    ShowProcesses(status);
    ShowSwitches();
    ShowViewpoints();
  }
  run_bottom_ = ImGui::GetWindowPos().y + ImGui::GetWindowHeight();
  ImGui::End();
}

void Panels::ShowPace(const RunStatus& status)
{
  const PhaseLook look = LookOf(status.phase);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float line = ImGui::GetTextLineHeight();
  draw.AddCircleFilled(ImVec2(corner.x + line * 0.35F, corner.y + line * 0.55F), line * 0.28F, look.colour);
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + line);
  const std::uint64_t most = viewer_.GetExperiment().max_clock;
  const std::uint64_t tick = viewer_.Present().GetTick();
  Coloured(look.colour, look.text);
  if (!status.ended.empty())
  {
    ImGui::SameLine();
    ImGui::TextDisabled("%s", status.ended.c_str());
  }
  if (most > 0)
    Text(fmt::format("tick {} of {}    {:.1f} s", tick, most, viewer_.Present().GetTime()));
  else
    Text(fmt::format("tick {}    {:.1f} s", tick, viewer_.Present().GetTime()));
  if (status.phase == RunStatus::Phase::kRunning)
    Text(fmt::format("{:.{}f} x real time    {:.0f} ticks/s", status.real_time_factor,
                     status.real_time_factor < 10 ? 2 : 0, status.ticks_per_second));
  else
    ImGui::TextDisabled("speed: %s", SpeedText(status.speed_wanted).c_str());
  if (!viewer_.CanControl())
  {
    ImGui::TextDisabled("this visualisation may only watch");
    return;
  }

  const bool paused = status.phase == RunStatus::Phase::kPaused;
  if (ImGui::Button(paused ? "Go on" : "Pause", ImVec2(Scaled(76), 0))) viewer_.Do({Action::kPause});
  ImGui::SameLine();
  if (ImGui::Button("Step")) viewer_.Do({Action::kStep});
  ImGui::SameLine();
  if (ImGui::Button("10")) viewer_.Do({Action::kStepTen});
  ImGui::SameLine();
  if (ImGui::Button("Reset")) viewer_.Reset();
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("ends the run, and begins it again at tick 0");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  const std::string wanted = status.speed_wanted == 0 ? "max" : fmt::format("{:g} x", status.speed_wanted);
  if (ImGui::BeginCombo("##speed", wanted.c_str()))
  {
    for (const double speed : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 0.0})
      if (ImGui::Selectable(SpeedText(speed).c_str(), speed == status.speed_wanted)) viewer_.SetSpeed(speed);
    ImGui::EndCombo();
  }
}

void Panels::ShowProcesses(const RunStatus& status)
{
  if (status.processes.empty()) return;
  double latest = 0;
  for (const ProcessStatus& process : status.processes) latest = std::max(latest, process.late_s);
  if (latest > kVeryLate) ImGui::SetNextItemOpen(true);
  const std::string title =
      status.processes.size() == 1 ? "One process" : fmt::format("{} processes", status.processes.size());
  if (!ImGui::CollapsingHeader((title + "###processes").c_str())) return;
  if (!ImGui::BeginTable("processes", 2, ImGuiTableFlags_SizingStretchProp)) return;
  for (const ProcessStatus& process : status.processes)
  {
    const bool is_late = process.late_s > 0;
    ImGui::TableNextColumn();
    Coloured(is_late ? theme::kBad : theme::kText, process.name);
    if (ImGui::IsItemHovered())
      ImGui::SetTooltip("%s, tick %llu%s%s", process.process.c_str(), static_cast<unsigned long long>(process.tick),
                        process.doing.empty() ? "" : "\n", process.doing.c_str());
    ImGui::TableNextColumn();
    if (is_late)
      Coloured(theme::kBad, fmt::format("late {:.1f} s", process.late_s));
    else
      ImGui::TextDisabled("tick %llu", static_cast<unsigned long long>(process.tick));
    if (is_late && !process.doing.empty())
    {
      ImGui::TableNextColumn();
      ImGui::PushTextWrapPos(0);
      Coloured(theme::kBad, process.doing);
      ImGui::PopTextWrapPos();
      ImGui::TableNextColumn();
    }
  }
  ImGui::EndTable();
}

void Panels::ShowSwitches()
{
  if (!ImGui::CollapsingHeader("Show")) return;
  Viewer::Shown& shown = viewer_.shown;
  const auto box = [](const char* name, bool& option, const char* key, bool second)
  {
    if (second) ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.5F);
    ImGui::Checkbox(name, &option);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("key %s", key);
  };
  box("ids", shown.scene.ids, "I", false);
  box("trails", shown.scene.trails, "L", true);
  box("rays", shown.scene.rays, "R", false);
  box("laser beams", shown.scene.beams, "B", true);
  box("shadows", shown.shadows, "S", false);
  box("textures", shown.textures, "T", true);
  box("collision models", shown.scene.collision_models, "C", false);
}

void Panels::ShowViewpoints()
{
  if (!ImGui::CollapsingHeader("Viewpoints")) return;
  if (ImGui::Button("whole arena")) viewer_.Do({Action::kWholeArena});
  ImGui::SameLine();
  if (ImGui::Button("from above")) viewer_.Do({Action::kFromAbove});
  for (int number = 0; number < Viewpoints::kCount; ++number)
  {
    if (number % 5 != 0) ImGui::SameLine();
    const bool given = viewer_.GetViewpoints().At(number).has_value();
    ImGui::PushStyleColor(ImGuiCol_Text, given ? theme::kText : theme::kFrame);
    if (ImGui::Button(std::to_string(number).c_str(), ImVec2(Scaled(30), 0)))
      viewer_.Do({ImGui::GetIO().KeyShift ? Action::kStore : Action::kRecall, number});
    ImGui::PopStyleColor();
    if (ImGui::IsItemHovered())
      ImGui::SetTooltip(given ? "Ctrl-%d; with Shift: store" : "Ctrl-Shift-%d stores the present view here", number);
  }
  if (viewer_.StoredXml().empty()) return;
  if (ImGui::Button("copy the XML stored last")) ImGui::SetClipboardText(viewer_.StoredXml().c_str());
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", viewer_.StoredXml().c_str());
}

}  // namespace swarmanoid
