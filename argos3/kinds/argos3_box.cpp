// The box of ARGoS3 with LEDs, or made by loop functions. Cameras see the colour of its LEDs, and nothing of a box
// without lit LEDs. A <box> without LEDs becomes a <block>.
#include "common/experiment/entity_kind.h"

namespace swarmanoid::argos3
{
namespace
{

EntityKindDescription Box()
{
  EntityKindDescription row;
  row.tag = "argos3_box";
  row.word = "Box";
  row.description = "A box with LEDs of ARGoS3's experiments. The position is the centre of the body.";
  row.role = EntityRole::kObject;
  row.form = BodyForm::kBox;
  row.origin = BodyOrigin::kCentre;
  row.mobility = Mobility::kIfAsked;
  row.grippable = true;
  row.seen_by_cameras = true;
  row.colour = 0;
  return row;
}

}  // namespace
}  // namespace swarmanoid::argos3

REGISTER_ENTITY_KIND(argos3_box, swarmanoid::argos3::Box())
