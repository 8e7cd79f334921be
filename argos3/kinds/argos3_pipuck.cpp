// The Pi-Puck as ARGoS3 models it for its engine dynamics2d: <pipuck> becomes <argos3_pipuck>. Sizes and mass are from
// dynamics2d_pipuck_model.cpp, sensors from ci_pipuck_rangefinders_sensor.cpp and ci_pipuck_ground_sensor.cpp, LEDs
// from pipuck_entity.cpp (revision 421bd763). (user/entities/pipuck is the same robot for files of ours, with the sizes
// of ARGoS3's dynamics3d.) Lengths are in metres.
#include "common/experiment/entity_kind.h"
#include "common/math/elementary.h"

namespace swarmanoid::argos3
{
namespace
{

// The first sensor is to the right of the front; the others follow clockwise. ARGoS3 turns each by a right angle about
// an axis, which is perpendicular to its direction: (0.218, 0.976), (0.730, 0.683), (1, 0), (0.630, -0.776) and their
// mirror images.
ProximityRing Rangefinders()
{
  const double front = Atan2(-0.218, 0.976), side = Atan2(-0.730, 0.683), back = Atan2(-0.630, -0.776);
  return {{{{0.0333, -0.0096}, front},
           {{0.0234, -0.0264}, side},
           {{0, -0.0350}, -kPi / 2},
           {{-0.0280, -0.0212}, back},
           {{-0.0280, 0.0212}, -back},
           {{0, 0.0350}, kPi / 2},
           {{0.0234, 0.0264}, -side},
           {{0.0333, 0.0096}, -front}},
          0.0333,
          0.1};
}

EntityKindDescription PiPuck()
{
  constexpr double kRadius = 0.0362, kHeight = 0.08, kLedHeight = 0.025;
  EntityKindDescription row;
  row.tag = "argos3_pipuck";
  row.word = "Argos3PiPuck";
  row.short_word = "pipuck";
  row.description = "The Pi-Puck of ARGoS3's experiments. The position is the centre of its base.";
  row.form = BodyForm::kCylinder;
  row.size = {kRadius, kRadius, kHeight};
  row.mass_kg = 0.4;
  row.colour = 0x1b7f3b;
  // ARGoS3 does not limit the commands.
  row.wheels = WheelDrive{0.0565, 0.02125, 10};
  // The eight LEDs of the ring, then those of the front and of the body, are all in the middle of the body.
  row.leds = LedLayout{std::vector<Vector2>(10, Vector2::Zero()), kLedHeight, false};
  row.proximity = Rangefinders();
  row.ground_points = {{0.03, 0.01}, {0.03, 0}, {0.03, -0.01}};
  return row;
}

}  // namespace
}  // namespace swarmanoid::argos3

REGISTER_ENTITY_KIND(argos3_pipuck, swarmanoid::argos3::PiPuck())
