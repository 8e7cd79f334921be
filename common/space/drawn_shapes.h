// The shapes that experiment functions draw, one by one, for renderers.
#pragma once

#include <span>
#include <string_view>

#include "common/space/space.h"

namespace swarmanoid
{

// Calls draw(shape, numbers, text, frame) for each shape, except those of entities outside the arena. `numbers` and
// `text` belong to the shape, and its coordinates are in `frame`.
template <class Draw>
void ForEachDrawnShape(const CSwarmanoidSpace& space, const Draw& draw)
{
  const Drawing& drawing = space.GetDrawing();
  std::size_t number = 0;
  std::size_t text = 0;
  for (const DrawnShape& shape : drawing.shapes)
  {
    const std::span<const float> numbers(&drawing.numbers[number], shape.count);
    number += shape.count;
    const std::string_view words = shape.kind == DrawnShape::Kind::kText ? drawing.texts[text++] : std::string_view();
    if (shape.frame > 0 && !space.IsPresent(shape.frame - 1)) continue;
    draw(shape, numbers, words, shape.frame > 0 ? space.GetPose(shape.frame - 1) : Pose());
  }
}

}  // namespace swarmanoid
