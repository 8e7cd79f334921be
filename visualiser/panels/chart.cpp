#include "visualiser/panels/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "visualiser/panels/theme.h"

namespace swarmanoid
{
namespace
{

struct Range
{
  double low = 1e300;
  double high = -1e300;

  void Take(double value)
  {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double Span() const { return high - low; }
};

}  // namespace

double RoundStep(double range, int most)
{
  const double step = std::pow(10.0, std::floor(std::log10(range / most)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (range / (factor * step) <= most) return factor * step;
  return 10 * step;
}

void ShowChart(const std::string& id, std::span<const Curve> curves, ImVec2 size, float line_width)
{
  Range time, value;
  for (const Curve& curve : curves)
    for (const ValueHistory::Point& point : curve.history->Points())
    {
      time.Take(point.time);
      value.Take(point.value);
    }
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton(id.c_str(), size);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(corner, ImVec2(corner.x + size.x, corner.y + size.y), theme::kChart, 4);
  draw.AddRect(corner, ImVec2(corner.x + size.x, corner.y + size.y), theme::kGrid, 4);
  if (time.Span() <= 0)
  {
    draw.AddText(ImVec2(corner.x + 8, corner.y + 6), theme::kFaint, "the curve starts with the next ticks");
    return;
  }

  // A flat curve gets a margin above and below.
  const double margin = value.Span() > 0 ? 0.06 * value.Span() : std::max(0.1 * std::abs(value.low), 0.05);
  value.low -= margin;
  value.high += margin;
  const float text = ImGui::GetTextLineHeight();
  const float left = corner.x + 3.6F * text;
  const float right = corner.x + size.x - 0.6F * text;
  const float top = corner.y + 0.5F * text;
  const float bottom = corner.y + size.y - 1.35F * text;
  const auto at = [&](double t, double v)
  {
    return ImVec2(left + static_cast<float>((t - time.low) / time.Span()) * (right - left),
                  bottom - static_cast<float>((v - value.low) / value.Span()) * (bottom - top));
  };

  const double step = RoundStep(value.Span(), std::max(2, static_cast<int>((bottom - top) / (1.8F * text))));
  for (double v = std::ceil(value.low / step) * step; v <= value.high; v += step)
  {
    const ImVec2 place = at(time.low, v);
    draw.AddLine(place, ImVec2(right, place.y), theme::kGrid);
    const std::string label = fmt::format("{:.4g}", std::abs(v) < 1e-9 * step ? 0.0 : v);
    draw.AddText(ImVec2(left - ImGui::CalcTextSize(label.c_str()).x - 5, place.y - text / 2), theme::kFaint,
                 label.c_str());
  }
  const double time_step = RoundStep(time.Span(), std::max(2, static_cast<int>((right - left) / (5 * text))));
  for (double t = std::ceil(time.low / time_step) * time_step; t <= time.high; t += time_step)
  {
    const ImVec2 place = at(t, value.low);
    draw.AddLine(ImVec2(place.x, top), place, theme::kGrid);
    const std::string label = fmt::format("{:.4g} s", t);
    const float width = ImGui::CalcTextSize(label.c_str()).x;
    draw.AddText(ImVec2(std::min(place.x - width / 2, right - width), bottom + 2), theme::kFaint, label.c_str());
  }

  // Curves are drawn piece by piece, since a polyline's joints leave gaps at narrow peaks.
  for (const Curve& curve : curves)
  {
    const std::vector<ValueHistory::Point>& points = curve.history->Points();
    for (std::size_t p = 1; p < points.size(); ++p)
      draw.AddLine(at(points[p - 1].time, points[p - 1].value), at(points[p].time, points[p].value), curve.colour,
                   line_width);
  }
}

}  // namespace swarmanoid
