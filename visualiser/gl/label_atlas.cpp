// The letters of ASCII are drawn once into a texture. A text is a quadrangle for each letter, at whole pixels so that
// letters stay sharp, in front of one for the plate, which uses a white place of the same texture.
#include "visualiser/gl/label_atlas.h"

#include <stb_truetype.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "visualiser/scene/material.h"

namespace swarmanoid
{
namespace
{

constexpr int kSide = 256;     // pixels, of the atlas at scale 1
constexpr float kHeight = 15;  // pixels, of the letters at scale 1
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

LabelAtlas::LabelAtlas(float scale) : scale_(scale)
{
  const std::vector<unsigned char> font = ReadFont();
  if (font.empty())
  {
    std::fputs("labels are not drawn: there is no font DejaVuSans.ttf; install the package fonts-dejavu-core\n",
               stderr);
    return;
  }
  const int side = kSide * static_cast<int>(std::ceil(scale));
  const auto size = static_cast<float>(side);
  white_ = (size - 2.5F) / size;
  std::vector<unsigned char> bitmap(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  std::array<stbtt_bakedchar, kCount> baked;
  stbtt_BakeFontBitmap(font.data(), 0, kHeight * scale, bitmap.data(), side, side, kFirst, kCount, baked.data());
  for (int y = side - 5; y < side; ++y)
    for (int x = side - 5; x < side; ++x) bitmap[static_cast<std::size_t>(y * side + x)] = 255;
  for (const stbtt_bakedchar& letter : baked)
  {
    const auto width = static_cast<float>(letter.x1 - letter.x0);
    const auto height = static_cast<float>(letter.y1 - letter.y0);
    glyphs_.push_back({{static_cast<float>(letter.x0) / size, static_cast<float>(letter.y0) / size,
                        static_cast<float>(letter.x1) / size, static_cast<float>(letter.y1) / size},
                       letter.xoff,
                       letter.yoff,
                       letter.xoff + width,
                       letter.yoff + height,
                       letter.xadvance});
  }
  glBindTexture(GL_TEXTURE_2D, texture_.Name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, side, side, 0, GL_RED, GL_UNSIGNED_BYTE, bitmap.data());
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
  if (!IsEmpty()) AppendFrom(text, x - WidthOf(text) / 2, y - 10 * scale_, glyphs);
}

void LabelAtlas::AppendFrom(std::string_view text, float x, float y, std::vector<Glyph>& glyphs) const
{
  if (IsEmpty()) return;
  const auto channel = [](int shift) { return static_cast<float>((palette::kLabel >> shift) & 0xff) / 255; };
  const float pen = std::round(x);
  const float line = std::round(y);
  const float margin = 5 * scale_;
  glyphs.push_back({{pen - margin, line - 14 * scale_, pen + WidthOf(text) + margin, line + margin},
                    {white_, white_, white_, white_},
                    {1, 1, 1, 0.78F}});
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
