#include "common/experiment/collision_body.h"

namespace swarmanoid
{

void AddPlainBody(const EntityConfiguration& entity, std::vector<CollisionBody>& bodies)
{
  const EntityKindDescription& kind = DescriptionOf(entity.kind);
  if (kind.form == BodyForm::kNone) return;
  const Vector3 at = kind.origin == BodyOrigin::kBase ? Vector3(0, 0, entity.size.z() / 2) : Vector3(0, 0, 0);
  const Pose centre{at, Quaternion::Identity()};
  if (kind.form == BodyForm::kCylinder)
    bodies.push_back({true, centre, {entity.size.x(), entity.size.x(), entity.size.z() / 2}});
  else
    bodies.push_back({false, centre, entity.size / 2, entity.hull.get()});
}

}  // namespace swarmanoid
