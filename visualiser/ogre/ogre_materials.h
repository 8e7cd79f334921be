// The materials of ogre_render, made when first needed: one for each colour, because shadows and vertex colours do not
// go together in OGRE's generated shaders. Used by the main thread, while its Root lives.
#pragma once

#include <OgreMaterial.h>

#include <map>
#include <string>
#include <tuple>

#include "visualiser/scene/material.h"

namespace swarmanoid
{

Ogre::ColourValue OgreColour(Colour colour, float opacity = 1);

class OgreMaterials
{
public:
  OgreMaterials();

  // Lit, with the gloss and opacity of `material`, in its colour or in that of an entity.
  Ogre::MaterialPtr Lit(Material material, Colour tint);
  // The floor: plain, or with a grid of one cell a unit if textures are wanted.
  Ogre::MaterialPtr Floor(bool textured);
  // Shining in the colours of the vertices.
  const char* Lights() const { return "swarmanoid/lights"; }
  const char* Lines() const { return "swarmanoid/lines"; }
  const char* LinesOnTop() const { return "swarmanoid/lines_on_top"; }
  const char* Glows() const { return "swarmanoid/glows"; }

private:
  static Ogre::MaterialPtr Make(const std::string& name);
  static void MakeShining(const char* name, bool transparent, bool on_top);
  static void MakeGrid();

  std::map<std::tuple<Colour, float, float>, Ogre::MaterialPtr> lit_;  // by colour, gloss and opacity
};

}  // namespace swarmanoid
