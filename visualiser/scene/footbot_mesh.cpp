// The mesh of the footbot: tracks with wheels, a round body of 17 cm, a turret with LED ring and gripper, and the
// camera's tube on top. The lengths are from common/experiment/builtin_kinds.cpp and the rings of the devices.

#include "visualiser/scene/led_ring.h"
#include "visualiser/scene/robot_meshes.h"

namespace swarmanoid
{
namespace
{

constexpr float kRadius = 0.085F;
constexpr float kWheel = 0.029112741F;
constexpr float kHalfTrack = 0.07F;  // from the middle to a wheel
constexpr float kAxle = 0.034F;      // from the middle of a track to each of its two wheels

std::vector<Eigen::Vector2f> TrackOutline(int pieces)
{
  std::vector<Eigen::Vector2f> outline;
  for (int end = 0; end < 2; ++end)
    for (int i = 0; i <= pieces; ++i)
    {
      const float angle = (end == 0 ? -kPiF / 2 : kPiF / 2) + kPiF * static_cast<float>(i) / static_cast<float>(pieces);
      const float centre = end == 0 ? kAxle : -kAxle;
      outline.emplace_back(centre + kWheel * std::cos(angle), kWheel + kWheel * std::sin(angle));
    }
  return outline;
}

void AddTrack(MeshBuilder& builder, int level, float side)
{
  const float inner = side * (kHalfTrack - 0.013F);
  const float outer = side * (kHalfTrack + 0.008F);
  builder.SetShade(0.8F);
  builder.Extrude(TrackOutline(level == 0 ? 9 : 4), std::min(inner, outer), std::max(inner, outer), Material::kRubber,
                  Material::kDark);
  builder.SetShade(1);
  if (level > 0) return;
  for (const float axle : {-kAxle, kAxle})
  {
    const Eigen::Vector3f hub(axle, outer - side * 0.001F, kWheel);
    const Eigen::Vector3f rim = hub + Eigen::Vector3f(0, side * 0.004F, 0);
    builder.Rod(hub, rim, 0.021F, Material::kMetal);
    builder.Rod(rim, rim + Eigen::Vector3f(0, side * 0.001F, 0), 0.012F, Material::kDark);
  }
  for (int i = 0; i < 9; ++i)
  {
    const float x = -kAxle + 2 * kAxle * static_cast<float>(i) / 8;
    builder.Box({x - 0.002F, std::min(inner, outer), 2 * kWheel - 0.001F},
                {x + 0.002F, std::max(inner, outer), 2 * kWheel + 0.002F}, Material::kRubber);
  }
}

}  // namespace

Mesh FootbotBaseMesh(int level)
{
  MeshBuilder builder(level == 0 ? 40 : level == 1 ? 16 : 7);
  if (level == 2)
  {
    builder.SetShade(0.75F);
    builder.Turn({{0.07F, 0, Material::kRubber}, {kRadius, 0.072F, Material::kRubber}});
    return builder.Take();
  }
  AddTrack(builder, level, 1);
  AddTrack(builder, level, -1);
  builder.SetShade(0.55F);
  builder.Turn({{0, 0.012F, Material::kDark}, {0.052F, 0.012F, Material::kDark}, {0.055F, 0.05F, Material::kDark}});
  builder.SetShade(0.8F);
  builder.Turn({{0.055F, 0.0575F, Material::kDark}, {0.081F, 0.0575F, Material::kDark}});
  builder.SetShade(1);
  builder.Turn({{0.081F, 0.0575F, Material::kDark},
                {kRadius, 0.061F, Material::kDark},
                {kRadius, 0.070F, Material::kDark},
                {0.079F, 0.0725F, Material::kDark},
                {0.060F, 0.0725F, Material::kDark}});
  if (level > 0) return builder.Take();
  // There are 24 infrared sensors, the first one 7.5 degrees left of the front.
  for (int i = 0; i < 24; ++i)
  {
    const float angle = (7.5F + 15 * static_cast<float>(i)) * kPiF / 180;
    builder.SetPlace(Eigen::AngleAxisf(angle, Eigen::Vector3f::UnitZ()) * Eigen::Isometry3f::Identity());
    builder.Box({kRadius - 0.004F, -0.0032F, 0.0625F}, {kRadius + 0.0012F, 0.0032F, 0.0685F}, Material::kMetal);
  }
  return builder.Take();
}

Mesh FootbotTurretMesh(int level)
{
  MeshBuilder builder(level == 0 ? 48 : level == 1 ? 18 : 6);
  // The LED ring: radius 9 cm, z 8.5 cm; the first LED 15 degrees left of the front.
  const LedRing ring{12, kPiF / 12, kRadius + 0.0012F, 0.0785F, 0.0915F, 0.8F};
  if (level == 2)
  {
    AddLedRing(builder, LedRing{12, kPiF / 12, kRadius, 0.072F, 0.096F, 1}, 1);
    builder.Turn({{kRadius, 0.096F, Material::kShell}, {0.055F, 0.147F, Material::kShell}});
    builder.SetSegments(4);
    builder.Turn({{0.055F, 0.147F, Material::kFootbot}, {0, 0.147F, Material::kFootbot}});
    builder.SetSegments(3);
    builder.Turn({{0.016F, 0.147F, Material::kBeacon}, {0.016F, 0.2F, Material::kDark}, {0, 0.285F, Material::kDark}});
    return builder.Take();
  }
  builder.Turn({{0.070F, 0.0735F, Material::kShell},
                {kRadius - 0.001F, 0.0755F, Material::kShell},
                {kRadius, ring.low, Material::kShell}});
  AddLedRing(builder, ring, level == 0 ? 4 : 1);
  builder.Turn({{kRadius, ring.high, Material::kShell},
                {kRadius - 0.001F, 0.095F, Material::kShell},
                {0.079F, 0.099F, Material::kShell},
                {0.066F, 0.1005F, Material::kShell}});
  builder.SetShade(0.75F);
  builder.Turn({{0.066F, 0.1005F, Material::kDark}, {0.0655F, 0.106F, Material::kDark}});
  builder.SetShade(1);
  builder.Turn({{0.0655F, 0.106F, Material::kShell},
                {0.0655F, 0.136F, Material::kShell},
                {0.060F, 0.1445F, Material::kShell},
                {0.052F, 0.147F, Material::kFootbot},
                {0.034F, 0.147F, Material::kShell},
                {0.018F, 0.147F, Material::kShell}});

  // A mark shows the direction of the turret.
  if (level == 0)
    builder.Face({{0.034F, 0.012F, 0.1476F}, {0.034F, -0.012F, 0.1476F}, {0.056F, 0, 0.1476F}}, Material::kShell);
  // The gripper's housing is in front.
  builder.SetShade(0.9F);
  builder.Box({0.074F, -0.019F, 0.0755F}, {0.092F, 0.019F, 0.0945F}, Material::kDark);
  builder.SetShade(1);

  builder.SetSegments(level == 0 ? 20 : 8);
  builder.Turn({{0.018F, 0.147F, Material::kDark},
                {0.018F, 0.166F, Material::kDark},
                {0.0165F, 0.167F, Material::kBeacon},
                {0.0165F, 0.182F, Material::kDark},
                {0.018F, 0.183F, Material::kDark},
                {0.018F, 0.188F, Material::kDark},
                {0.013F, 0.190F, Material::kGlass},
                {0.013F, 0.252F, Material::kMetal},
                {0.022F, 0.262F, Material::kDark},
                {0.022F, 0.283F, Material::kDark},
                {0.016F, 0.2887F, Material::kDark},
                {0, 0.2887F, Material::kDark}});
  return builder.Take();
}

Mesh FootbotJawMesh(int level)
{
  MeshBuilder builder(6);
  if (level == 2) return builder.Take();
  const std::array<Eigen::Vector3f, 4> below{
      Eigen::Vector3f(0, -0.001F, -0.006F), {0.004F, 0.011F, -0.006F}, {0.019F, 0.006F, -0.006F}, {0.021F, 0, -0.006F}};
  const Eigen::Vector3f up(0, 0, 0.012F);
  builder.Face({below[3] + up, below[2] + up, below[1] + up, below[0] + up}, Material::kMetal);
  builder.Face(below, Material::kMetal);
  for (std::size_t i = 0; i < 4; ++i)
  {
    const Eigen::Vector3f& a = below[i];
    const Eigen::Vector3f& b = below[(i + 1) % 4];
    builder.Face({b, a, a + up, b + up}, Material::kMetal);
  }
  return builder.Take();
}

}  // namespace swarmanoid
