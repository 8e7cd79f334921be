// The materials of ogre_render, made at first use. Each colour has one, because OGRE's generated shaders cannot combine
// shadows and vertex colours. The main thread uses it, while its Root lives.
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

  // Returns a lit material with the gloss and opacity of `material`, in its colour or in that of an entity.
  Ogre::MaterialPtr Lit(Material material, Colour tint);
  // Returns the floor: plain, or with a grid of one cell a unit if textures are wanted.
  Ogre::MaterialPtr Floor(bool textured);
  // Returns a material that shines in the colours of the vertices.
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
