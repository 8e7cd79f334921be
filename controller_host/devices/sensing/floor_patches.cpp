#include "controller_host/devices/sensing/floor_patches.h"

#include "common/experiment/entity_kind.h"
#include "common/space/space.h"

namespace swarmanoid
{

std::vector<FloorPatch> FloorPatchesOf(const CSwarmanoidSpace& space)
{
  std::vector<FloorPatch> patches;
  for (std::uint32_t e = 0; e < space.Size(); ++e)
  {
    const CSwarmanoidSpaceEntity& entity = space.GetEntity(e);
    const EntityRole role = DescriptionOf(entity.GetKind()).role;
    const bool is_hole = role == EntityRole::kHole;
    if (!is_hole && role != EntityRole::kPatch) continue;
    // A rectangle (x, y, 0), or a disc (radius, 0, 0).
    const Vector3& size = entity.GetSize();
    FloorPatch patch{e, is_hole, size.y() == 0, is_hole ? 0 : entity.SlotOf("colour"), size.x() / 2, size.y() / 2,
                     0, {},      nullptr};
    if (!is_hole) patch.picture = LoadFloorPicture(entity.GetConfiguration(), space.GetExperiment().folder);
    if (patch.is_disc) patch.half_x = size.x();
    patch.radius = __builtin_sqrt(patch.half_x * patch.half_x + patch.half_y * patch.half_y);
    patches.push_back(patch);
  }
  return patches;
}

}  // namespace swarmanoid
