// All models are in one vertex and one index buffer, with a range for each level of each model. A frame uploads all
// instances at once, bucket by bucket, and makes one instanced call for each bucket that is not empty.
#include "visualiser/gl/mesh_store.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "visualiser/gl/shaders.h"

namespace swarmanoid
{
namespace
{

struct GlVertex
{
  std::array<float, 3> position;
  std::array<std::int8_t, 4> normal;
  std::array<std::uint8_t, 4> material;  // number, shade, unused, unused
  std::array<std::uint8_t, 4> colour;    // red, green, blue, unused
};

GlVertex PackedOf(const MeshVertex& vertex)
{
  const auto direction = [&](Eigen::Index axis)
  { return static_cast<std::int8_t>(std::lround(127 * std::clamp(vertex.normal[axis], -1.0F, 1.0F))); };
  const auto shade = static_cast<std::uint8_t>(std::lround(255 * std::clamp(vertex.shade, 0.0F, 1.0F)));
  const auto channel = [&](int shift) { return static_cast<std::uint8_t>((vertex.colour >> shift) & 0xff); };
  return {{vertex.position.x(), vertex.position.y(), vertex.position.z()},
          {direction(0), direction(1), direction(2), 0},
          {static_cast<std::uint8_t>(vertex.material), shade, 0, 0},
          {channel(16), channel(8), channel(0), 0}};
}

const void* Offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

void InstanceAttributes(std::size_t first)
{
  const std::size_t base = first * sizeof(GlInstance);
  const auto attribute = [&](GLuint index, GLint count, GLenum type, GLboolean normalised, std::size_t offset)
  { glVertexAttribPointer(index, count, type, normalised, sizeof(GlInstance), Offset(base + offset)); };
  attribute(kPlaceAttribute, 3, GL_FLOAT, GL_FALSE, offsetof(GlInstance, place));
  attribute(kOrientationAttribute, 4, GL_FLOAT, GL_FALSE, offsetof(GlInstance, orientation));
  attribute(kScaleAttribute, 3, GL_FLOAT, GL_FALSE, offsetof(GlInstance, scale));
  attribute(kTintAttribute, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(GlInstance, tint));
  attribute(kLightsAttribute, 1, GL_FLOAT, GL_FALSE, offsetof(GlInstance, lights));
}

}  // namespace

GlInstance InstanceOf(const SceneItem& item, float opacity)
{
  const auto channel = [&](int shift) { return static_cast<std::uint8_t>((item.tint >> shift) & 0xff); };
  const Eigen::Vector4f turn = item.orientation.coeffs();
  return {{item.position.x(), item.position.y(), item.position.z()},
          {turn.x(), turn.y(), turn.z(), turn.w()},
          {item.scale.x(), item.scale.y(), item.scale.z()},
          {channel(16), channel(8), channel(0), static_cast<std::uint8_t>(std::lround(255 * opacity))},
          static_cast<float>(item.lights)};
}

MeshStore::MeshStore()
{
  glBindVertexArray(array_.Name());
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.Name());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.Name());
  glVertexAttribPointer(kPositionAttribute, 3, GL_FLOAT, GL_FALSE, sizeof(GlVertex),
                        Offset(offsetof(GlVertex, position)));
  glVertexAttribPointer(kNormalAttribute, 3, GL_BYTE, GL_TRUE, sizeof(GlVertex), Offset(offsetof(GlVertex, normal)));
  glVertexAttribPointer(kMaterialAttribute, 2, GL_UNSIGNED_BYTE, GL_FALSE, sizeof(GlVertex),
                        Offset(offsetof(GlVertex, material)));
  glVertexAttribPointer(kColourAttribute, 3, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(GlVertex),
                        Offset(offsetof(GlVertex, colour)));
  for (GLuint attribute = kPositionAttribute; attribute <= kColourAttribute; ++attribute)
  {
    glEnableVertexAttribArray(attribute);
    if (attribute >= kPlaceAttribute && attribute <= kLightsAttribute) glVertexAttribDivisor(attribute, 1);
  }
  glBindVertexArray(0);
}

void MeshStore::SetModels(std::span<const Model> models)
{
  if (models_ == models.data() && ranges_.size() == kLevels * models.size()) return;
  models_ = models.data();
  ranges_.clear();
  std::vector<GlVertex> vertices;
  std::vector<std::uint32_t> indices;
  for (const Model& model : models)
    for (const Mesh& mesh : model.levels)
    {
      ranges_.push_back({static_cast<std::uint32_t>(indices.size()), static_cast<std::int32_t>(vertices.size()),
                         static_cast<std::int32_t>(mesh.indices.size())});
      for (const MeshVertex& vertex : mesh.vertices) vertices.push_back(PackedOf(vertex));
      indices.insert(indices.end(), mesh.indices.begin(), mesh.indices.end());
    }
  glBindVertexArray(array_.Name());
  glBindBuffer(GL_ARRAY_BUFFER, vertices_.Name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(GlVertex)), vertices.data(),
               GL_STATIC_DRAW);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint32_t)), indices.data(),
               GL_STATIC_DRAW);
  glBindVertexArray(0);
}

std::size_t MeshStore::Draw(const InstanceBuckets& instances)
{
  const auto buckets = instances.Buckets();
  upload_.clear();
  for (const std::vector<GlInstance>& bucket : buckets) upload_.insert(upload_.end(), bucket.begin(), bucket.end());
  if (upload_.empty()) return 0;
  glBindVertexArray(array_.Name());
  glBindBuffer(GL_ARRAY_BUFFER, instances_.Name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(upload_.size() * sizeof(GlInstance)), upload_.data(),
               GL_STREAM_DRAW);
  std::size_t first = 0;
  std::size_t triangles = 0;
  for (std::size_t b = 0; b < buckets.size(); ++b)
  {
    const Range& range = ranges_[b];
    const std::size_t count = buckets[b].size();
    if (count > 0 && range.indices > 0)
    {
      InstanceAttributes(first);
      glDrawElementsInstancedBaseVertex(GL_TRIANGLES, range.indices, GL_UNSIGNED_INT,
                                        Offset(range.first_index * sizeof(std::uint32_t)), static_cast<GLsizei>(count),
                                        range.first_vertex);
      triangles += count * static_cast<std::size_t>(range.indices) / 3;
    }
    first += count;
  }
  glBindVertexArray(0);
  return triangles;
}

}  // namespace swarmanoid
