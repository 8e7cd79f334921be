#include "visualiser/panels/panels.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

#include "common/math/elementary.h"
#include "common/space/space.h"
#include "visualiser/panels/chart.h"
#include "visualiser/panels/theme.h"

namespace swarmanoid
{
namespace
{

constexpr double kVeryLate = 1;  // s: from here on the list of processes opens by itself

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

constexpr std::size_t kManyValues = 7;  // from here on bars instead of lines

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

constexpr double kReach = 5;  // pixels between the mouse and a mark

std::string EventText(const TimelineEvent& event)
{
  std::string text = fmt::format("tick {}: {}", event.tick, event.what);
  if (!event.entity.empty()) text += " " + event.entity;
  if (!event.from.empty()) text += " (" + event.from + ")";
  return text;
}

}  // namespace

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
  plots_height_ = 0;
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

HiddenEdges Panels::Hidden() const
{
  HiddenEdges hidden;
  if (width_ <= 0 || height_ <= 0) return hidden;
  constexpr double kMost = 0.5;
  hidden.left = std::min<double>(LeftColumn() / width_, kMost);
  hidden.right = std::min<double>((width_ - InspectorEdge()) / width_, kMost - hidden.left);
  hidden.bottom = std::min<double>((TimelineHeight() + plots_height_) / height_, kMost);
  return hidden;
}

float Panels::LeftColumn() const
{
  const Viewer::Shown& shown = viewer_.shown;
  return shown.panels && (shown.run || shown.entities) ? Scaled(theme::kLeftWidth + 2 * theme::kGap) : 0;
}

int Panels::InspectorColumns() const
{
  const float step = Scaled(theme::kInspectorWidth + theme::kGap);
  return std::max(1, static_cast<int>((width_ - LeftColumn()) / step));
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
  const float left = LeftColumn();
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

// The panel of the run shows its pace, its processes, the switches of the picture, and the viewpoints.

void Panels::ShowRun()
{
  ImGui::SetNextWindowPos(ImVec2(Scaled(theme::kGap), Scaled(theme::kGap)), place_);
  const float width = Scaled(theme::kLeftWidth);
  // The panel is as high as its content, but at most three fifths of the picture.
  ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0), ImVec2(width, 0.62F * height_));
  const std::string title = viewer_.GetExperiment().name + "###run";
  if (ImGui::Begin(title.c_str(), &viewer_.shown.run,
                   ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings))
  {
    const RunStatus& status = viewer_.Status();
    ShowPace(status);
    if (!viewer_.note.empty()) ImGui::TextDisabled("%s", viewer_.note.c_str());
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

// The list of entities has a filter. Only the visible rows are made.

void Panels::ShowEntities()
{
  const float top = run_bottom_ > 0 ? run_bottom_ + Scaled(theme::kGap) : Scaled(theme::kGap);
  EntityFilter& filter = viewer_.Filter();
  const std::vector<std::uint32_t>& rows = filter.Matching(filter_.data());
  const std::string title = rows.size() == viewer_.Space().Size()
                                ? fmt::format("{} entities###entities", rows.size())
                                : fmt::format("{} of {} entities###entities", rows.size(), viewer_.Space().Size());
  // Below the run panel, as high as its rows and the window allow.
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
      // Places have room for any number of the arena, and words share the rest.
      const double extent = viewer_.GetExperiment().arena_size.head<2>().maxCoeff();
      const float number =
          std::max(ImGui::CalcTextSize(fmt::format("-{:.2f}", extent).c_str()).x, ImGui::CalcTextSize("absent").x);
      ImGui::TableSetupColumn("id", 0, 3);
      ImGui::TableSetupColumn("kind", 0, 2.4F);
      ImGui::TableSetupColumn("x", ImGuiTableColumnFlags_WidthFixed, number);
      ImGui::TableSetupColumn("y", ImGuiTableColumnFlags_WidthFixed, number);
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

// The inspector of an entity shows its owner, its pose, which can be edited, its attributes, and the inside of a robot.
// A click on a value plots it.

void Panels::ShowInspector(std::size_t number)
{
  const std::uint32_t entity = viewer_.Inspected()[number];
  const CSwarmanoidSpaceEntity& body = viewer_.Space().GetEntity(entity);
  // From the right edge to the left, as long as there is room beside the column at the left.
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
      // Consecutive colours share a row, and other values have a line each.
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

// Shows a value in one line. A click plots the value or ends its plot.
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

// Shows many readings of one kind as bars over the range of all of them and zero. A click plots the one under the
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

// The plots of chosen values have one chart for each unit.

void Panels::ShowPlots()
{
  std::vector<Plot>& plots = viewer_.Plots();
  std::vector<std::string> units;
  for (const Plot& plot : plots)
    if (std::find(units.begin(), units.end(), plot.unit) == units.end()) units.push_back(plot.unit);

  const float left = std::max(LeftColumn(), Scaled(theme::kGap));
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
  plots_height_ = height + Scaled(theme::kGap);
  PlaceNext(left, height_ - plots_height_ - above_timeline_, std::max(width, Scaled(240)), height);
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

// The timeline shows the tick of the picture and the events of the run as marks, and leads back to the present.

float Panels::TimelineHeight() const
{
  const bool is_shown = viewer_.shown.panels && viewer_.shown.timeline && viewer_.GetPast().IsThere();
  return is_shown ? Scaled(64) + Scaled(theme::kGap) : 0;
}

void Panels::ShowTimeline()
{
  const PastCursor& past = viewer_.GetPast();
  const float left = std::max(LeftColumn(), Scaled(theme::kGap));
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

// Shows the track. A drag anywhere goes to that tick, and a click at a mark goes to its event.
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
