// The mesh of the eyebot: four ducted rotors within a ring of 50 cm with the LEDs, four thin legs, and a rod with the
// ceiling magnet. The lengths are those of its row in
// common/experiment/builtin_kinds.cpp.

#include "visualiser/scene/led_ring.h"
#include "visualiser/scene/meshes.h"
#include "visualiser/scene/robot_meshes.h"

namespace swarmanoid
{
namespace
{

constexpr float kRing = 0.25F;
constexpr float kDuct = 0.088F;
constexpr float kReach = RobotJoints::kEyebotRotorReach;
constexpr float kRotorHeight = RobotJoints::kEyebotRotorHeight;

Eigen::Isometry3f Quarter(int rotor)
{
  return Eigen::AngleAxisf(kPiF / 4 + static_cast<float>(rotor) * kPiF / 2, Eigen::Vector3f::UnitZ()) *
         Eigen::Isometry3f::Identity();
}

void AddRotor(MeshBuilder& builder, int level, int rotor)
{
  const Eigen::Isometry3f quarter = Quarter(rotor);
  const Eigen::Isometry3f hub = quarter * Eigen::Translation3f(kReach, 0, 0);
  builder.SetPlace(hub);
  builder.SetSegments(level == 0 ? 28 : 10);
  builder.Ring(kDuct - 0.004F, kDuct, kRotorHeight - 0.022F, kRotorHeight + 0.014F,
               rotor == 0 || rotor == 3 ? Material::kEyebot : Material::kShell);
  builder.SetSegments(level == 0 ? 14 : 6);
  builder.Cylinder(0.014F, kRotorHeight - 0.04F, kRotorHeight + 0.012F, Material::kDark);
  if (level == 0)
    for (int blade = 0; blade < 2; ++blade)
    {
      builder.SetPlace(hub * Eigen::AngleAxisf(0.6F + static_cast<float>(blade) * kPiF, Eigen::Vector3f::UnitZ()));
      builder.Box({0.01F, -0.007F, kRotorHeight + 0.003F}, {0.08F, 0.007F, kRotorHeight + 0.005F}, Material::kDark);
    }
  builder.SetPlace(quarter);
  builder.SetShade(0.85F);
  builder.Box({0.03F, -0.009F, kRotorHeight - 0.045F}, {kRing - 0.006F, 0.009F, kRotorHeight - 0.03F},
              Material::kMetal);
  // The leg is under the arm.
  builder.Rod({0.215F, 0, 0.165F}, {0.225F, 0, 0}, 0.005F, Material::kDark);
  builder.SetShade(1);
}

}  // namespace

Mesh EyebotBodyMesh(int level)
{
  MeshBuilder builder(level == 0 ? 64 : level == 1 ? 32 : 8);
  const LedRing leds{16, kPiF / 16, 0.2535F, 0.152F, 0.168F, 0.72F};
  if (level == 2)
  {
    AddLedRing(builder, LedRing{16, kPiF / 16, 0.25F, 0.145F, 0.19F, 1}, 1);
    builder.SetSegments(4);
    builder.Turn(
        {{0.06F, 0.08F, Material::kDark}, {0.06F, 0.25F, Material::kShell}, {0.02F, 0.566F, Material::kShell}});
    for (int rotor = 0; rotor < 4; ++rotor)
    {
      builder.SetPlace(Quarter(rotor) * Eigen::Translation3f(kReach, 0, 0));
      builder.SetSegments(5);
      builder.Disc(kDuct, kRotorHeight, rotor == 0 || rotor == 3 ? Material::kEyebot : Material::kShell);
    }
    return builder.Take();
  }

  AddLedRing(builder, leds, level == 0 ? 4 : 2);
  builder.Turn(
      {{0.242F, 0.148F, Material::kShell}, {0.2525F, 0.148F, Material::kShell}, {0.2525F, 0.152F, Material::kShell}});
  builder.Turn({{0.2525F, 0.168F, Material::kShell},
                {0.2525F, 0.182F, Material::kShell},
                {0.242F, 0.182F, Material::kShell},
                {0.242F, 0.148F, Material::kShell}});
  for (int rotor = 0; rotor < 4; ++rotor) AddRotor(builder, level, rotor);

  // The middle has the camera below, the batteries, and the rod with the magnet on top.
  builder.SetPlace(0, 0, 0);
  builder.SetSegments(level == 0 ? 28 : 12);
  builder.Turn({{0, 0.075F, Material::kDark},
                {0.026F, 0.075F, Material::kDark},
                {0.030F, 0.100F, Material::kShell},
                {0.055F, 0.115F, Material::kShell},
                {0.058F, 0.150F, Material::kShell},
                {0.058F, 0.215F, Material::kEyebot},
                {0.052F, 0.235F, Material::kShell},
                {0.038F, 0.250F, Material::kShell},
                {0.035F, 0.252F, Material::kDark},
                {0.012F, 0.262F, Material::kMetal},
                {0.010F, 0.545F, Material::kDark},
                {0.030F, 0.550F, Material::kDark},
                {0.030F, 0.564F, Material::kDark},
                {0.026F, 0.566F, Material::kMetal},
                {0, 0.566F, Material::kMetal}});
  if (level > 0) return builder.Take();
  builder.SetPlace(0, 0, 0.072F);
  builder.SetSegments(16);
  builder.Sphere(0.018F, Material::kGlass);
  return builder.Take();
}

Mesh EyebotRotorMesh(int level)
{
  MeshBuilder builder(level == 0 ? 28 : 12);
  if (level < 2) builder.Disc(kDuct - 0.005F, 0, Material::kRotor);
  return builder.Take();
}

}  // namespace swarmanoid
