// The model of a kind is built from its description. If the description has parts, they are used. Otherwise the body is
// a box or a cylinder of the kind's size; a robot has a dark part on top that shows its front, and its LEDs. Each part
// is built in three levels of detail. A kind without a size gets a model of size 1, which is scaled for each entity.
#include "visualiser/scene/kind_model.h"

#include <algorithm>
#include <iterator>

#include "common/configuration/regular_file.h"
#include "common/experiment/mesh_files.h"
#include "visualiser/scene/mesh_builder.h"
#include "visualiser/scene/mesh_file.h"

namespace swarmanoid
{
namespace
{

using Eigen::Vector3f;

constexpr float kLedRadius = 0.004F;  // m
constexpr int kSegments[kLevels] = {32, 14, 8};

Material MaterialOf(const MeshPart& part)
{
  switch (part.paint)
  {
    case MeshPart::Paint::kBody:
      return Material::kTint;
    case MeshPart::Paint::kDark:
      return Material::kDark;
    case MeshPart::Paint::kShell:
      return Material::kShell;
    case MeshPart::Paint::kMetal:
      return Material::kMetal;
    case MeshPart::Paint::kRubber:
      return Material::kRubber;
    case MeshPart::Paint::kGlass:
      return Material::kGlass;
    case MeshPart::Paint::kLed:
      return LedMaterial(part.led);
    case MeshPart::Paint::kBeacon:
      return Material::kBeacon;
    case MeshPart::Paint::kOwn:
      return Material::kPainted;
  }
  return Material::kTint;
}

MeshPart Rod(double radius, double low, double high)
{
  return {.form = MeshPart::Form::kRod, .from = {0, 0, low}, .to = {0, 0, high}, .radius = radius};
}

std::vector<MeshPart> BodyParts(const EntityKindDescription& kind)
{
  const Vector3 size = IsScaled(kind) ? Vector3::Ones() : kind.size;
  const double low = kind.origin == BodyOrigin::kBase ? 0 : -size.z() / 2;
  const bool is_robot = kind.role == EntityRole::kRobot;
  // The upper third of a robot shows where its front is, and its LEDs.
  const double top = low + size.z() * (is_robot ? 0.75 : 1);
  std::vector<MeshPart> parts;
  const bool is_box = kind.form == BodyForm::kBox;
  if (is_box)
    parts.push_back({.from = {-size.x() / 2, -size.y() / 2, low}, .to = {size.x() / 2, size.y() / 2, top}});
  else
    parts.push_back(Rod(size.x(), low, top));
  if (!is_robot) return parts;
  const double front = is_box ? size.x() / 2 : size.x();
  parts.push_back({.from = {front / 2, -front / 8, top},
                   .to = {front, front / 8, low + size.z()},
                   .paint = MeshPart::Paint::kDark});
  if (!kind.leds) return parts;
  for (std::size_t led = 0; led < kind.leds->places.size(); ++led)
  {
    const Vector2& place = kind.leds->places[led];
    parts.push_back({.form = MeshPart::Form::kBall,
                     .from = {place.x(), place.y(), kind.leds->height_m},
                     .radius = kLedRadius,
                     .paint = MeshPart::Paint::kLed,
                     .led = static_cast<int>(led)});
  }
  if (kind.beacon_height_m)
    parts.push_back({.form = MeshPart::Form::kBall,
                     .from = {0, 0, *kind.beacon_height_m},
                     .radius = kLedRadius,
                     .paint = MeshPart::Paint::kBeacon});
  return parts;
}

void AddFile(MeshBuilder& builder, const MeshPart& part, int level, const Experiment& experiment)
{
  const std::string path = FindMeshOfKind(part.file, experiment);
  try
  {
    const auto place = Eigen::Translation3f(part.from.cast<float>()) * part.orientation.cast<float>() *
                       Eigen::Scaling(Vector3f(part.scale.cast<float>()));
    builder.Append(LoadMeshFile(path)->levels[static_cast<std::size_t>(level)], place, MaterialOf(part));
  }
  catch (const FileError& error)
  {
    throw ConfigurationError({std::make_shared<const std::string>(path), 0, 0}, error.what());
  }
}

void AddPart(MeshBuilder& builder, const MeshPart& part, int level, const Experiment& experiment)
{
  const Vector3f from = part.from.cast<float>();
  const Vector3f to = part.to.cast<float>();
  const auto radius = static_cast<float>(part.radius);
  const Material material = MaterialOf(part);
  builder.SetColour(part.colour);
  switch (part.form)
  {
    case MeshPart::Form::kBox:
      builder.Box(from.cwiseMin(to), from.cwiseMax(to), material);
      break;
    case MeshPart::Form::kRod:
      builder.Rod(from, to, radius, material);
      break;
    case MeshPart::Form::kBall:
      builder.SetPlace(from.x(), from.y(), from.z());
      builder.Sphere(radius, material);
      builder.SetPlace(0, 0, 0);
      break;
    case MeshPart::Form::kFile:
      AddFile(builder, part, level, experiment);
      break;
  }
}

}  // namespace

bool IsScaled(const EntityKindDescription& kind) { return kind.mesh.empty() && kind.size.isZero(); }

namespace
{

// Returns the model of some parts. Those of links are moved by the motion of their link, if motions are given.
Model ModelOf(const std::string& name, const std::vector<MeshPart>& parts, const std::vector<Pose>& motions,
              const Experiment& experiment)
{
  Model model;
  model.name = name;
  for (int level = 0; level < kLevels; ++level)
  {
    MeshBuilder builder(kSegments[level]);
    for (const MeshPart& part : parts)
    {
      if (part.link == MovingLink::kBase || motions.empty())
      {
        AddPart(builder, part, level, experiment);
        continue;
      }
      const Pose& motion = motions[static_cast<std::size_t>(part.link)];
      MeshBuilder at_zero(kSegments[level]);
      AddPart(at_zero, part, level, experiment);
      builder.Append(
          at_zero.Take(),
          Eigen::Translation3f(motion.position.cast<float>()) * Eigen::Affine3f(motion.orientation.cast<float>()),
          Material::kTint);
    }
    model.levels[static_cast<std::size_t>(level)] = builder.Take();
  }
  Measure(model);
  return model;
}

}  // namespace

Model KindModel(const EntityKindDescription& kind, const Experiment& experiment)
{
  const std::vector<MeshPart> parts = kind.mesh.empty() ? BodyParts(kind) : kind.mesh;
  std::vector<double> starts;
  for (const MovingLink& link : kind.links) starts.push_back(link.Start());
  return ModelOf(kind.tag, parts, MotionsOfLinks(kind.links, starts), experiment);
}

std::vector<Model> LinkModels(const EntityKindDescription& kind, const Experiment& experiment)
{
  if (kind.links.empty()) return {KindModel(kind, experiment)};
  const std::vector<MeshPart> all = kind.mesh.empty() ? BodyParts(kind) : kind.mesh;
  std::vector<Model> models;
  for (int link = MovingLink::kBase; link < static_cast<int>(kind.links.size()); ++link)
  {
    std::vector<MeshPart> parts;
    std::ranges::copy_if(all, std::back_inserter(parts), [&](const MeshPart& part) { return part.link == link; });
    const std::string name =
        link == MovingLink::kBase ? kind.tag : kind.tag + "_" + kind.links[static_cast<std::size_t>(link)].joint;
    models.push_back(ModelOf(name, parts, {}, experiment));
  }
  return models;
}

}  // namespace swarmanoid
