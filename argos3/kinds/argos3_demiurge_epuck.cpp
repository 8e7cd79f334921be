// The e-puck as argos3-epuck (demiurge-project) models it, for experiments in ARGoS3's XML: an <e-puck> whose
// controller has devices of that plug-in becomes <argos3_demiurge_epuck>. Sizes and positions are from its
// epuck_entity.cpp, the mass is from dynamics2d_epuck_model.cpp (revision 66cb8d9). All LEDs are as high as the
// coloured ones, which cameras see; the red ones are at 0.04 m there. Lengths are in metres.
#include "argos3/kinds/epuck_ground.h"
#include "common/experiment/entity_kind.h"
#include "common/math/elementary.h"

namespace swarmanoid::argos3
{
namespace
{

constexpr double kRadius = 0.035;
constexpr double kHeight = 0.076;
constexpr double kRing = kRadius + 0.001;
constexpr double kFirstAngle = kPi / 16;

ProximityRing Proximity()
{
  ProximityRing ring;
  ring.height_m = 0.032;
  ring.range_m = 0.05;
  const std::vector<Vector2> places = PlacesOnCircle(8, kRing, kFirstAngle);
  for (std::size_t i = 0; i < places.size(); ++i)
    ring.sensors.push_back({places[i], WrapAngle(kFirstAngle + static_cast<double>(i) * kPi / 4)});
  return ring;
}

// The red LEDs around the robot, which look outwards, then the three coloured ones on top, which look up: the own body
// does not hide them.
LedLayout Leds()
{
  LedLayout leds{PlacesOnCircle(8, kRing, kFirstAngle), 0.0765, false};
  for (const Vector2& place : leds.places) leds.directions.emplace_back(place.x(), place.y(), 0);
  leds.places.insert(leds.places.end(), {{0.018, 0.0311769}, {0.018, -0.0311769}, {-kRing, 0}});
  leds.directions.resize(leds.places.size(), Vector3::UnitZ());
  return leds;
}

EntityKindDescription EPuck()
{
  EntityKindDescription row;
  row.tag = "argos3_demiurge_epuck";
  row.word = "DemiurgeEPuck";
  row.description = "The e-puck of argos3-epuck's experiments. The position is the centre of its base.";
  row.form = BodyForm::kCylinder;
  row.size = {kRadius, kRadius, kHeight};
  row.mass_kg = 0.4;
  row.colour = 0x2f9e44;
  // The plug-in does not limit the commands.
  row.wheels = WheelDrive{0.053, 0.0205, 10};
  row.leds = Leds();
  row.proximity = Proximity();
  for (const GroundPlace& place : kEPuckGround) row.ground_points.emplace_back(place.x, place.y);
  row.attributes = {{"message", 3, 0, "range and bearing: 1 while sending, then bytes 0..4 and 5..9 as one number each",
                     AttributeValue::kBytes}};
  return row;
}

}  // namespace
}  // namespace swarmanoid::argos3

REGISTER_ENTITY_KIND(argos3_demiurge_epuck, swarmanoid::argos3::EPuck())
