// Builds meshes from boxes, turned profiles, bands and plates. Lengths are in metres, z is up.
#pragma once

#include <span>
#include <vector>

#include "visualiser/scene/mesh.h"

namespace swarmanoid
{

// A point of a turned profile: distance from the axis and height, with the material of the surface that leads to the
// next point.
struct ProfilePoint
{
  float radius;
  float z;
  Material material = Material::kTint;
};

class MeshBuilder
{
public:
  // `segments` is the number of segments of a full circle.
  explicit MeshBuilder(int segments) : segments_(segments) {}

  // Sets the transform of the following shapes to the frame of the mesh.
  void SetPlace(const Eigen::Isometry3f& place) { place_ = place; }
  void SetPlace(float x, float y, float z) { place_ = Eigen::Isometry3f(Eigen::Translation3f(x, y, z)); }
  void SetShade(float shade) { shade_ = shade; }
  void SetColour(Colour colour) { colour_ = colour; }  // for Material::kPainted
  void SetSegments(int segments) { segments_ = segments; }

  // Adds a box between two corners.
  void Box(const Eigen::Vector3f& low, const Eigen::Vector3f& high, Material material);
  // Adds a profile turned about the z axis. Seen with the axis on the left, a profile that goes upwards has its outside
  // on the right. Normals are flat along the profile and round about the axis.
  void Turn(std::span<const ProfilePoint> profile);
  void Turn(std::initializer_list<ProfilePoint> profile) { Turn(std::span(profile.begin(), profile.size())); }
  // Adds a part of a turned surface, between two angles (radians).
  void Band(const ProfilePoint& low, const ProfilePoint& high, float from, float to, int pieces);
  void Cylinder(float radius, float low, float high, Material material);
  // Adds a round rod between two points.
  void Rod(const Eigen::Vector3f& from, const Eigen::Vector3f& to, float radius, Material material);
  // Adds a ring with a rectangular section.
  void Ring(float inner, float outer, float low, float high, Material material);
  void Disc(float radius, float z, Material material);
  // Adds the upper half of a sphere about the origin of the place, or all of it.
  void Sphere(float radius, Material material, bool upper_half = false);
  // Adds an outline in the x, z plane (counter-clockwise seen against y), extruded from y = low to y = high.
  void Extrude(std::span<const Eigen::Vector2f> outline, float low, float high, Material side, Material cap);
  // Adds a triangle or a convex quadrangle, counter-clockwise seen from outside.
  void Face(std::span<const Eigen::Vector3f> corners, Material material);
  void Face(std::initializer_list<Eigen::Vector3f> corners, Material material)
  {
    Face(std::span(corners.begin(), corners.size()), material);
  }

  // Adds another mesh with this transform alone. Its parts with Material::kTint get `material`.
  void Append(const Mesh& mesh, const Eigen::Affine3f& place, Material material);

  Mesh Take() { return std::move(mesh_); }

private:
  std::uint32_t Vertex(const Eigen::Vector3f& position, const Eigen::Vector3f& normal, Material material);
  void Triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);

  int segments_;
  float shade_ = 1;
  Colour colour_ = 0xffffff;
  Eigen::Isometry3f place_ = Eigen::Isometry3f::Identity();
  Mesh mesh_;
};

// Sets radius and box from the levels.
void Measure(Model& model);

}  // namespace swarmanoid
