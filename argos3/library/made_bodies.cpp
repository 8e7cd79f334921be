#include "argos3/library/made_bodies.h"

#include <algorithm>

#include <argos3/plugins/simulator/entities/box_entity.h>
#include <argos3/plugins/simulator/entities/cylinder_entity.h>

#include "common/space/space.h"

namespace swarmanoid::argos3
{

std::optional<BodyShape> ShapeOf(const argos::CEntity& made)
{
  if (const auto* box = dynamic_cast<const argos::CBoxEntity*>(&made))
  {
    const argos::CVector3& size = box->GetSize();
    return BodyShape{kLitBox,
                     box->GetEmbodiedEntity().IsMovable(),
                     std::min(box->GetMass(), kHeaviestKg),
                     {size.GetX(), size.GetY(), size.GetZ()}};
  }
  if (const auto* cylinder = dynamic_cast<const argos::CCylinderEntity*>(&made))
  {
    const double radius = cylinder->GetRadius();
    return BodyShape{"cylindric_prey",
                     cylinder->GetEmbodiedEntity().IsMovable(),
                     std::min(cylinder->GetMass(), kHeaviestKg),
                     {radius, radius, cylinder->GetHeight()}};
  }
  return std::nullopt;
}

const CSwarmanoidSpaceEntity* WaitingBody(const CSwarmanoidSpace& space, const BodyShape& shape)
{
  const double mass_kg = shape.movable ? shape.mass_kg : kUnmovableKg;
  for (std::size_t i = 0; i < space.Size(); ++i)
  {
    const CSwarmanoidSpaceEntity& entity = space.GetEntity(i);
    if (!space.IsPresent(i) && entity.GetConfiguration().reserve.starts_with(kMadeBody) &&
        TagName(entity.GetKind()) == shape.tag && entity.GetSize() == shape.size &&
        entity.GetConfiguration().mass_kg == mass_kg)
      return &entity;
  }
  return nullptr;
}

void DryRun::Add(argos::CEntity& made) { bodies_[made.GetId()] = &made; }

MadeBodies DryRun::Shapes() const
{
  MadeBodies shapes;
  for (const auto& [id, body] : bodies_) ++shapes[*ShapeOf(*body)];
  return shapes;
}

}  // namespace swarmanoid::argos3
