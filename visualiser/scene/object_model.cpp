#include "visualiser/scene/object_model.h"

#include <fmt/format.h>

#include "common/configuration/regular_file.h"
#include "common/experiment/mesh_files.h"
#include "common/math/elementary.h"
#include "common/mesh/convex_hull.h"
#include "visualiser/scene/mesh_builder.h"
#include "visualiser/scene/mesh_file.h"

namespace swarmanoid
{
namespace
{

using Eigen::Vector3f;

constexpr float kThinnest = 1e-6F;  // m: flatter meshes cannot be stretched

// Returns a body of size 1, which Scene and pages scale.
Eigen::AlignedBox3f BodyOfSizeOne(const EntityKindDescription& kind)
{
  const float half = kind.form == BodyForm::kCylinder ? 1 : 0.5F;
  const float low = kind.origin == BodyOrigin::kBase ? 0 : -0.5F;
  return {Vector3f(-half, -half, low), Vector3f(half, half, low + 1)};
}

Vector3 OrientationIn(const EntityConfiguration& entity)
{
  return entity.tree.GetVector3("mesh_orientation", Vector3::Zero());
}

// Without a mesh, a hull is drawn as it collides.
bool IsDrawnAsHull(const EntityConfiguration& entity)
{
  const EntityKindDescription& kind = DescriptionOf(entity.kind);
  return entity.hull != nullptr && kind.role == EntityRole::kObject && kind.mesh.empty();
}

Vector3f OfSizeOne(const Vector3& corner, const EntityConfiguration& entity)
{
  return corner.cwiseQuotient(entity.size).cast<float>();
}

Model HullModel(const EntityConfiguration& entity)
{
  MeshBuilder builder(0);
  std::vector<Vector3f> corners;
  for (const ConvexHull::Face& face : entity.hull->faces)
  {
    corners.clear();
    for (const std::uint32_t corner : face.corners) corners.push_back(OfSizeOne(entity.hull->corners[corner], entity));
    builder.Face(corners, Material::kTint);
  }
  Model model;
  model.levels.fill(builder.Take());
  return model;
}

}  // namespace

std::string ObjectModelName(const EntityConfiguration& entity, const std::string& experiment_folder)
{
  const std::string path = MeshOfEntity(entity, experiment_folder);
  if (path.empty() && IsDrawnAsHull(entity))
  {
    std::string name = "hull";
    for (const Vector3& corner : entity.hull->corners)
    {
      const Vector3f place = OfSizeOne(corner, entity);
      name += fmt::format(" {},{},{}", place.x(), place.y(), place.z());
    }
    return name;
  }
  if (path.empty()) return path;
  const EntityKindDescription& kind = DescriptionOf(entity.kind);
  const Vector3 turned = OrientationIn(entity);
  return fmt::format("{} {} {} {} {} {}", static_cast<int>(kind.form), static_cast<int>(kind.origin), turned.x(),
                     turned.y(), turned.z(), path);
}

Model ObjectModel(const EntityConfiguration& entity, const std::string& experiment_folder)
{
  const std::string path = MeshOfEntity(entity, experiment_folder);
  if (path.empty())
  {
    Model hull = HullModel(entity);
    hull.name = ObjectModelName(entity, experiment_folder);
    Measure(hull);
    return hull;
  }
  std::shared_ptr<const MeshFile> file;
  try
  {
    file = LoadMeshFile(path);
  }
  catch (const FileError& error)
  {
    throw ConfigurationError(entity.tree.ValueLocation("mesh"), fmt::format("'{}': {}", path, error.what()));
  }
  const Vector3 degrees = OrientationIn(entity);
  const Eigen::Quaternionf turn =
      QuaternionFromEuler({DegreesToRadians(degrees.x()), DegreesToRadians(degrees.y()), DegreesToRadians(degrees.z())})
          .cast<float>();
  Eigen::AlignedBox3f box;
  for (const MeshVertex& vertex : file->levels[0].vertices) box.extend(turn * vertex.position);
  const Eigen::AlignedBox3f body = BodyOfSizeOne(DescriptionOf(entity.kind));
  const Vector3f stretch = body.sizes().cwiseQuotient(box.sizes().cwiseMax(kThinnest));
  const Eigen::Affine3f place = Eigen::Translation3f(body.center()) * Eigen::Scaling(stretch) * turn *
                                Eigen::Translation3f(-(turn.conjugate() * box.center()));
  Model model;
  model.name = ObjectModelName(entity, experiment_folder);
  for (std::size_t level = 0; level < kLevels; ++level)
  {
    MeshBuilder builder(0);
    builder.Append(file->levels[level], place, Material::kTint);
    model.levels[level] = builder.Take();
  }
  Measure(model);
  return model;
}

}  // namespace swarmanoid
