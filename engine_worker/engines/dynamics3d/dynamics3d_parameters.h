// The values of the parameters of the <dynamics3d> element.
#pragma once

#include "common/configuration/parameter.h"
#include "engine_worker/engines/dynamics3d/ode_world.h"

namespace swarmanoid::dynamics3d
{

struct Settings
{
  double step_seconds = 0.005;
  WorldSettings world;  // gravity still along the axes of the space
  Pose frame;           // of the engine within the space
  double density = 200;
  bool ground = true;
  bool ceiling = false;
  bool arena_walls = false;
  bool solve_all = false;
};

Settings SettingsFrom(const Parameters& parameters);

}  // namespace swarmanoid::dynamics3d
