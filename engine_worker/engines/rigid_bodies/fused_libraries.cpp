#include "engine_worker/engines/rigid_bodies/fused_libraries.h"

#include <box2d/b2_circle_shape.h>
#include <ode/ode.h>

namespace swarmanoid
{
namespace
{

// The sum of the two squares is the square of the radius, if each square is rounded before they are added. If only one
// of them is rounded, the sum is larger by a unit in the last place, whichever it is.
bool Box2dIsFused()
{
  b2CircleShape circle;
  circle.m_radius = 0x1.33866p+0F;
  b2Transform here;
  here.SetIdentity();
  return !circle.TestPoint(here, {0x1.efba92p-1F, 0x1.6c0f34p-1F});
}

// The square of 1 + e is 1 + 2 e + e². If the product is rounded before the sum, the last term is lost.
bool OdeIsFused()
{
  constexpr dReal e = 0x1p-30;
  const dReal row[] = {1, 1 + e};
  const dReal column[] = {-(1 + 2 * e), 1 + e};
  dReal sum = -1;
  dMultiply0(&sum, row, column, 1, 2, 1);
  return sum != 0;
}

}  // namespace

void FindFusedLibraries(std::vector<std::string>& names)
{
  if (Box2dIsFused()) names.emplace_back("Box2D");
  if (OdeIsFused()) names.emplace_back("ODE");
}

}  // namespace swarmanoid
