// What the camera sees, what the sun's shadow map has to hold, and how much detail a body needs.
#pragma once

#include <array>

#include "visualiser/scene/camera.h"
#include "visualiser/scene/scene.h"

namespace swarmanoid
{

struct ViewVolume
{
  // low, high: of all that there is.
  ViewVolume(const Camera& camera, int width, int height, const Vector3& low, const Vector3& high);

  bool Sees(const Eigen::Vector3f& centre, float radius) const;
  // The radius in pixels of a sphere.
  float PixelsOf(const Eigen::Vector3f& centre, float radius) const;

  Eigen::Matrix4f view_projection;
  std::array<Eigen::Vector4f, 5> planes;  // pointing inwards
  Eigen::Vector3f eye;
  Eigen::Vector3f forward;
  float pixels_per_slope;  // of a thing of size 1 at distance 1
  double near, far;
  // Of the ground that is seen, within the bounds.
  Vector3 seen_low, seen_high;
};

// A light from far away.
struct SunVolume
{
  SunVolume(const Vector3& towards_sun, const Vector3& low, const Vector3& high);

  bool Holds(const Eigen::Vector3f& centre, float radius) const;

  Eigen::Matrix4f view_projection;  // to -1..1
  Eigen::Matrix4f to_texture;       // to 0..1
  float depth;                      // m
  float width;                      // m, the larger side
};

}  // namespace swarmanoid
