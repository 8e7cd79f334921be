#include "common/experiment/entity_kind.h"

namespace
{

using namespace swarmanoid;

// Has all defaults except for what a robot must state.
EntityKindDescription PlainRobot()
{
  EntityKindDescription kind;
  kind.tag = "plain_robot";
  kind.form = BodyForm::kBox;
  kind.size = {0.1, 0.08, 0.05};
  return kind;
}

EntityKindDescription Lantern()
{
  EntityKindDescription kind;
  kind.tag = "lantern";
  kind.form = BodyForm::kCylinder;
  kind.size = {0.05, 0.05, 0.1};
  kind.leds = LedLayout{PlacesOnCircle(2, 0.04, 0), 0.05, false};
  kind.mesh = {
      {.form = MeshPart::Form::kBall, .from = {0, 0, 0.05}, .radius = 0.02, .paint = MeshPart::Paint::kLed, .led = 1}};
  return kind;
}

EntityKindDescription Object(const char* tag, BodyForm form, Mobility mobility)
{
  EntityKindDescription kind;
  kind.tag = tag;
  kind.role = EntityRole::kObject;
  kind.form = form;
  kind.mobility = mobility;
  return kind;
}

}  // namespace

REGISTER_ENTITY_KIND(plain_robot, PlainRobot())
REGISTER_ENTITY_KIND(lantern, Lantern())
REGISTER_ENTITY_KIND(pillar, Object("pillar", BodyForm::kCylinder, Mobility::kNever))
REGISTER_ENTITY_KIND(crate, Object("crate", BodyForm::kBox, Mobility::kIfAsked))
