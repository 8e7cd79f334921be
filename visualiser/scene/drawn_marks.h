// What experiment functions draw (common/messages/drawing.h), cut into the few things that every renderer can draw:
// lines, triangles, dots and texts, all in the space. Used by renderers; plain values.
#pragma once

#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "visualiser/scene/material.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

struct DrawnMarks
{
  struct Line
  {
    Eigen::Vector3f from, to;
    Colour colour;
    float opacity;
    float width;  // pixels
  };
  struct Triangle
  {
    Eigen::Vector3f corners[3];
    Colour colour;  // with the light on it: to be drawn as it is, from both sides
    float opacity;
  };
  struct Dot
  {
    Eigen::Vector3f place;
    Colour colour;
    float opacity;
    float diameter;  // pixels
  };
  struct Text
  {
    Eigen::Vector3f place;  // of its left end
    std::string_view text;  // of the space's drawing
    Colour colour;
    float opacity;
  };

  std::vector<Line> lines;
  std::vector<Triangle> triangles;
  std::vector<Dot> dots;
  std::vector<Text> texts;
};

// Of the space as it is. What is drawn in the frame of an entity that is not in the arena is left out.
void CutDrawing(const CSwarmanoidSpace& space, DrawnMarks& marks);

}  // namespace swarmanoid
