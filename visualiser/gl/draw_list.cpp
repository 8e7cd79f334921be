// Problem: choose what to draw of a scene with thousands of bodies, and how finely.
//
// Method: each item is tested as a sphere against the frustum. The radius of the sphere in pixels chooses one of three
// meshes. Items are sorted into buckets by model and level, so that each bucket is one instanced call. Bodies cast
// shadows by a mesh of at most the middle level, if their sphere reaches the volume of the sun. A tall wall at the edge
// becomes glass over a solid kerb.
//
// A robot of a few pixels is a disc in the colour of its LEDs, without a shadow. Discs have a least size, since robots
// of a pixel would neither be seen nor have a colour.
//
// Invariant: the order of items is that of the scene, so a picture does not depend on earlier frames.
#include "visualiser/gl/draw_list.h"

#include <algorithm>
#include <cmath>

#include "common/space/shape.h"
#include "common/space/space.h"
#include "visualiser/scene/enlargement.h"
#include "visualiser/scene/picking.h"

namespace swarmanoid
{
namespace
{

using Eigen::Vector3f;

// These limits choose the level of detail: a body with a smaller radius (pixels) gets the next one.
constexpr float kNearPixels = 38;
constexpr float kMiddlePixels = 11;

// Diameters of the discs of distant robots, in pixels of a picture with texts
// of the usual size.
constexpr float kPointPixels = 4;     // robots that are wider have meshes
constexpr float kLeastPixels = 2.6F;  // more would fill the horizon
constexpr Colour kUnlit = 0x59626c;

std::array<float, 4> Components(Colour colour, float opacity = 1)
{
  const auto channel = [&](int shift) { return static_cast<float>((colour >> shift) & 0xff) / 255; };
  return {channel(16), channel(8), channel(0), opacity};
}

bool IsSeeThrough(const Model& model)
{
  const Mesh& mesh = model.levels[0];
  return !mesh.vertices.empty() && LookOf(mesh.vertices[0].material).opacity < 1;
}

}  // namespace

Eigen::Vector3f ChannelsOf(Colour colour)
{
  const auto c = Components(colour);
  return {c[0], c[1], c[2]};
}

void Frame::Sort(const Scene& scene, const ViewVolume& view, const SunVolume& sun, const DrawOptions& options,
                 float text_scale)
{
  const std::span<const Model> models = scene.Models();
  see_through_.resize(models.size());
  for (std::size_t m = 0; m < models.size(); ++m) see_through_[m] = IsSeeThrough(models[m]);
  for (InstanceBuckets* buckets : {&solid, &ground, &patches, &glass, &casters})
  {
    buckets->Resize(models.size());
    buckets->Clear();
  }
  instances = 0;
  enlargement = 1;
  over.clear();
  under.clear();
  soft.clear();
  bright.clear();
  points.clear();

  const std::span<const SceneItem> items = scene.Items();
  for (std::size_t first = 0, end = 0; first < items.size(); first = end)
  {
    for (end = first + 1; end < items.size() && items[end].entity == items[first].entity;) ++end;
    const std::span<const SceneItem> of_entity = items.subspan(first, end - first);
    if (AddPoint(of_entity, scene, view, text_scale)) continue;
    for (const SceneItem& item : of_entity) SortItem(item, scene, view, sun, options);
  }
}

void Frame::SortItem(const SceneItem& item, const Scene& scene, const ViewVolume& view, const SunVolume& sun,
                     const DrawOptions& options)
{
  using Role = SceneItem::Role;
  if (item.role == Role::kFloor || !item.present) return;
  const Model& model = scene.Models()[item.model];
  const float radius = model.radius * item.scale.maxCoeff();
  const float pixels = view.PixelsOf(item.position, radius);
  const int level = pixels > kNearPixels ? 0 : pixels > kMiddlePixels ? 1 : 2;
  if (view.Sees(item.position, radius))
  {
    ++instances;
    if (item.role == Role::kPatch)
      patches.Add(item.model, level, InstanceOf(item));
    else if (see_through_[item.model])
      glass.Add(item.model, level, InstanceOf(item, LookOf(model.levels[0].vertices[0].material).opacity));
    else if (item.role == Role::kWall && options.glass_walls)
      SortWall(item, scene, view);
    else
      (model.is_terrain ? ground : solid).Add(item.model, level, InstanceOf(item));
    if (item.role == Role::kBody && pixels > kMiddlePixels) AddUnderglow(item, scene);
  }
  if (!options.shadows || item.role != Role::kBody || see_through_[item.model] || !sun.Holds(item.position, radius))
    return;
  // At a distance the shadow of a footbot's turret is covered by that of the whole robot.
  const bool hidden = level == 2 && item.model == static_cast<std::uint16_t>(ModelId::kFootbotBase);
  // A terrain throws shadows on itself, so that both passes must use the same surface.
  if (!hidden) casters.Add(item.model, model.is_terrain ? level : std::max(level, 1), InstanceOf(item));
}

bool Frame::AddPoint(std::span<const SceneItem> items, const Scene& scene, const ViewVolume& view, float text_scale)
{
  const SceneItem& first = items.front();
  if (first.entity == kNoEntity || first.role != SceneItem::Role::kBody || !first.present) return false;
  const CSwarmanoidSpaceEntity& robot = scene.Space().GetEntity(first.entity);
  if (!IsRobot(robot.GetKind())) return false;
  const Shape shape = ShapeOf(robot.GetConfiguration());
  const Vector3f middle = scene.Space().GetPose(first.entity).Apply(shape.centre).cast<float>();
  const auto radius = static_cast<float>(shape.half_size.head<2>().maxCoeff());
  const float width = 2 * view.PixelsOf(middle, radius);
  if (width >= kPointPixels * text_scale) return false;
  const float larger = Enlargement(width, kLeastPixels * text_scale);
  if (!view.Sees(middle, larger * radius)) return true;
  ++instances;
  enlargement = std::max(enlargement, larger);

  Vector3f sum = Vector3f::Zero();
  int lit = 0;
  const auto lights = std::ranges::find_if(items, [](const SceneItem& item) { return item.lights >= 0; });
  for (int light = 0; lights != items.end() && light < kLightsPerRobot; ++light)
    if (const Colour colour = scene.Lights()[static_cast<std::size_t>(lights->lights + light)]; colour != 0)
    {
      sum += ChannelsOf(colour);
      ++lit;
    }
  const Vector3f colour = lit > 0 ? Vector3f(sum / static_cast<float>(lit)) : ChannelsOf(kUnlit);
  // The soft edge of the disc takes half a pixel more. The disc stands before the floor, which its lower half would
  // meet otherwise.
  const float drawn = larger * radius * (1 + 1 / (larger * width));
  const Vector3f place = middle + drawn * (view.eye - middle).normalized();
  points.push_back({{place.x(), place.y(), place.z(), drawn}, {colour.x(), colour.y(), colour.z(), 1}, {0, kDisc}});
  return true;
}

// Cuts tall walls open: glass over a solid lower part, with the upper edge drawn.
void Frame::SortWall(const SceneItem& item, const Scene& scene, const ViewVolume& view)
{
  const EntityConfiguration& wall = scene.Space().GetEntity(item.entity).GetConfiguration();
  const Vector3 eye = view.eye.cast<double>();
  const bool hides = HidesArena(wall, scene.ArenaSize(), eye);
  const float height = item.scale.z();
  const float cut = SolidHeight(wall, scene.ArenaSize(), eye);
  if (height <= cut) return solid.Add(item.model, 0, InstanceOf(item));
  glass.Add(item.model, 0, InstanceOf(item, hides ? 0.04F : 0.07F));
  SceneItem kerb = item;
  kerb.scale.z() = cut;
  kerb.position += kerb.orientation * Vector3f(0, 0, (kerb.scale.z() - height) / 2);
  solid.Add(item.model, 0, InstanceOf(kerb));
  const auto corner = [&](float x, float y, float z)
  { return Vector3f(item.position + item.orientation * Vector3f(x, y, z).cwiseProduct(item.scale / 2)); };
  const auto edge = [&](const Vector3f& from, const Vector3f& to)
  {
    under.push_back(
        {{from.x(), from.y(), from.z()}, {to.x(), to.y(), to.z()}, {0.55F, 0.57F, 0.6F, 1}, {1, 0.25F, 0.25F}});
  };
  edge(corner(-1, -1, 1), corner(1, -1, 1));
  edge(corner(1, -1, 1), corner(1, 1, 1));
  edge(corner(1, 1, 1), corner(-1, 1, 1));
  edge(corner(-1, 1, 1), corner(-1, -1, 1));
}

// Adds a soft dark spot where a body meets the floor, and the light of its LEDs on the floor.
void Frame::AddUnderglow(const SceneItem& item, const Scene& scene)
{
  const auto model = static_cast<ModelId>(item.model);
  const bool robot = model == ModelId::kFootbotBase || model == ModelId::kHandbotBody;
  if (!robot && model != ModelId::kCylinder) return;
  if (item.position.z() > 0.05F || item.position.z() < -0.05F) return;
  const float radius = robot ? 0.085F : item.scale.x();
  soft.push_back({{item.position.x(), item.position.y(), item.position.z(), radius * 1.7F},
                  {0.08F, 0.09F, 0.12F, 0.55F},
                  {1, kContact}});
  if (item.lights < 0) return;
  Vector3f sum = Vector3f::Zero();
  int lit = 0;
  for (int led = 0; led < 12; ++led)
    if (const Colour colour = scene.Lights()[static_cast<std::size_t>(item.lights + led)]; colour != 0)
    {
      sum += ChannelsOf(colour);
      ++lit;
    }
  if (lit == 0) return;
  sum /= static_cast<float>(lit);
  // Many colours together light the floor without a hue.
  const float hue = (sum.maxCoeff() - sum.minCoeff()) / sum.maxCoeff();
  soft.push_back({{item.position.x(), item.position.y(), item.position.z(), radius * 3.2F},
                  {sum.x(), sum.y(), sum.z(), (0.06F + 0.24F * hue) * static_cast<float>(lit) / 12},
                  {1, kLight}});
}

void Frame::SortMarks(const Scene& scene, const LabelAtlas& labels, const Camera& camera, int width, int height)
{
  for (const SceneLine& line : scene.Lines())
  {
    const GlLine gl{{line.from.x(), line.from.y(), line.from.z()},
                    {line.to.x(), line.to.y(), line.to.z()},
                    Components(line.colour),
                    {line.width, line.opacity_from, line.opacity_to}};
    (line.on_top ? over : under).push_back(gl);
  }
  for (const SceneGlow& glow : scene.Glows())
    bright.push_back({{glow.position.x(), glow.position.y(), glow.position.z(), glow.radius},
                      Components(glow.colour, 0.4F),
                      {glow.flat ? 1.0F : 0.0F, static_cast<float>(glow.flat ? kSpot : kLight)}});
  glyphs.clear();
  for (const SceneLabel& label : scene.Labels())
  {
    const Vector3 pixel = camera.Project(label.position.cast<double>(), width, height);
    if (pixel.z() > 0) labels.Append(label.text, static_cast<float>(pixel.x()), static_cast<float>(pixel.y()), glyphs);
  }
  SortDrawn(scene.Drawn(), labels, camera, width, height);
}

void Frame::SortDrawn(const DrawnMarks& drawn, const LabelAtlas& labels, const Camera& camera, int width, int height)
{
  const auto line = [&](const Vector3f& from, const Vector3f& to, Colour colour, float line_width, float opacity)
  {
    under.push_back(
        {{from.x(), from.y(), from.z()}, {to.x(), to.y(), to.z()}, Components(colour), {line_width, opacity, opacity}});
  };
  for (const DrawnMarks::Line& one : drawn.lines)
    if (one.from != one.to) line(one.from, one.to, one.colour, one.width, one.opacity);
  for (const DrawnMarks::Dot& dot : drawn.dots) line(dot.place, dot.place, dot.colour, dot.diameter, dot.opacity);
  paint.clear();
  clear_paint.clear();
  for (const DrawnMarks::Triangle& triangle : drawn.triangles)
    for (const Vector3f& corner : triangle.corners)
      (triangle.opacity < 1 ? clear_paint : paint)
          .push_back({{corner.x(), corner.y(), corner.z()}, Components(triangle.colour, triangle.opacity)});
  for (const DrawnMarks::Text& text : drawn.texts)
  {
    const Vector3 pixel = camera.Project(text.place.cast<double>(), width, height);
    if (pixel.z() > 0)
      labels.AppendPlain(text.text, static_cast<float>(pixel.x()), static_cast<float>(pixel.y()),
                         Components(text.colour, text.opacity), glyphs);
  }
}

}  // namespace swarmanoid
