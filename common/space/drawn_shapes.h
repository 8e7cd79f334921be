// The shapes that renderers draw, one by one: the fields on the floor, and what experiment functions draw.
#pragma once

#include <span>
#include <string_view>

#include "common/space/drawn_fields.h"
#include "common/space/space.h"

namespace swarmanoid
{

// Calls draw(shape, numbers, text, frame) for each shape, except those of entities outside the arena. `numbers` belong
// to the shape during the call, and `text` to the space. The coordinates are in `frame`.
template <class Draw>
void ForEachDrawnShape(const CSwarmanoidSpace& space, const Draw& draw)
{
  const auto draw_all = [&](const Drawing& drawing)
  {
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
  };
  Drawing fields;
  DrawFields(space, fields);
  draw_all(fields);
  draw_all(space.GetDrawing());
}

}  // namespace swarmanoid
