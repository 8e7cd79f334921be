// The models of scenes: parts of the robots and simple bodies. Every renderer uses them; the web page gets them as a
// file (meshes_json.h).
#pragma once

#include <span>
#include <vector>

#include "common/experiment/entity_kind.h"
#include "common/space/terrain/terrain.h"
#include "visualiser/scene/mesh.h"

namespace swarmanoid
{

enum class ModelId : std::uint16_t
{
  kFootbotBase,    // tracks, wheels, ring of infrared sensors; origin: centre of the base, x forward
  kFootbotTurret,  // LED ring 0..11, beacon, camera, housing of the gripper; same origin, turned about z
  kFootbotJaw,     // one half of the gripper, at its hinge, along x; the other one is turned by 180 degrees about x
  kEyebotBody,     // frame, LED ring 0..15, rotor ducts, rod; origin: centre of the base
  kEyebotRotor,    // the see-through disc of one rotor, in its plane
  kHandbotBody,    // base, trunk, LED ring 0..11, fans; origin: centre of the base, x forward
  kHandbotHead,    // turns about x; origin: on its axis
  kHandbotArm,     // from the shoulder along x
  kHandbotFinger,  // half of a hand, from its hinge along x; the other one is turned by 180 degrees about x
  kBox,            // a cube of side 1 about its centre
  kCylinder,       // radius 1, from z = 0 to 1
  kBall,           // radius 1
  kDisc,           // radius 1 in the plane z = 0, facing up
  kRectangle,      // side 1 in the plane z = 0, facing up
  kLightBulb,      // a glowing ball and its socket; origin: centre of the ball
  kSoundSource,
  kEnd
};

// The joints between parts, in metres.
struct RobotJoints
{
  static constexpr float kFootbotJawForward = 0.086F;  // the hinges of the gripper, in the frame of the turret
  static constexpr float kFootbotJawSide = 0.008F;
  static constexpr float kFootbotJawHeight = 0.085F;
  static constexpr float kEyebotRotorReach = 0.15F;  // from the middle to the four rotors, at 45, 135 ... degrees
  static constexpr float kEyebotRotorHeight = 0.205F;
  static constexpr float kHandbotHeadForward = 0.06F;
  static constexpr float kHandbotHeadHeight = 0.10F;
  static constexpr float kHandbotShoulder = 0.05F;  // left and right of the head
  static constexpr float kHandbotArmLength = 0.138F;
  static constexpr float kHandbotFingerSide = 0.012F;
  static constexpr float kHandbotRopeForward = 0.03F;
};

// Returns all models up to kEnd, in the order of ModelId. They are built once in a process.
const std::vector<Model>& StandardModels();

inline const Model& ModelOf(ModelId id) { return StandardModels()[static_cast<std::size_t>(id)]; }

// A part of a robot with all its joints at 0: for renderers that draw whole robots.
struct RestingPart
{
  ModelId model;
  Eigen::Isometry3f place;
};
// Returns the parts of a robot; empty for Mechanism::kNone.
std::vector<RestingPart> RestingParts(Mechanism robot);

// Returns the surface of a terrain in its frame, in the colour of the entity (Material::kTint).
Model TerrainModel(const Terrain& terrain, const std::string& name);

}  // namespace swarmanoid
