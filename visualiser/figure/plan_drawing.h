// What experiment functions draw, as a plan from above. Used by PlanScene.
#pragma once

#include "visualiser/figure/plan_picture.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

// Of the space as it is, in the order in which it was drawn. A pixel of width is a quarter of a millimetre.
void AddDrawing(const CSwarmanoidSpace& space, PlanPicture& picture);

}  // namespace swarmanoid
