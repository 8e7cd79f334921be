// Parts of the state and drawings of experiment functions as a plan from above. Used by PlanScene.
#pragma once

#include "visualiser/figure/plan_picture.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

// Adds the drawing of the space's current tick, in drawing order. A pixel of width becomes a quarter of a millimetre.
void AddDrawing(const CSwarmanoidSpace& space, PlanPicture& picture);

}  // namespace swarmanoid
