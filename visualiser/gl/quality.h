// Applies the shared parameters of view_parameters.h to a scene and its drawing.
#pragma once

#include "common/configuration/parameter.h"
#include "visualiser/gl/gl_scene.h"

namespace swarmanoid
{

inline DrawOptions DrawOptionsOf(const Parameters& parameters)
{
  DrawOptions options;
  options.shadows = parameters.Boolean("use_shadows");
  options.textures = parameters.Boolean("use_textures");
  options.samples = static_cast<int>(parameters.Integer("antialiasing"));
  return options;
}

inline SceneOptions SceneOptionsOf(const Parameters& parameters)
{
  SceneOptions options;
  options.ids = parameters.Boolean("show_ids");
  options.trails = parameters.Boolean("show_trails");
  options.rays = parameters.Boolean("show_rays");
  options.collision_models = parameters.Boolean("show_collision_models");
  return options;
}

}  // namespace swarmanoid
