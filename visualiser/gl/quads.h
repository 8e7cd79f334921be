// Instanced quadrangles, each with one plain struct of floats: lines, glows, glyphs.
#pragma once

#include <span>
#include <vector>

#include "visualiser/gl/gl_object.h"

namespace swarmanoid
{

template <class Instance>
class Quads
{
public:
  // `attributes` has the floats of each instanced attribute, at locations 1, 2 … in this order.
  explicit Quads(std::initializer_list<int> attributes)
  {
    glBindVertexArray(array_.Name());
    static constexpr float kCorners[] = {0, 0, 1, 0, 0, 1, 1, 1};
    glBindBuffer(GL_ARRAY_BUFFER, corners_.Name());
    glBufferData(GL_ARRAY_BUFFER, sizeof kCorners, kCorners, GL_STATIC_DRAW);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, 0, nullptr);
    glBindBuffer(GL_ARRAY_BUFFER, instances_.Name());
    std::size_t offset = 0;
    GLuint location = 1;
    for (const int floats : attributes)
    {
      glEnableVertexAttribArray(location);
      glVertexAttribPointer(location, floats, GL_FLOAT, GL_FALSE, sizeof(Instance),
                            reinterpret_cast<const void*>(offset));
      glVertexAttribDivisor(location, 1);
      offset += static_cast<std::size_t>(floats) * sizeof(float);
      ++location;
    }
    glBindVertexArray(0);
  }

  void Draw(std::span<const Instance> instances) const
  {
    if (instances.empty()) return;
    glBindVertexArray(array_.Name());
    glBindBuffer(GL_ARRAY_BUFFER, instances_.Name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(instances.size_bytes()), instances.data(), GL_STREAM_DRAW);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(instances.size()));
    glBindVertexArray(0);
  }
  // Draws one quadrangle without instanced attributes.
  void DrawOne() const
  {
    glBindVertexArray(array_.Name());
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    glBindVertexArray(0);
  }

private:
  GlObject array_{GlObject::Kind::kVertexArray};
  GlObject corners_{GlObject::Kind::kBuffer};
  GlObject instances_{GlObject::Kind::kBuffer};
};

}  // namespace swarmanoid
