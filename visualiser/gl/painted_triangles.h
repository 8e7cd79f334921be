// Draws triangles in the colours of their corners, without light.
#pragma once

#include <array>
#include <span>

#include "visualiser/gl/gl_object.h"

namespace swarmanoid
{

// The layout that the shader reads.
struct GlPaint
{
  std::array<float, 3> place;
  std::array<float, 4> colour;
};

class PaintedTriangles
{
public:
  PaintedTriangles()
  {
    glBindVertexArray(array_.Name());
    glBindBuffer(GL_ARRAY_BUFFER, corners_.Name());
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(GlPaint), nullptr);
    glEnableVertexAttribArray(1);
    glVertexAttribPointer(1, 4, GL_FLOAT, GL_FALSE, sizeof(GlPaint), reinterpret_cast<const void*>(3 * sizeof(float)));
    glBindVertexArray(0);
  }

  void Draw(std::span<const GlPaint> corners) const
  {
    if (corners.empty()) return;
    glBindVertexArray(array_.Name());
    glBindBuffer(GL_ARRAY_BUFFER, corners_.Name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size_bytes()), corners.data(), GL_STREAM_DRAW);
    glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(corners.size()));
    glBindVertexArray(0);
  }

private:
  GlObject array_{GlObject::Kind::kVertexArray};
  GlObject corners_{GlObject::Kind::kBuffer};
};

}  // namespace swarmanoid
