// Meshes: triangles with normals and a material for each vertex. Plain values without any graphics library, so that
// every renderer uploads the same ones.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "visualiser/scene/material.h"

namespace swarmanoid
{

struct MeshVertex
{
  Eigen::Vector3f position;
  Eigen::Vector3f normal;  // unit vector
  Material material = Material::kTint;
  float shade = 1;           // 0..1: the part of the sky's light that reaches it; less in corners
  Colour colour = 0xffffff;  // for Material::kPainted
};

// Triangles are counter-clockwise seen from outside; the three vertices of one have the same material and colour.
struct Mesh
{
  std::vector<MeshVertex> vertices;
  std::vector<std::uint32_t> indices;

  std::size_t Triangles() const { return indices.size() / 3; }
};

inline constexpr int kLevels = 3;  // levels of detail: 0 near, 2 far away

struct Model
{
  std::string name;
  std::array<Mesh, kLevels> levels;
  float radius = 0;         // m: of the sphere about the origin that contains it
  Eigen::AlignedBox3f box;  // the box that contains it
  bool is_terrain = false;
};

}  // namespace swarmanoid
