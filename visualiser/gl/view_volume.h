// The volume that the camera sees, the volume of the sun's shadow map, and the level of detail of a body.
#pragma once

#include <array>

#include "visualiser/scene/camera.h"
#include "visualiser/scene/scene.h"

namespace swarmanoid
{

struct ViewVolume
{
  // `low` and `high` are the bounds of all content.
  ViewVolume(const Camera& camera, int width, int height, const Vector3& low, const Vector3& high);

  // Returns whether a sphere may be visible; it may return true for a sphere near an edge.
  bool Sees(const Eigen::Vector3f& centre, float radius) const;
  // Returns the radius of a sphere in pixels.
  float PixelsOf(const Eigen::Vector3f& centre, float radius) const;

  Eigen::Matrix4f view_projection;
  std::array<Eigen::Vector4f, 5> planes;  // pointing inwards
  Eigen::Vector3f eye;
  Eigen::Vector3f forward;
  float pixels_per_slope;  // pixels of an object of size 1 at distance 1
  double near, far;
  // The bounds of the visible ground, within the bounds of the content.
  Vector3 seen_low, seen_high;
};

// The view of a light that is far away.
struct SunVolume
{
  SunVolume(const Vector3& towards_sun, const Vector3& low, const Vector3& high);

  // Returns whether a sphere may throw a shadow into the volume.
  bool Holds(const Eigen::Vector3f& centre, float radius) const;

  Eigen::Matrix4f view_projection;  // maps to -1..1
  Eigen::Matrix4f to_texture;       // maps to 0..1
  float depth;                      // m
  float width;                      // m, the larger side
};

}  // namespace swarmanoid
