// The shapes that renderers draw, one by one: parts of the state, and what experiment functions draw.
#pragma once

#include <span>
#include <string_view>

#include "common/space/drawn_state.h"
#include "common/space/space.h"

namespace swarmanoid
{

// Calls draw(shape, numbers, text, frame) for each shape, except those of entities outside the arena. `numbers` and
// `text` belong to the shape during the call. The coordinates are in `frame`.
template <class Draw>
void ForEachDrawnShape(const DrawnState& state, const Draw& draw)
{
  const CSwarmanoidSpace& space = state.Space();
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
  Drawing of_state;
  state.Draw(of_state);
  draw_all(of_state);
  draw_all(space.GetDrawing());
}

}  // namespace swarmanoid
