// The letters of labels as a texture, from the font DejaVu Sans.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "visualiser/gl/gl_object.h"

namespace swarmanoid
{

// As the text shader reads it: pixels of the picture, places in the atlas, colour.
struct Glyph
{
  std::array<float, 4> place;
  std::array<float, 4> texture;
  std::array<float, 4> colour;
};

class LabelAtlas
{
public:
  // Without the font (Debian's fonts-dejavu-core) a message is printed, and labels stay empty.
  LabelAtlas();

  GLuint Texture() const { return texture_.Name(); }
  bool IsEmpty() const { return glyphs_.empty(); }
  // A text on a light plate, its middle above x, y (pixels). Letters outside ASCII become '?'.
  void Append(std::string_view text, float x, float y, std::vector<Glyph>& glyphs) const;
  // The same from a place to the right: x, y (pixels) is where the first letter stands.
  void AppendFrom(std::string_view text, float x, float y, std::vector<Glyph>& glyphs) const;
  // Likewise, without a plate, in that colour and opacity.
  void AppendPlain(std::string_view text, float x, float y, const std::array<float, 4>& colour,
                   std::vector<Glyph>& glyphs) const;

private:
  struct BakedGlyph
  {
    std::array<float, 4> texture;
    float left, top, right, bottom;  // from the pen
    float advance;
  };

  const BakedGlyph& GlyphOf(char c) const;
  float WidthOf(std::string_view text) const;

  GlObject texture_{GlObject::Kind::kTexture};
  std::vector<BakedGlyph> glyphs_;  // from ' ' to '~'
};

}  // namespace swarmanoid
