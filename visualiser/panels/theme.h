// The look of the panels: a light palette, and the font. Every window with panels uses it.
#pragma once

#include <imgui.h>

#include <string>

namespace swarmanoid
{

namespace theme
{
inline constexpr ImU32 kText = IM_COL32(38, 45, 54, 255);
inline constexpr ImU32 kFaint = IM_COL32(112, 122, 134, 255);
inline constexpr ImU32 kAccent = IM_COL32(46, 110, 166, 255);
inline constexpr ImU32 kGood = IM_COL32(46, 139, 87, 255);
inline constexpr ImU32 kWarning = IM_COL32(201, 122, 20, 255);
inline constexpr ImU32 kBad = IM_COL32(193, 57, 43, 255);
inline constexpr ImU32 kChart = IM_COL32(255, 255, 255, 255);
inline constexpr ImU32 kGrid = IM_COL32(226, 230, 235, 255);
inline constexpr ImU32 kFrame = IM_COL32(190, 198, 207, 255);

inline constexpr float kFontSize = 14;  // pixels at scale 1
// The widths of the columns of panels and of the gaps between them, at scale 1.
inline constexpr float kLeftWidth = 288;
inline constexpr float kInspectorWidth = 288;
inline constexpr float kGap = 10;

// Returns the colour of the curve with that number.
ImU32 CurveColour(std::size_t n);
}  // namespace theme

// Sets the style of the current context. `scale`: of the screen, 1 for about 96 dots an inch.
void ApplyTheme(float scale);
// Returns the path of DejaVu Sans if it is installed; empty: ImGui's own font is used.
std::string PanelFont();

}  // namespace swarmanoid
