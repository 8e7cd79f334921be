#include "visualiser/web/drawn_links.h"

#include <algorithm>
#include <cmath>

#include "common/space/space.h"
#include "visualiser/scene/kind_model.h"

namespace swarmanoid
{
namespace
{

// A colour at this part of its brightness.
Colour Dimmed(Colour colour, float part)
{
  Colour dimmed = 0;
  for (const unsigned shift : {0U, 8U, 16U})
  {
    const auto channel = static_cast<float>((colour >> shift) & 0xffU);
    dimmed |= static_cast<Colour>(std::lround(channel * part)) << shift;
  }
  return dimmed;
}

}  // namespace

DrawnLinks::DrawnLinks(const CSwarmanoidSpace& space) : space_(space)
{
  for (std::uint32_t e = 0; e < space.Size(); ++e)
  {
    const CSwarmanoidSpaceEntity& entity = space.GetEntity(e);
    const EntityKindDescription& kind = DescriptionOf(entity.GetKind());
    if (kind.links.empty()) continue;
    robots_.push_back({e, entity.SlotOf(kind.links.front().attribute)});
    if (!models_.contains(entity.GetKind())) models_.emplace(entity.GetKind(), LinkModels(kind, space.GetExperiment()));
  }
}

void DrawnLinks::Add(std::vector<DrawnMarks::Triangle>& triangles) const
{
  std::vector<double> positions;
  for (const Robot& robot : robots_)
  {
    const CSwarmanoidSpaceEntity& entity = space_.GetEntity(robot.entity);
    if (!space_.IsPresent(robot.entity)) continue;
    const EntityKindDescription& kind = DescriptionOf(entity.GetKind());
    positions.clear();
    for (std::uint32_t k = 0; k < kind.links.size(); ++k)
      positions.push_back(space_.Attributes()[robot.first_slot + k]);
    const std::vector<Pose> motions = MotionsOfLinks(kind.links, positions);
    const std::vector<Model>& models = models_.at(entity.GetKind());
    for (std::size_t link = 0; link < kind.links.size(); ++link)
    {
      const Mesh& mesh = models[link + 1].levels.back();
      if (triangles.size() + mesh.Triangles() > kMostTriangles) return;
      const Pose pose = space_.GetPose(robot.entity).Compose(motions[link]);
      const Eigen::Isometry3f place(Eigen::Translation3f(pose.position.cast<float>()) * pose.orientation.cast<float>());
      for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
      {
        DrawnMarks::Triangle& triangle = triangles.emplace_back();
        for (std::size_t corner = 0; corner < 3; ++corner)
          triangle.corners[corner] = place * mesh.vertices[mesh.indices[i + corner]].position;
        const MeshVertex& vertex = mesh.vertices[mesh.indices[i]];
        const float up = (place.linear() * vertex.normal).z();
        triangle.colour =
            Dimmed(vertex.material == Material::kPainted ? vertex.colour : Paint(kind.colour), 0.75F + 0.25F * up);
        triangle.opacity = 1;
      }
    }
  }
}

}  // namespace swarmanoid
