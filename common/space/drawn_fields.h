// The fields on the floor as shapes, so that every renderer that draws shapes shows them.
#pragma once

#include "common/messages/drawing.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

// Adds rectangles to the drawing. Fields with many cells are drawn in blocks of cells, each with the largest value in
// it. The opacity grows with the square root of the value, so that faint trails can be seen.
void DrawFields(const CSwarmanoidSpace& space, Drawing& drawing);

}  // namespace swarmanoid
