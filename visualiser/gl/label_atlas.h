// The letters of labels as a texture, from the font DejaVu Sans.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "visualiser/gl/gl_object.h"

namespace swarmanoid
{

// The layout that the text shader reads: pixels of the picture, positions in the atlas, colour.
struct Glyph
{
  std::array<float, 4> place;
  std::array<float, 4> texture;
  std::array<float, 4> colour;
};

class LabelAtlas
{
public:
  // `scale`: of the letters, which are 15 pixels high at 1. Without the font (Debian's fonts-dejavu-core) it prints a
  // message, and labels stay empty.
  explicit LabelAtlas(float scale);

  GLuint Texture() const { return texture_.Name(); }
  bool IsEmpty() const { return glyphs_.empty(); }
  // Adds a text on a light plate, with its middle above x, y (pixels). Letters outside ASCII become '?'.
  void Append(std::string_view text, float x, float y, std::vector<Glyph>& glyphs) const;
  // Adds the same, with the first letter at x, y (pixels).
  void AppendFrom(std::string_view text, float x, float y, std::vector<Glyph>& glyphs) const;
  // Adds the text from there, without a plate, in that colour and opacity.
  void AppendPlain(std::string_view text, float x, float y, const std::array<float, 4>& colour,
                   std::vector<Glyph>& glyphs) const;

private:
  struct BakedGlyph
  {
    std::array<float, 4> texture;
    float left, top, right, bottom;  // relative to the pen
    float advance;
  };

  const BakedGlyph& GlyphOf(char c) const;
  float WidthOf(std::string_view text) const;

  float scale_;
  float white_ = 0;  // the coordinate in the atlas where it is white
  GlObject texture_{GlObject::Kind::kTexture};
  std::vector<BakedGlyph> glyphs_;  // from ' ' to '~'
};

}  // namespace swarmanoid
