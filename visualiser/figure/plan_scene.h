// PlanScene: the space as a plan, seen from above. Knows entities and colours, but no page. One thread.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "common/math/pose.h"
#include "visualiser/figure/plan_picture.h"

namespace swarmanoid
{

class CSwarmanoidSpace;

struct PlanOptions
{
  bool ids = false;
  bool trails = false;
};

class PlanScene
{
public:
  // Reads terrains, meshes and pictures of the floor; throws ConfigurationError if one cannot be read. The space must
  // outlive the scene.
  PlanScene(const CSwarmanoidSpace& space, const PlanOptions& options);

  // Records the positions of all entities, for trails. Call it at each tick.
  void Track();
  PlanPicture Draw() const;
  // Returns the legend of the entities that are in the arena now.
  std::vector<PlanLegendEntry> Legend() const;

private:
  // The outline of a user's mesh: unit points times a scale, in the frame of the entity.
  struct MeshOutline
  {
    const std::vector<Vector3>* points;
    Vector3 scale;
  };

  void ReadMeshes();
  // Returns the outline of the entity's mesh or, without a mesh, of its body, turned and tipped as it is.
  std::vector<Vector2> OutlineOf(std::uint32_t entity) const;
  void AddFlat(std::uint32_t entity, PlanPicture& picture) const;
  void AddBody(std::uint32_t entity, PlanPicture& picture) const;
  void AddRobot(std::uint32_t entity, PlanPicture& picture) const;
  void AddLights(std::uint32_t entity, PlanPicture& picture) const;
  void AddTrails(PlanPicture& picture) const;
  void AddHolds(PlanPicture& picture) const;
  std::uint32_t ColourOf(std::uint32_t entity) const;

  const CSwarmanoidSpace& space_;
  const PlanOptions options_;
  std::map<std::uint32_t, PlanShape> images_;  // terrains and painted patches: in the frame of their entity
  std::map<std::string, std::vector<Vector3>> mesh_points_;
  std::map<std::uint32_t, MeshOutline> meshes_;  // by entity, for entities with a mesh
  std::vector<std::vector<Vector2>> trails_;     // by movable entity
};

}  // namespace swarmanoid
