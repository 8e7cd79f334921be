#include "visualiser/ogre/ogre_materials.h"

#include <fmt/format.h>

#include <OgreHardwarePixelBuffer.h>
#include <OgreMaterialManager.h>
#include <OgrePass.h>
#include <OgreTechnique.h>
#include <OgreTextureManager.h>

namespace swarmanoid
{
namespace
{

const Ogre::String kGroup = Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME;
constexpr Ogre::uint32 kCellPixels = 256;
constexpr Ogre::uint32 kGridPixels = 2 * kCellPixels;
constexpr Ogre::uint32 kLinePixels = 3;
// Every other cell is darker, so that cells are told apart where lines are too thin to be seen.
constexpr float kOtherCells = 0.965F;

Ogre::Pass* PassOf(const Ogre::MaterialPtr& material) { return material->getTechnique(0)->getPass(0); }

}  // namespace

Ogre::ColourValue OgreColour(Colour colour, float opacity)
{
  const auto channel = [&](int shift) { return static_cast<float>((colour >> shift) & 0xff) / 255; };
  return Ogre::ColourValue(channel(16), channel(8), channel(0), opacity);
}

OgreMaterials::OgreMaterials()
{
  MakeShining(Lights(), false, false);
  MakeShining(Lines(), true, false);
  MakeShining(LinesOnTop(), true, true);
  MakeShining(Glows(), true, false);
  MakeGrid();
}

Ogre::MaterialPtr OgreMaterials::Make(const std::string& name)
{
  return Ogre::MaterialManager::getSingleton().create(name, kGroup);
}

Ogre::MaterialPtr OgreMaterials::Lit(Material material, Colour tint)
{
  const MaterialLook& look = LookOf(material);
  const Colour colour = look.takes_tint || look.is_painted ? tint : look.colour;
  Ogre::MaterialPtr& made = lit_[{colour, look.gloss, look.opacity}];
  if (made) return made;
  made = Make(fmt::format("swarmanoid/lit_{:06x}_{}_{}", colour, look.gloss, look.opacity));
  Ogre::Pass* pass = PassOf(made);
  pass->setAmbient(OgreColour(colour));
  pass->setDiffuse(OgreColour(colour, look.opacity));
  const float shine = 0.5F * look.gloss;
  pass->setSpecular(shine, shine, shine, 1);
  pass->setShininess(8 + 60 * look.gloss);
  if (look.opacity < 1)
  {
    pass->setSceneBlending(Ogre::SBT_TRANSPARENT_ALPHA);
    pass->setDepthWriteEnabled(false);
    pass->setCullingMode(Ogre::CULL_NONE);
    made->setReceiveShadows(false);
  }
  return made;
}

Ogre::MaterialPtr OgreMaterials::Floor(bool textured)
{
  const std::string name = textured ? "swarmanoid/floor_grid" : "swarmanoid/floor";
  if (Ogre::MaterialPtr known = Ogre::MaterialManager::getSingleton().getByName(name, kGroup)) return known;
  Ogre::MaterialPtr made = Make(name);
  Ogre::Pass* pass = PassOf(made);
  const Ogre::ColourValue colour = textured ? Ogre::ColourValue::White : OgreColour(palette::kFloor);
  pass->setAmbient(colour);
  pass->setDiffuse(colour);
  if (textured)
  {
    Ogre::TextureUnitState* unit = pass->createTextureUnitState("swarmanoid/grid");
    unit->setTextureAnisotropy(8);
    unit->setTextureFiltering(Ogre::TFO_ANISOTROPIC);
  }
  return made;
}

void OgreMaterials::MakeShining(const char* name, bool transparent, bool on_top)
{
  const Ogre::MaterialPtr made = Make(name);
  Ogre::Pass* pass = PassOf(made);
  pass->setLightingEnabled(false);
  pass->setVertexColourTracking(Ogre::TVC_DIFFUSE);
  pass->setCullingMode(Ogre::CULL_NONE);
  made->setReceiveShadows(false);
  if (!transparent) return;
  pass->setSceneBlending(Ogre::SBT_TRANSPARENT_ALPHA);
  pass->setDepthWriteEnabled(false);
  pass->setDepthCheckEnabled(!on_top);
}

// Makes two by two cells of the floor, with lines along two edges of each.
void OgreMaterials::MakeGrid()
{
  const Ogre::TexturePtr texture = Ogre::TextureManager::getSingleton().createManual(
      "swarmanoid/grid", kGroup, Ogre::TEX_TYPE_2D, kGridPixels, kGridPixels, Ogre::MIP_DEFAULT, Ogre::PF_BYTE_RGB,
      Ogre::TU_DEFAULT | Ogre::TU_AUTOMIPMAP);
  std::vector<Ogre::uint8> pixels;
  pixels.reserve(3 * kGridPixels * kGridPixels);
  for (Ogre::uint32 y = 0; y < kGridPixels; ++y)
    for (Ogre::uint32 x = 0; x < kGridPixels; ++x)
    {
      const bool is_line = x % kCellPixels < kLinePixels || y % kCellPixels < kLinePixels;
      const bool is_other = !is_line && (x < kCellPixels) != (y < kCellPixels);
      const Colour colour = is_line ? palette::kFloorLine : palette::kFloor;
      for (const int shift : {16, 8, 0})
        pixels.push_back(
            static_cast<Ogre::uint8>(static_cast<float>(colour >> shift & 0xff) * (is_other ? kOtherCells : 1)));
    }
  texture->getBuffer()->blitFromMemory(Ogre::PixelBox(kGridPixels, kGridPixels, 1, Ogre::PF_BYTE_RGB, pixels.data()));
}

}  // namespace swarmanoid
