// One frame, sorted for drawing: what is seen of a scene, at which level of detail, in which pass. No calls of OpenGL.
#pragma once

#include <array>
#include <vector>

#include "visualiser/gl/gl_scene.h"
#include "visualiser/gl/label_atlas.h"
#include "visualiser/gl/mesh_store.h"
#include "visualiser/gl/painted_triangles.h"
#include "visualiser/gl/view_volume.h"

namespace swarmanoid
{

// As the shaders read them.
struct GlLine
{
  std::array<float, 3> from, to;
  std::array<float, 4> colour;
  std::array<float, 3> width;  // and opacity at both ends
};

struct GlGlow
{
  std::array<float, 4> place;  // and radius
  std::array<float, 4> colour;
  std::array<float, 2> kind;  // flat, strength
};

// Of GlGlow::kind.
enum GlowStrength
{
  kContact,
  kLight,
  kSpot
};

// Red, green, blue: 0..1.
Eigen::Vector3f ChannelsOf(Colour colour);

struct Frame
{
  void Sort(const Scene& scene, const ViewVolume& view, const SunVolume& sun, const DrawOptions& options);
  void SortMarks(const Scene& scene, const LabelAtlas& labels, const Camera& camera, int width, int height);

  InstanceBuckets solid, ground, patches, glass;
  InstanceBuckets casters;    // of shadows
  std::vector<GlLine> under;  // lines, hidden by what is in front of them
  std::vector<GlLine> over;   // lines over everything
  std::vector<GlGlow> soft;   // on the floor, under everything that is see-through
  std::vector<GlGlow> bright;
  std::vector<GlPaint> paint;        // what experiment functions draw: corners of triangles
  std::vector<GlPaint> clear_paint;  // see-through
  std::vector<Glyph> glyphs;
  std::size_t instances = 0;

private:
  void SortDrawn(const DrawnMarks& drawn, const LabelAtlas& labels, const Camera& camera, int width, int height);
  void SortWall(const SceneItem& item, const Scene& scene, const ViewVolume& view);
  void AddUnderglow(const SceneItem& item, const Scene& scene);
};

}  // namespace swarmanoid
