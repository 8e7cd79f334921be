// Boxes and cylinders that loop functions make. In a run they replace waiting bodies. In a rehearsal they are only
// listed, and have no position.
#pragma once

#include <argos3/core/simulator/entity/entity.h>

#include <map>
#include <optional>
#include <string>

#include "argos3/converter/counted_bodies.h"
#include "common/space/entity.h"

namespace swarmanoid::argos3
{

// Returns whether the position in ARGoS3 is the middle of the base, while ours is the middle of the body.
inline bool IsBox(const CSwarmanoidSpaceEntity& entity)
{
  return TagName(entity.GetKind()) == "block" || TagName(entity.GetKind()) == kLitBox;
}
// Returns nullopt for entities other than boxes and cylinders.
std::optional<BodyShape> ShapeOf(const argos::CEntity& made);
// Returns an entity of the shape outside the arena; nullptr if none exists.
const CSwarmanoidSpaceEntity* WaitingBody(const CSwarmanoidSpace& space, const BodyShape& shape);

class DryRun
{
public:
  // Adds a box or a cylinder.
  void Add(argos::CEntity& made);
  bool Has(const std::string& id) const { return bodies_.count(id) != 0; }
  MadeBodies Shapes() const;

private:
  std::map<std::string, argos::CEntity*> bodies_;
};

}  // namespace swarmanoid::argos3
