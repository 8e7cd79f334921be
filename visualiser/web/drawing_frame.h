// The binary message with parts of the state and drawings of experiment functions, little-endian. docs/web_render.md
// specifies it. Only web_render uses it.
#pragma once

#include <cstdint>
#include <string>

#include "common/space/drawn_state.h"
#include "visualiser/scene/drawn_marks.h"

namespace swarmanoid
{

inline constexpr std::uint32_t kDrawingMagic = 0x344d5753;  // "SWM4"

struct DrawingHeader
{
  std::uint32_t magic = kDrawingMagic;
  std::uint32_t lines = 0;
  std::uint32_t triangles = 0;
  std::uint32_t dots = 0;
  std::uint64_t tick = 0;
  std::uint32_t text_bytes = 0;  // at the end: JSON, for each text [x, y, z, 0xRRGGBBAA, "text"]
  std::uint32_t unused = 0;
};
static_assert(sizeof(DrawingHeader) == 32);

struct DrawingLine
{
  float from[3], to[3];
  std::uint32_t colour;  // 0xRRGGBBAA
  float width;           // pixels
};
static_assert(sizeof(DrawingLine) == 32);

struct DrawingTriangle
{
  float corners[9];
  std::uint32_t colour;
};
static_assert(sizeof(DrawingTriangle) == 40);

struct DrawingDot
{
  float place[3];
  std::uint32_t colour;
  float diameter;  // pixels
};
static_assert(sizeof(DrawingDot) == 20);

class DrawnLinks;

// Returns the message for the current tick, with the moving links of robots if `links` has them.
std::string DrawingBytes(const DrawnState& state, const DrawnLinks* links = nullptr);

}  // namespace swarmanoid
