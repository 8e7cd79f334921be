// The mesh of the handbot: a trunk on a round base, a head in front that turns with two arms, a hand at the end of
// each, and two fans. The lengths are from engine_worker/engines/dynamics3d/handbot.h.

#include "visualiser/scene/led_ring.h"
#include "visualiser/scene/meshes.h"
#include "visualiser/scene/robot_meshes.h"

namespace swarmanoid
{
namespace
{

}  // namespace

Mesh HandbotBodyMesh(int level)
{
  MeshBuilder builder(level == 0 ? 40 : level == 1 ? 16 : 6);
  if (level == 2)
  {
    builder.SetShade(0.8F);
    builder.Turn({{0.085F, 0, Material::kDark}, {0.085F, 0.07F, Material::kDark}});
    builder.SetShade(1);
    AddLedRing(builder, LedRing{12, kPiF / 12, 0.085F, 0.07F, 0.09F, 1}, 1);
    builder.Turn({{0.085F, 0.09F, Material::kHandbot}, {0.055F, 0.16F, Material::kHandbot}, {0, 0.16F}});
    return builder.Take();
  }
  // Other robots grip it by this ring.
  builder.Turn({{0, 0.004F, Material::kRubber},
                {0.070F, 0.004F, Material::kRubber},
                {0.078F, 0, Material::kRubber},
                {0.085F, 0.004F, Material::kDark},
                {0.085F, 0.026F, Material::kDark},
                {0.080F, 0.030F, Material::kDark},
                {0.060F, 0.032F, Material::kDark}});
  // The trunk: a block in front, round at the back.
  const float back = -0.025F;
  builder.Box({back, -0.05F, 0.03F}, {0.048F, 0.05F, 0.145F}, Material::kShell);
  builder.SetPlace(back, 0, 0);
  builder.Turn({{0.05F, 0.03F, Material::kShell},
                {0.05F, 0.138F, Material::kShell},
                {0.044F, 0.145F, Material::kShell},
                {0, 0.145F, Material::kShell}});
  builder.SetPlace(0, 0, 0);
  builder.Box({back, -0.036F, 0.145F}, {0.040F, 0.036F, 0.151F}, Material::kHandbot);
  builder.Box({back + 0.004F, -0.0508F, 0.105F}, {0.046F, 0.0508F, 0.132F}, Material::kHandbot);
  // The LED ring is on a collar around the trunk.
  builder.SetShade(0.85F);
  builder.Turn({{0.05F, 0.070F, Material::kDark}, {0.0855F, 0.072F, Material::kShell}, {0.0855F, 0.0735F}});
  builder.SetShade(1);
  AddLedRing(builder, LedRing{12, kPiF / 12, 0.0865F, 0.0735F, 0.0865F, 0.8F}, level == 0 ? 3 : 1);
  builder.Turn({{0.0855F, 0.0865F, Material::kShell}, {0.0855F, 0.089F, Material::kShell}, {0.05F, 0.090F}});
  // Fans left and right, upright tubes; beacon on the back; winch of the rope.
  for (const float side : {-1.0F, 1.0F})
  {
    builder.SetPlace(-0.035F, side * 0.06F, 0.09F);
    builder.SetSegments(level == 0 ? 24 : 10);
    builder.Ring(0.027F, 0.031F, 0.005F, 0.075F, Material::kDark);
    if (level == 0) builder.Cylinder(0.007F, 0.02F, 0.06F, Material::kMetal);
    builder.Disc(0.027F, 0.03F, Material::kRubber);
  }
  builder.SetPlace(-0.045F, 0, 0);
  builder.SetSegments(level == 0 ? 16 : 8);
  builder.Turn({{0.010F, 0.145F, Material::kBeacon}, {0.010F, 0.170F, Material::kBeacon}, {0, 0.175F}});
  builder.SetPlace(RobotJoints::kHandbotRopeForward, 0, 0);
  builder.Cylinder(0.013F, 0.151F, 0.160F, Material::kMetal);
  return builder.Take();
}

Mesh HandbotHeadMesh(int level)
{
  MeshBuilder builder(level == 0 ? 28 : level == 1 ? 12 : 4);
  builder.SetPlace(Eigen::AngleAxisf(kPiF / 2, Eigen::Vector3f::UnitY()) * Eigen::Isometry3f::Identity());
  builder.Turn({{0.036F, -0.012F, Material::kDark},
                {0.036F, 0.012F, Material::kDark},
                {0.030F, 0.020F, Material::kShell},
                {0, 0.022F, Material::kShell}});
  if (level == 2) return builder.Take();
  // This is the crossbar of the shoulders.
  builder.SetPlace(0, 0, 0);
  builder.Rod({0.004F, -RobotJoints::kHandbotShoulder, 0}, {0.004F, RobotJoints::kHandbotShoulder, 0}, 0.016F,
              Material::kMetal);
  for (const float side : {-1.0F, 1.0F})
  {
    const Eigen::Vector3f shoulder(0, side * RobotJoints::kHandbotShoulder, 0);
    builder.Rod(shoulder - Eigen::Vector3f(0, 0, 0.017F), shoulder + Eigen::Vector3f(0, 0, 0.017F), 0.017F,
                Material::kHandbot);
  }
  if (level > 0) return builder.Take();
  builder.SetPlace(0.019F, 0, 0);
  builder.SetSegments(16);
  builder.Sphere(0.011F, Material::kGlass);
  return builder.Take();
}

Mesh HandbotArmMesh(int level)
{
  MeshBuilder builder(level == 0 ? 16 : level == 1 ? 8 : 3);
  const float length = RobotJoints::kHandbotArmLength;
  if (level == 2)
  {
    builder.Rod(Eigen::Vector3f::Zero(), {length, 0, 0}, 0.014F, Material::kShell);
    return builder.Take();
  }
  builder.Rod({0.010F, 0, 0}, {0.095F, 0, 0}, 0.0135F, Material::kShell);
  builder.Rod({0.095F, 0, 0}, {0.107F, 0, 0}, 0.0155F, Material::kHandbot);
  builder.Rod({0.107F, 0, 0}, {length - 0.006F, 0, 0}, 0.011F, Material::kMetal);
  builder.Box({length - 0.010F, -0.018F, -0.016F}, {length, 0.018F, 0.016F}, Material::kDark);
  return builder.Take();
}

Mesh HandbotFingerMesh(int level)
{
  MeshBuilder builder(6);
  if (level == 2) return builder.Take();
  // A claw of 5.8 by 3.8 cm, bent inwards (towards -y) at its tip.
  const float half = 0.019F;
  builder.Box({0, 0, -half}, {0.042F, 0.005F, half}, Material::kDark);
  const Eigen::Vector3f a(0.042F, 0.005F, -half), b(0.042F, 0, -half), c(0.058F, -0.010F, -half),
      d(0.058F, -0.005F, -half);
  const Eigen::Vector3f up(0, 0, 2 * half);
  builder.Face({a, d, c, b}, Material::kRubber);
  builder.Face({b + up, c + up, d + up, a + up}, Material::kRubber);
  builder.Face({b, c, c + up, b + up}, Material::kRubber);
  builder.Face({c, d, d + up, c + up}, Material::kRubber);
  builder.Face({d, a, a + up, d + up}, Material::kDark);
  return builder.Take();
}

}  // namespace swarmanoid
