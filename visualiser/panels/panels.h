// The panels of a window, drawn with Dear ImGui: run, entities, inspectors, plots, help, messages. Pure ImGui over a
// Viewer, so that every window with ImGui shows the same ones; compiled into each renderer's library, because libraries
// bring their own ImGui.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

#include <imgui.h>

#include "visualiser/interaction/viewer.h"

namespace swarmanoid
{

// Whether a panel takes the mouse at a place of the present context's window, as it was drawn last.
bool PanelAt(double x, double y);

class Panels
{
public:
  // scale: of the screen, as in ApplyTheme.
  Panels(Viewer& viewer, float scale) : viewer_(viewer), scale_(scale) {}

  // Between ImGui's NewFrame and Render. The size of the window in pixels.
  void Show(float width, float height);
  // What the panels at the left hide of the window; for Viewer::SetSize.
  int LeftColumn() const;

private:
  // A pose that is being edited in an inspector.
  struct PoseEdit
  {
    std::array<double, 3> position{};
    std::array<double, 3> angles{};  // degrees
  };

  void ShowRun();
  void ShowPace(const RunStatus& status);
  void ShowProcesses(const RunStatus& status);
  void ShowSwitches();
  void ShowViewpoints();
  void ShowEntities();
  void ShowEntityRow(std::uint32_t entity);
  void ShowInspector(std::size_t number);
  void ShowPose(std::uint32_t entity, const ValueGroup& group);
  void ShowPoseEdit(std::uint32_t entity);
  void ShowGroup(std::uint32_t entity, const ValueGroup& group);
  void ShowColours(std::uint32_t entity, std::span<const EntityValue> values);
  void ShowBars(std::uint32_t entity, const ValueGroup& group);
  void ShowValue(std::uint32_t entity, const ValueGroup& group, const EntityValue& value);
  void ShowPlots();
  void ShowTimeline();
  void ShowTrack(const PastCursor& past);
  // With the gap below it; 0 if it is not shown.
  float TimelineHeight() const;
  void ShowHelp();
  void ShowMessages();
  void ShowMove();

  // Inspectors stand side by side from the right edge, as many as there is room for.
  int InspectorColumns() const;
  // Where the inspectors begin: what is left of it is free.
  float InspectorEdge() const;
  // The place of the next window; it stays where the person puts it, until the size of the picture changes.
  void PlaceNext(float x, float y, float w, float h);
  float Scaled(float pixels) const { return pixels * scale_; }

  Viewer& viewer_;
  float scale_;
  float width_ = 0, height_ = 0;
  float run_bottom_ = 0;      // of the run panel, where the list of entities starts
  std::size_t charts_ = 0;    // that the panel of plots was made for
  float above_timeline_ = 0;  // where the panel of plots ends
  ImGuiCond place_ = ImGuiCond_Always;
  std::array<char, 128> filter_{};
  std::map<std::uint32_t, PoseEdit> edits_;
};

}  // namespace swarmanoid
