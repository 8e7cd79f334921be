// The e-puck as ARGoS3 models it, for experiments in its XML: <e-puck> becomes <argos3_epuck>. Sizes, mass, positions
// of the sensors and LEDs are from epuck_entity.cpp and dynamics2d_epuck_model.cpp of ARGoS3. (user/entities/epuck is
// the robot by its data sheet.) Lengths are in metres.
#include "argos3/kinds/epuck_ground.h"
#include "common/experiment/entity_kind.h"
#include "common/math/elementary.h"

namespace swarmanoid::argos3
{
namespace
{

constexpr double kRadius = 0.035;
constexpr double kHeight = 0.086;

ProximityRing Proximity()
{
  ProximityRing ring;
  ring.height_m = 0.06;
  ring.range_m = 0.1;
  for (const double degrees : {17, 50, 90, 150, -150, -90, -50, -17})
  {
    const double angle = DegreesToRadians(degrees);
    ring.sensors.push_back({kRadius * Vector2(Cos(angle), Sin(angle)), angle});
  }
  return ring;
}

EntityKindDescription EPuck()
{
  EntityKindDescription row;
  row.tag = "argos3_epuck";
  row.word = "EPuck";
  row.description = "The e-puck of ARGoS3's experiments. The position is the centre of its base.";
  row.form = BodyForm::kCylinder;
  row.size = {kRadius, kRadius, kHeight};
  row.mass_kg = 0.4;
  row.colour = 0x2f9e44;
  // ARGoS3 does not limit the commands.
  row.wheels = WheelDrive{0.053, 0.0205, 10};
  row.leds = LedLayout{PlacesOnCircle(8, kRadius + 0.007, kPi / 16), kHeight, false};
  row.proximity = Proximity();
  for (const GroundPlace& place : kEPuckGround) row.ground_points.emplace_back(place.x, place.y);
  row.attributes = {{"message", 3, 0, "range and bearing: 1 while sending, then bytes 0..4 and 5..9 as one number each",
                     AttributeValue::kBytes}};
  return row;
}

}  // namespace
}  // namespace swarmanoid::argos3

REGISTER_ENTITY_KIND(argos3_epuck, swarmanoid::argos3::EPuck())
