// The Khepera IV as argos3-kheperaiv models it, for experiments in ARGoS3's XML: <kheperaiv> becomes
// <argos3_kheperaiv>. Sizes and positions are from its kheperaiv_measures.cpp, the mass is from
// dynamics2d_kheperaiv_model.cpp (revision 7bb1bb3). (user/entities/khepera_iv is the same robot for files of ours,
// with its fastest speed.) Lengths are in metres.
#include "common/experiment/entity_kind.h"
#include "common/math/elementary.h"

namespace swarmanoid::argos3
{
namespace
{

constexpr double kRadius = 0.0704;
constexpr double kHeight = 0.0047 + 0.053;

// The first sensor looks ahead; the others follow counter-clockwise.
ProximityRing Proximity()
{
  ProximityRing ring;
  ring.height_m = 0.0145;
  ring.range_m = 0.12;
  for (const double degrees : {0, 45, 90, 135, 180, -135, -90, -45})
  {
    const double angle = DegreesToRadians(degrees);
    ring.sensors.push_back({kRadius * Vector2(Cos(angle), Sin(angle)), angle});
  }
  return ring;
}

EntityKindDescription KheperaIV()
{
  EntityKindDescription row;
  row.tag = "argos3_kheperaiv";
  row.word = "Argos3KheperaIV";
  row.short_word = "khepera";
  row.description = "The Khepera IV of ARGoS3's experiments. The position is the centre of its base.";
  row.form = BodyForm::kCylinder;
  row.size = {kRadius, kRadius, kHeight};
  row.mass_kg = 0.4;
  row.colour = 0x37474f;
  // ARGoS3 does not limit the commands.
  row.wheels = WheelDrive{0.1054, 0.021, 10};
  row.leds = LedLayout{{{0.04, 0.025}, {-0.05, 0}, {0.04, -0.025}}, kHeight, false};
  row.proximity = Proximity();
  row.ground_points = {{0.0614, 0.01}, {0.0206, 0.059}, {0.0206, -0.059}, {0.0614, -0.01}};
  row.attributes = {{"message", 3, 0, "range and bearing: 1 while sending, then bytes 0..4 and 5..9 as one number each",
                     AttributeValue::kBytes}};
  return row;
}

}  // namespace
}  // namespace swarmanoid::argos3

REGISTER_ENTITY_KIND(argos3_kheperaiv, swarmanoid::argos3::KheperaIV())
