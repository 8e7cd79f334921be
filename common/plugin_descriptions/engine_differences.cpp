#include "common/plugin_descriptions/engine_differences.h"

namespace swarmanoid
{

std::string_view EngineDifference::In(std::string_view engine) const
{
  if (engine == "kinematics2d" || engine == "dummy_engine") return kinematics2d;
  if (engine == "dynamics2d") return dynamics2d;
  if (engine == "dynamics3d") return dynamics3d;
  return {};
}

// A text has at most 20 words.
std::span<const EngineDifference> EngineDifferences()
{
  static const std::vector<EngineDifference> table = {
      {"bodies that meet",
       {},
       "no masses: each gives way by half and bounces; nothing turns",
       "masses, friction, restitution, on a plane",
       "masses, friction, restitution, gravity; bodies lean, tip and fall"},
      {"wheels",
       {"footbot_wheels", "wheels"},
       "turn as commanded at once, without a limit of force",
       "slip beyond 12.6 N; without commands they are locked",
       "motors: 11.5 N at rest, none at 0.6 m/s; without commands they brake"},
      {"`footbot_encoders`",
       {"footbot_encoders"},
       "motion of the body at each wheel, also of a dragged robot",
       "motion of the body at each wheel, also of a dragged robot",
       "rotation of the wheels, slip included"},
      {"`footbot_gripper`",
       {"footbot_gripper"},
       "takes preys and blocks; holders move a load by the mean of their commands",
       "takes preys, blocks, footbots, handbots; the load has its mass and friction",
       "takes preys, blocks, footbots, handbots that reach 65 mm up; the load leans on the robot"},
      {"`footbot_turret`",
       {"footbot_turret"},
       "locked while the gripper holds",
       "turns a load with up to `turret_torque`, gives way beyond",
       "turns a load with up to 1.5 N m, gives way beyond"},
      {"`footbot_turret_torque`",
       {"footbot_turret_torque"},
       "the part of the commands that is held back: a load that only drags reads 0",
       "forces of the grip: a dragged load reads its friction",
       "forces of the grip: a dragged load reads 10 to 50 % more than its friction"},
      {"`footbot_accelerometer`",
       {"footbot_accelerometer"},
       "refused",
       "on the plane; up reads `gravity`",
       "with tilt and gravity"},
      {"`handbot_head`, `handbot_arms`",
       {"handbot_arms"},
       "turn as commanded and touch nothing; wrists do not turn the held object",
       "turn as commanded and touch nothing; wrists do not turn the held object",
       "motors of 3 and 2 N m; arms touch bodies; wrists turn the held object"},
      {"`joints`",
       {"joints"},
       "move as commanded and touch nothing",
       "move as commanded and touch nothing",
       "motors with limited effort, stops, links with masses"},
      {"`handbot_hands`",
       {"handbot_hands"},
       "take one prey or movable block",
       "take one prey or movable block",
       "also take robots and fixed bodies, such as a shelf"},
      {"`handbot_rope`",
       {"handbot_rope"},
       "attaches to the top of the arena; lifted robots collide as if they stood",
       "attaches to the top of the arena; lifted robots collide as if they stood",
       "attaches to a block, a terrain, or a ceiling (`ceiling=\"true\"`) above; hanging robots swing and lean"},
      {"`eyebot_propellers`",
       {"eyebot_propellers"},
       "fly as commanded at once, at the height of the plane; wind carries them along",
       "fly with the forces of their kind, at the height of the plane; wind carries them along",
       "fly at any height; tilt, and hold their place against the drag of the wind"},
      {"`eyebot_attachment`",
       {"eyebot_attach"},
       "attaches to the top of the arena; bodies that meet the robot still move it",
       "attaches to the top of the arena; bodies that meet the robot still move it",
       "attaches to a ceiling, which needs `ceiling=\"true\"`"}};
  return table;
}

}  // namespace swarmanoid
