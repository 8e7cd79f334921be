// The panels of a window, drawn with Dear ImGui: run, entities, inspectors, plots, help, messages. They use only ImGui
// and a Viewer, so that every window with ImGui shows the same panels. They are compiled into each renderer's library,
// because libraries have their own ImGui.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

#include <imgui.h>

#include "visualiser/interaction/viewer.h"

namespace swarmanoid
{

// Returns whether a panel of the current context's last frame takes the mouse at a position.
bool PanelAt(double x, double y);

class Panels
{
public:
  // `scale` is that of the screen, as in ApplyTheme.
  Panels(Viewer& viewer, float scale) : viewer_(viewer), scale_(scale) {}

  // Call it between ImGui's NewFrame and Render. The size of the window is in pixels.
  void Show(float width, float height);
  // Returns the edges of the window that the panels hide, for Viewer::SetSize. At least half of its width and height
  // count as free.
  HiddenEdges Hidden() const;

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
  // Returns the height including the gap below; 0 if the timeline is not shown.
  float TimelineHeight() const;
  // Returns the pixels that the panels at the left hide.
  float LeftColumn() const;
  void ShowHelp();
  void ShowMessages();
  void ShowMove();

  // Returns the number of inspectors that fit side by side from the right edge.
  int InspectorColumns() const;
  // Returns the left edge of the inspectors; the area to the left of it is free.
  float InspectorEdge() const;
  // Places the next window. It stays where the user moves it, until the size of the picture changes.
  void PlaceNext(float x, float y, float w, float h);
  float Scaled(float pixels) const { return pixels * scale_; }

  Viewer& viewer_;
  float scale_;
  float width_ = 0, height_ = 0;
  float run_bottom_ = 0;      // the lower end of the run panel, where the list of entities starts
  std::size_t charts_ = 0;    // the number of charts for which the panel of plots was made
  float above_timeline_ = 0;  // the lower end of the panel of plots
  float plots_height_ = 0;    // of that panel with its gap; 0 if it is not shown
  ImGuiCond place_ = ImGuiCond_Always;
  std::array<char, 128> filter_{};
  std::map<std::uint32_t, PoseEdit> edits_;
};

}  // namespace swarmanoid
