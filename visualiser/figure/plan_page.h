// PlanPage: writes one or several plans on a page, with legend and scale, to a file, by Cairo. Files .svg and .pdf have
// lines and areas that are sharp at any size; .png has pixels. One thread.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "visualiser/figure/plan_picture.h"

namespace swarmanoid
{

enum class PlanCorner : std::uint8_t
{
  kTopLeft,
  kTopRight,
  kBottomLeft,
  kBottomRight
};

struct PlanPageOptions
{
  double width_mm = 120;
  double font_pt = 7;
  double dpi = 300;   // for .png
  int columns = 1;    // panels beside each other
  PlanRegion region;  // the shown part of the arena
  PlanRegion arena;
  std::optional<PlanRegion> inset{};  // the region shown larger in a corner of each panel
  PlanCorner inset_corner = PlanCorner::kTopRight;
  bool legend = true;
  bool scale_bar = true;
  bool axes = false;
};

struct PlanPanel
{
  std::string caption;
  PlanPicture picture;
};

// Throws std::invalid_argument if the file does not end in .svg, .pdf or .png.
void CheckPlanFile(const std::string& path);
// Throws std::runtime_error, naming the file, if it cannot be written.
void WritePlan(const std::string& path, const std::vector<PlanPanel>& panels,
               const std::vector<PlanLegendEntry>& legend, const PlanPageOptions& options);

// Returns the length of the bar of a scale in metres: 1, 2 or 5 times a power of ten, at most a third of the panel.
double ScaleBarLength(double panel_m);
// Returns the text of the entry, and how much wider than they are its bodies are drawn, if they have their least size.
std::string LegendText(const PlanLegendEntry& entry, double mm_per_metre);

}  // namespace swarmanoid
