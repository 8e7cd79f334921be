// A chart of curves over simulated time, drawn with ImGui's draw list. Used by the panel of plots.
#pragma once

#include <span>
#include <string>

#include <imgui.h>

#include "visualiser/interaction/value_history.h"

namespace swarmanoid
{

struct Curve
{
  const ValueHistory* history;
  ImU32 colour;
};

// Draws a chart and takes an area of this size in the current window.
void ShowChart(const std::string& id, std::span<const Curve> curves, ImVec2 size, float line_width);

// Returns a step of 1, 2 or 5 times a power of ten that divides a range into at most `most` parts.
double RoundStep(double range, int most);

}  // namespace swarmanoid
