// The plain bodies of entities: where their surfaces are.
#include "common/experiment/collision_body.h"

#include <gtest/gtest.h>

namespace swarmanoid
{
namespace
{

EntityConfiguration OfKind(EntityKind kind)
{
  EntityConfiguration entity;
  entity.kind = kind;
  entity.size = {0.2, 0.3, 0.5};
  return entity;
}

TEST(PlainBodies, ReachFromTheGroundToTheHeightOfTheEntity)
{
  int cylinders = 0;
  int boxes = 0;
  for (int number = 0; number <= static_cast<int>(EntityKind::kChargingStation); ++number)
  {
    const auto kind = static_cast<EntityKind>(number);
    const EntityKindDescription& description = DescriptionOf(kind);
    std::vector<CollisionBody> bodies;
    AddPlainBody(OfKind(kind), bodies);
    if (description.form == BodyForm::kNone)
    {
      EXPECT_TRUE(bodies.empty()) << TagName(kind);
      continue;
    }
    ASSERT_EQ(bodies.size(), 1U) << TagName(kind);
    const CollisionBody& body = bodies[0];
    const double low = body.pose.position.z() - body.half_size.z();
    const double high = body.pose.position.z() + body.half_size.z();
    const double bottom = description.origin == BodyOrigin::kBase ? 0 : -0.25;
    EXPECT_DOUBLE_EQ(low, bottom) << TagName(kind);
    EXPECT_DOUBLE_EQ(high, bottom + 0.5) << TagName(kind);
    EXPECT_EQ(body.is_cylinder, description.form == BodyForm::kCylinder) << TagName(kind);
    // The first side of a cylinder is its radius.
    EXPECT_DOUBLE_EQ(body.half_size.x(), body.is_cylinder ? 0.2 : 0.1) << TagName(kind);
    EXPECT_DOUBLE_EQ(body.half_size.y(), body.is_cylinder ? 0.2 : 0.15) << TagName(kind);
    ++(body.is_cylinder ? cylinders : boxes);
  }
  EXPECT_GE(cylinders, 3);
  EXPECT_GT(boxes, 1);
}

}  // namespace
}  // namespace swarmanoid
