// The shader programs of the GL renderer, GLSL 3.30.
#pragma once

#include "visualiser/gl/gl_object.h"

namespace swarmanoid
{

struct Shaders
{
  Shaders();

  GlProgram body;    // instances of meshes with light, shadow and fog
  GlProgram caster;  // the same bodies in the shadow map
  GlProgram floor;   // the floor of the arena and the ground around it
  GlProgram sky;
  GlProgram line;
  GlProgram glow;
  GlProgram text;
  GlProgram paint;  // triangles in the colours of their corners
};

// The locations of the vertex attributes of body and caster.
enum BodyAttribute : GLuint
{
  kPositionAttribute,
  kNormalAttribute,
  kMaterialAttribute,
  kPlaceAttribute,
  kOrientationAttribute,
  kScaleAttribute,
  kTintAttribute,
  kLightsAttribute,
  kColourAttribute
};

}  // namespace swarmanoid
