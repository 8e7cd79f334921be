// The letters of ASCII are drawn once into a texture. A text is a quadrangle for each letter, at whole pixels so that
// letters stay sharp, in front of one for the plate, which uses a white place of the same texture.
#include "visualiser/gl/label_atlas.h"

#include <stb_truetype.h>

#include <cstdio>
#include <fstream>
#include <iterator>

#include "visualiser/scene/material.h"

namespace swarmanoid
{
namespace
{

constexpr int kSide = 256;                // pixels, of the atlas
constexpr float kHeight = 15;             // pixels, of the letters
constexpr float kWhite = 253.5F / kSide;  // coordinate in the atlas where it is white
constexpr int kFirst = ' ';
constexpr int kCount = '~' - ' ' + 1;

std::vector<unsigned char> ReadFont()
{
  for (const char* path : {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf",
                           "/usr/share/fonts/dejavu/DejaVuSans.ttf"})
  {
    std::ifstream file(path, std::ios::binary);
    if (file) return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
  return {};
}

}  // namespace

LabelAtlas::LabelAtlas()
{
  const std::vector<unsigned char> font = ReadFont();
  if (font.empty())
  {
    std::fputs("labels are not drawn: there is no font DejaVuSans.ttf; install the package fonts-dejavu-core\n",
               stderr);
    return;
  }
  std::vector<unsigned char> bitmap(kSide * kSide);
  std::array<stbtt_bakedchar, kCount> baked;
  stbtt_BakeFontBitmap(font.data(), 0, kHeight, bitmap.data(), kSide, kSide, kFirst, kCount, baked.data());
  for (int y = kSide - 5; y < kSide; ++y)
    for (int x = kSide - 5; x < kSide; ++x) bitmap[static_cast<std::size_t>(y * kSide + x)] = 255;
  for (const stbtt_bakedchar& letter : baked)
  {
    const auto width = static_cast<float>(letter.x1 - letter.x0);
    const auto height = static_cast<float>(letter.y1 - letter.y0);
    glyphs_.push_back({{static_cast<float>(letter.x0) / kSide, static_cast<float>(letter.y0) / kSide,
                        static_cast<float>(letter.x1) / kSide, static_cast<float>(letter.y1) / kSide},
                       letter.xoff,
                       letter.yoff,
                       letter.xoff + width,
                       letter.yoff + height,
                       letter.xadvance});
  }
  glBindTexture(GL_TEXTURE_2D, texture_.Name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, kSide, kSide, 0, GL_RED, GL_UNSIGNED_BYTE, bitmap.data());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glBindTexture(GL_TEXTURE_2D, 0);
}

const LabelAtlas::BakedGlyph& LabelAtlas::GlyphOf(char c) const
{
  const bool known = c >= ' ' && c <= '~';
  return glyphs_[static_cast<std::size_t>((known ? c : '?') - kFirst)];
}

float LabelAtlas::WidthOf(std::string_view text) const
{
  float width = 0;
  for (const char c : text) width += GlyphOf(c).advance;
  return width;
}

void LabelAtlas::Append(std::string_view text, float x, float y, std::vector<Glyph>& glyphs) const
{
  if (!IsEmpty()) AppendFrom(text, x - WidthOf(text) / 2, y - 10, glyphs);
}

void LabelAtlas::AppendFrom(std::string_view text, float x, float y, std::vector<Glyph>& glyphs) const
{
  if (IsEmpty()) return;
  const auto channel = [](int shift) { return static_cast<float>((palette::kLabel >> shift) & 0xff) / 255; };
  const float pen = std::round(x);
  const float line = std::round(y);
  glyphs.push_back(
      {{pen - 5, line - 14, pen + WidthOf(text) + 5, line + 5}, {kWhite, kWhite, kWhite, kWhite}, {1, 1, 1, 0.78F}});
  AppendPlain(text, x, y, {channel(16), channel(8), channel(0), 1}, glyphs);
}

void LabelAtlas::AppendPlain(std::string_view text, float x, float y, const std::array<float, 4>& colour,
                             std::vector<Glyph>& glyphs) const
{
  if (IsEmpty()) return;
  float pen = std::round(x);
  const float line = std::round(y);
  for (const char c : text)
  {
    // Only the first byte of a UTF-8 character counts.
    if ((static_cast<unsigned char>(c) & 0xc0U) == 0x80) continue;
    const BakedGlyph& l = GlyphOf(c);
    glyphs.push_back({{pen + l.left, line + l.top, pen + l.right, line + l.bottom}, l.texture, colour});
    pen = std::round(pen + l.advance);
  }
}

}  // namespace swarmanoid
