// Boxes and cylinders that loop functions make: in a run, those that wait for them; in a rehearsal, a list of what was
// made, which stands nowhere.
#pragma once

#include <argos3/core/simulator/entity/entity.h>

#include <map>
#include <optional>
#include <string>

#include "argos3/converter/counted_bodies.h"
#include "common/space/entity.h"

namespace swarmanoid::argos3
{

// One of which ARGoS3 tells the middle of the base, and we that of the body.
inline bool IsBox(const CSwarmanoidSpaceEntity& entity)
{
  return TagName(entity.GetKind()) == "block" || TagName(entity.GetKind()) == kLitBox;
}
// nullopt for what is no box and no cylinder.
std::optional<BodyShape> ShapeOf(const argos::CEntity& made);
// One of the shape that is not in the arena; nullptr if there is none.
const CSwarmanoidSpaceEntity* WaitingBody(const CSwarmanoidSpace& space, const BodyShape& shape);

class DryRun
{
public:
  // A box or a cylinder.
  void Add(argos::CEntity& made);
  bool Has(const std::string& id) const { return bodies_.count(id) != 0; }
  MadeBodies Shapes() const;

private:
  std::map<std::string, argos::CEntity*> bodies_;
};

}  // namespace swarmanoid::argos3
