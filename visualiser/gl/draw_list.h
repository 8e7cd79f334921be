// One frame, sorted for drawing: the visible items of a scene with their level of detail and pass. It makes no calls of
// OpenGL.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "visualiser/gl/gl_scene.h"
#include "visualiser/gl/label_atlas.h"
#include "visualiser/gl/mesh_store.h"
#include "visualiser/gl/painted_triangles.h"
#include "visualiser/gl/view_volume.h"

namespace swarmanoid
{

// The layout that the shaders read.
struct GlLine
{
  std::array<float, 3> from, to;
  std::array<float, 4> colour;
  std::array<float, 3> width;  // width and opacity at both ends
};

struct GlGlow
{
  std::array<float, 4> place;  // position and radius
  std::array<float, 4> colour;
  std::array<float, 2> kind;  // flat, strength
};

// Values of GlGlow::kind.
enum GlowStrength
{
  kContact,
  kLight,
  kSpot,
  kDisc
};

// Returns red, green and blue in 0..1.
Eigen::Vector3f ChannelsOf(Colour colour);

struct Frame
{
  // `text_scale`: as for GlScene. Distant robots are at least so many times a few pixels wide.
  void Sort(const Scene& scene, const ViewVolume& view, const SunVolume& sun, const DrawOptions& options,
            float text_scale);
  void SortMarks(const Scene& scene, const LabelAtlas& labels, const Camera& camera, int width, int height);

  InstanceBuckets solid, ground, patches, glass;
  InstanceBuckets casters;    // bodies that throw shadows
  std::vector<GlLine> under;  // lines, hidden by what is in front of them
  std::vector<GlLine> over;   // lines over everything
  std::vector<GlGlow> soft;   // glows on the floor, drawn under everything that is see-through
  std::vector<GlGlow> bright;
  std::vector<GlGlow> points;        // distant robots, as discs
  std::vector<GlPaint> paint;        // triangles of experiment functions, by their corners
  std::vector<GlPaint> clear_paint;  // the see-through ones of these
  std::vector<Glyph> glyphs;
  std::size_t instances = 0;
  float enlargement = 1;  // how much wider than they are robots are drawn, at most

private:
  void SortItem(const SceneItem& item, const Scene& scene, const ViewVolume& view, const SunVolume& sun,
                const DrawOptions& options);
  // Handles the items of a distant robot. Returns false for other items.
  bool AddPoint(std::span<const SceneItem> items, const Scene& scene, const ViewVolume& view, float text_scale);
  void SortDrawn(const DrawnMarks& drawn, const LabelAtlas& labels, const Camera& camera, int width, int height);
  void SortWall(const SceneItem& item, const Scene& scene, const ViewVolume& view);
  void AddUnderglow(const SceneItem& item, const Scene& scene);

  std::vector<char> see_through_;  // by model
};

}  // namespace swarmanoid
