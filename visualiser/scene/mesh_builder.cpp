// Every surface is made of triangles with one normal for each corner: plane faces have a corner of their own for each
// face, so their edges stay sharp, and round ones share the normal of the true surface, so they look round with few
// triangles. Triangles are counterclockwise when seen from outside. A mirrored part reverses their order, or it would
// be seen from inside.
#include "visualiser/scene/mesh_builder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace swarmanoid
{
namespace
{

constexpr float kTurn = 2 * std::numbers::pi_v<float>;

}  // namespace

std::uint32_t MeshBuilder::Vertex(const Eigen::Vector3f& position, const Eigen::Vector3f& normal, Material material)
{
  mesh_.vertices.push_back({place_ * position, place_.linear() * normal, material, shade_, colour_});
  return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
}

void MeshBuilder::Triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c)
{
  mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
}

void MeshBuilder::Face(std::span<const Eigen::Vector3f> corners, Material material)
{
  const Eigen::Vector3f normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  const std::uint32_t first = Vertex(corners[0], normal, material);
  std::uint32_t previous = Vertex(corners[1], normal, material);
  for (std::size_t i = 2; i < corners.size(); ++i)
  {
    const std::uint32_t next = Vertex(corners[i], normal, material);
    Triangle(first, previous, next);
    previous = next;
  }
}

void MeshBuilder::Box(const Eigen::Vector3f& low, const Eigen::Vector3f& high, Material material)
{
  const auto corner = [&](int x, int y, int z)
  { return Eigen::Vector3f(x ? high.x() : low.x(), y ? high.y() : low.y(), z ? high.z() : low.z()); };
  Face({corner(1, 0, 0), corner(1, 1, 0), corner(1, 1, 1), corner(1, 0, 1)}, material);
  Face({corner(0, 1, 0), corner(0, 0, 0), corner(0, 0, 1), corner(0, 1, 1)}, material);
  Face({corner(1, 1, 0), corner(0, 1, 0), corner(0, 1, 1), corner(1, 1, 1)}, material);
  Face({corner(0, 0, 0), corner(1, 0, 0), corner(1, 0, 1), corner(0, 0, 1)}, material);
  Face({corner(0, 0, 1), corner(1, 0, 1), corner(1, 1, 1), corner(0, 1, 1)}, material);
  Face({corner(0, 1, 0), corner(1, 1, 0), corner(1, 0, 0), corner(0, 0, 0)}, material);
}

void MeshBuilder::Band(const ProfilePoint& low, const ProfilePoint& high, float from, float to, int pieces)
{
  const Eigen::Vector2f along(high.radius - low.radius, high.z - low.z);
  const Eigen::Vector2f out = Eigen::Vector2f(along.y(), -along.x()).normalized();
  std::uint32_t previous_low = 0;
  std::uint32_t previous_high = 0;
  for (int i = 0; i <= pieces; ++i)
  {
    const float angle = from + (to - from) * static_cast<float>(i) / static_cast<float>(pieces);
    const float c = std::cos(angle);
    const float s = std::sin(angle);
    const Eigen::Vector3f normal(c * out.x(), s * out.x(), out.y());
    const std::uint32_t a = Vertex({low.radius * c, low.radius * s, low.z}, normal, low.material);
    const std::uint32_t b = Vertex({high.radius * c, high.radius * s, high.z}, normal, low.material);
    if (i > 0)
    {
      if (low.radius > 0) Triangle(previous_low, a, b);
      if (high.radius > 0) Triangle(previous_low, b, previous_high);
    }
    previous_low = a;
    previous_high = b;
  }
}

void MeshBuilder::Turn(std::span<const ProfilePoint> profile)
{
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) Band(profile[i], profile[i + 1], 0, kTurn, segments_);
}

void MeshBuilder::Cylinder(float radius, float low, float high, Material material)
{
  Turn({{0, low, material}, {radius, low, material}, {radius, high, material}, {0, high, material}});
}

