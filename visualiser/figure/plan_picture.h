// The content of a plan of the arena: areas, lines and words, in metres of the arena, in drawing order. PlanScene makes
// it at the chosen ticks, and PlanPage puts it onto a page.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/math/pose.h"

namespace swarmanoid
{

// A rectangle of the arena, in metres.
struct PlanRegion
{
  Vector2 low = Vector2::Zero();
  Vector2 high = Vector2::Zero();

  Vector2 Size() const { return high - low; }
};

struct PlanColour
{
  std::uint32_t rgb = 0;
  double opacity = 1;
};

struct PlanShape
{
  enum class Form : std::uint8_t
  {
    kDisc,     // around points[0]
    kPolygon,  // closed
    kLine,     // open
    kImage,    // upright in the frame of the corners: upper left, upper right, lower left
    kText      // beside points[0]
  };

  Form form = Form::kPolygon;
  std::vector<Vector2> points;  // m
  double radius = 0;            // m: of a disc; for a text, its distance from the point
  double least_radius_mm = 0;   // the least radius of a disc on the page
  std::optional<PlanColour> fill{};
  std::optional<PlanColour> edge{};
  double edge_mm = 0.15;
  bool dashed = false;
  double detail_m = 0;  // drawn only if this length is at least a millimetre on the page; 0: always
  std::string text{};
  int columns = 0;                      // for an image
  std::vector<std::uint32_t> pixels{};  // for an image: 0xAARRGGBB, rows from the top
};

using PlanPicture = std::vector<PlanShape>;

// An entry of the legend: a sample in a square from (-1, -1) to (1, 1), and its text.
struct PlanLegendEntry
{
  PlanPicture sample;
  std::string text;
  // The size of the smallest body that the entry stands for, if bodies have a least size on the page; otherwise 0.
  double radius = 0;  // m
  double least_radius_mm = 0;
};

}  // namespace swarmanoid
