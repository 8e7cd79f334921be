// The models of a scene in graphics memory, and the instances of one frame, grouped by mesh.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "visualiser/gl/gl_object.h"
#include "visualiser/scene/mesh.h"
#include "visualiser/scene/scene.h"

namespace swarmanoid
{

// The layout that the vertex shader reads.
struct GlInstance
{
  std::array<float, 3> place;
  std::array<float, 4> orientation;  // x, y, z, w
  std::array<float, 3> scale;
  std::array<std::uint8_t, 4> tint;  // colour and opacity
  float lights;
};

GlInstance InstanceOf(const SceneItem& item, float opacity = 1);

// The instances of one pass, in one bucket for each model and level.
class InstanceBuckets
{
public:
  void Resize(std::size_t models) { buckets_.resize(kLevels * models); }
  void Clear()
  {
    for (std::vector<GlInstance>& bucket : buckets_) bucket.clear();
  }
  void Add(std::size_t model, int level, const GlInstance& instance)
  {
    buckets_[kLevels * model + static_cast<std::size_t>(level)].push_back(instance);
  }
  std::span<const std::vector<GlInstance>> Buckets() const { return buckets_; }

private:
  std::vector<std::vector<GlInstance>> buckets_;
};

class MeshStore
{
public:
  MeshStore();
  // Uploads the models if they differ from the last ones.
  void SetModels(std::span<const Model> models);
  // Draws all buckets with the program in use. Returns the number of triangles.
  std::size_t Draw(const InstanceBuckets& instances);

private:
  struct Range
  {
    std::uint32_t first_index = 0;
    std::int32_t first_vertex = 0;
    std::int32_t indices = 0;
  };

  GlObject array_{GlObject::Kind::kVertexArray};
  GlObject vertices_{GlObject::Kind::kBuffer};
  GlObject indices_{GlObject::Kind::kBuffer};
  GlObject instances_{GlObject::Kind::kBuffer};
  std::vector<Range> ranges_;
  std::vector<GlInstance> upload_;
  const Model* models_ = nullptr;
};

}  // namespace swarmanoid
