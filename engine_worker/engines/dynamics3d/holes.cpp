// Holes in the ground plane: pits with walls and a bottom.
#include <algorithm>

#include "engine_worker/engines/dynamics3d/dynamics3d_engine.h"

namespace swarmanoid
{
namespace
{

using namespace dynamics3d;

constexpr double kPitDepth = 0.5;       // m
constexpr double kWallThickness = 0.1;  // m
constexpr double kRim = 0.03;           // m below the ground where the walls start: a body on the rim is the ground's

// The horizontal outline of a hole in the frame of its entity.
struct Outline
{
  Pose inverse;  // of the entity, in the frame of the engine
  double half_x = 0;
  double half_y = 0;
  bool round = false;

  bool Contains(const Vector3& point) const
  {
    const Vector3 local = inverse.Apply(point);
    if (round) return local.x() * local.x() + local.y() * local.y() < half_x * half_x;
    return std::abs(local.x()) < half_x && std::abs(local.y()) < half_y;
  }
};

Outline OutlineOf(const CSwarmanoidSpaceEntity& hole, const Frame& frame)
{
  const bool round = hole.GetConfiguration().tree.Value("radius").has_value();
  const Vector3& size = hole.GetSize();
  Outline outline;
  outline.inverse = frame.ToLocal(hole.GetPose()).Inverse();
  outline.half_x = round ? size.x() : size.x() / 2;
  outline.half_y = round ? size.x() : size.y() / 2;
  outline.round = round;
  return outline;
}

StaticOutline OutlineInPlane(const Outline& hole)
{
  const Pose pose = hole.inverse.Inverse();
  if (hole.round) return {{pose.position.head<2>()}, hole.half_x};
  const auto corner = [&](double x, double y) -> Vector2 {
    return pose.Apply({x * hole.half_x, y * hole.half_y, 0}).head<2>();
  };
  return {.corners = {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)}};
}

}  // namespace

void CDynamics3dEngine::AddHoles()
{
  if (holes_.empty() || !settings_.ground) return;
  std::vector<Outline> outlines;
  for (const CSwarmanoidSpaceEntity* hole : holes_)
  {
    const Outline outline = OutlineOf(*hole, scene_->frame);
    const Pose pose = outline.inverse.Inverse();
    outlines.push_back(outline);
    groups_->FreeRobots().AddHole(OutlineInPlane(outline));
    world_->BeginEntity(kNoEntity);
    for (const int axis : {0, 1})
    {
      for (const double side : {1.0, -1.0})
      {
        Vector3 size(2 * outline.half_x, 2 * outline.half_y, kPitDepth);
        size[axis] = kWallThickness;
        Vector3 centre(0, 0, -kRim - kPitDepth / 2);
        centre[axis] = side * ((axis == 0 ? outline.half_x : outline.half_y) + kWallThickness / 2);
        const RawPose raw = RawOf(pose.Compose({centre, Quaternion::Identity()}));
        const dGeomID wall = dCreateBox(nullptr, size.x(), size.y(), size.z());
        dGeomSetPosition(wall, raw.position[0], raw.position[1], raw.position[2]);
        dGeomSetQuaternion(wall, raw.quaternion);
        world_->AddSolid(wall, -1, ELayer::kStatic);
      }
    }
  }
  world_->BeginEntity(kNoEntity);
  world_->AddSolid(dCreatePlane(nullptr, 0, 0, 1, -kPitDepth), -1, ELayer::kStatic, ESurface::kTerrain);
  world_->SetOpenings(
      [outlines](const Vector3& point)
      {
        return std::any_of(outlines.begin(), outlines.end(),
                           [&](const Outline& outline) { return outline.Contains(point); });
      });
}

}  // namespace swarmanoid