void MeshBuilder::Rod(const Eigen::Vector3f& from, const Eigen::Vector3f& to, float radius, Material material)
{
  const Eigen::Isometry3f before = place_;
  const Eigen::Quaternionf turn = Eigen::Quaternionf::FromTwoVectors(Eigen::Vector3f::UnitZ(), to - from);
  place_ = before * (Eigen::Translation3f(from) * turn);
  Cylinder(radius, 0, (to - from).norm(), material);
  place_ = before;
}

void MeshBuilder::Ring(float inner, float outer, float low, float high, Material material)
{
  Turn({{inner, low, material},
        {outer, low, material},
        {outer, high, material},
        {inner, high, material},
        {inner, low, material}});
}

void MeshBuilder::Disc(float radius, float z, Material material) { Turn({{radius, z, material}, {0, z, material}}); }

void MeshBuilder::Sphere(float radius, Material material, bool upper_half)
{
  const int rows = std::max(2, upper_half ? segments_ / 4 : segments_ / 2);
  const int columns = segments_;
  const float start = upper_half ? 0 : -kTurn / 4;
  const auto base = static_cast<std::uint32_t>(mesh_.vertices.size());
  for (int row = 0; row <= rows; ++row)
    for (int column = 0; column <= columns; ++column)
    {
      const float latitude = start + (kTurn / 4 - start) * static_cast<float>(row) / static_cast<float>(rows);
      const float longitude = kTurn * static_cast<float>(column) / static_cast<float>(columns);
      const Eigen::Vector3f normal(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                                   std::sin(latitude));
      Vertex(radius * normal, normal, material);
    }
  const auto at = [&](int row, int column) { return base + static_cast<std::uint32_t>(row * (columns + 1) + column); };
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
    {
      if (row > 0 || upper_half) Triangle(at(row, column), at(row, column + 1), at(row + 1, column + 1));
      if (row + 1 < rows) Triangle(at(row, column), at(row + 1, column + 1), at(row + 1, column));
    }
}

void MeshBuilder::Extrude(std::span<const Eigen::Vector2f> outline, float low, float high, Material side, Material cap)
{
  std::vector<Eigen::Vector3f> front;
  std::vector<Eigen::Vector3f> back;
  for (const Eigen::Vector2f& point : outline) front.emplace_back(point.x(), low, point.y());
  for (auto point = outline.rbegin(); point != outline.rend(); ++point) back.emplace_back(point->x(), high, point->y());
  Face(front, cap);
  Face(back, cap);
  for (std::size_t i = 0; i < outline.size(); ++i)
  {
    const Eigen::Vector2f& a = outline[i];
    const Eigen::Vector2f& b = outline[(i + 1) % outline.size()];
    Face({{b.x(), low, b.y()}, {a.x(), low, a.y()}, {a.x(), high, a.y()}, {b.x(), high, b.y()}}, side);
  }
}

void MeshBuilder::Append(const Mesh& mesh, const Eigen::Affine3f& place, Material material)
{
  const auto base = static_cast<std::uint32_t>(mesh_.vertices.size());
  const Eigen::Matrix3f normals = place.linear().inverse().transpose();
  for (MeshVertex vertex : mesh.vertices)
  {
    vertex.position = place * vertex.position;
    vertex.normal = (normals * vertex.normal).normalized();
    if (vertex.material == Material::kTint)
    {
      vertex.material = material;
      vertex.colour = colour_;
    }
    mesh_.vertices.push_back(vertex);
  }
  const bool is_mirrored = place.linear().determinant() < 0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    for (const std::size_t k : {0U, is_mirrored ? 2U : 1U, is_mirrored ? 1U : 2U})
      mesh_.indices.push_back(base + mesh.indices[i + k]);
}

void Measure(Model& model)
{
  float squared = 0;
  for (const Mesh& mesh : model.levels)
    for (const MeshVertex& vertex : mesh.vertices)
    {
      squared = std::max(squared, vertex.position.squaredNorm());
      model.box.extend(vertex.position);
    }
  model.radius = std::sqrt(squared);
}

}  // namespace swarmanoid
