// Converts parts of the state (common/space/drawn_state.h) and drawings of experiment functions
// (common/messages/drawing.h) into primitives that every renderer can draw: lines, triangles, dots and texts, all in
// the frame of the space. Plain values.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "visualiser/scene/material.h"

namespace swarmanoid
{

class DrawnState;

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
    Colour colour;  // with light applied; drawn unchanged, from both sides
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
    Eigen::Vector3f place;  // the left end of the text
    std::string text;
    Colour colour;
    float opacity;
  };

  std::vector<Line> lines;
  std::vector<Triangle> triangles;
  std::vector<Dot> dots;
  std::vector<Text> texts;
};

// Converts the shapes of the current tick. Drawings in the frame of an entity outside the arena are left out.
void CutDrawing(const DrawnState& state, DrawnMarks& marks);

}  // namespace swarmanoid
