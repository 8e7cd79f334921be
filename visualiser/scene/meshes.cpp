#include "visualiser/scene/meshes.h"

#include <numbers>

#include "visualiser/scene/mesh_builder.h"
#include "visualiser/scene/robot_meshes.h"

namespace swarmanoid
{
namespace
{

Mesh BoxMesh(int)
{
  MeshBuilder builder(4);
  builder.Box({-0.5F, -0.5F, -0.5F}, {0.5F, 0.5F, 0.5F}, Material::kTint);
  Mesh mesh = builder.Take();
  for (MeshVertex& vertex : mesh.vertices)
    if (vertex.position.z() < 0) vertex.shade = 0.78F;
  return mesh;
}

Mesh CylinderMesh(int level)
{
  MeshBuilder builder(level == 0 ? 48 : level == 1 ? 20 : 10);
  if (level == 2)
    builder.Turn({{1, 0}, {1, 1}, {0, 1}});
  else
    builder.Turn({{0, 0}, {1, 0}, {1, 0.96F}, {0.96F, 1}, {0, 1}});
  return builder.Take();
}

Mesh BallMesh(int level)
{
  MeshBuilder builder(level == 0 ? 28 : level == 1 ? 14 : 8);
  builder.Sphere(1, Material::kTint);
  return builder.Take();
}

Mesh DiscMesh(int level)
{
  MeshBuilder builder(level == 0 ? 64 : level == 1 ? 32 : 12);
  builder.Disc(1, 0, Material::kTint);
  return builder.Take();
}

Mesh RectangleMesh(int)
{
  MeshBuilder builder(4);
  builder.Face({{-0.5F, -0.5F, 0}, {0.5F, -0.5F, 0}, {0.5F, 0.5F, 0}, {-0.5F, 0.5F, 0}}, Material::kTint);
  return builder.Take();
}

Mesh LightBulbMesh(int level)
{
  MeshBuilder builder(level == 0 ? 24 : level == 1 ? 12 : 6);
  builder.Sphere(0.05F, LedMaterial(0));
  builder.Turn({{0.020F, 0.042F, Material::kMetal}, {0.020F, 0.075F, Material::kMetal}, {0, 0.08F, Material::kDark}});
  return builder.Take();
}

Mesh SoundSourceMesh(int level)
{
  MeshBuilder builder(level == 0 ? 28 : level == 1 ? 12 : 6);
  builder.Box({-0.035F, -0.045F, -0.07F}, {0.035F, 0.045F, 0.07F}, Material::kDark);
  builder.SetPlace(Eigen::Translation3f(0.035F, 0, -0.02F) * Eigen::AngleAxisf(kPiF / 2, Eigen::Vector3f::UnitY()) *
                   Eigen::Isometry3f::Identity());
  builder.Turn({{0.036F, 0.001F, Material::kMetal}, {0.024F, 0.003F, Material::kTint}, {0, 0.001F}});
  return builder.Take();
}

Model MakeModel(std::string name, Mesh (*make)(int level))
{
  Model model;
  model.name = std::move(name);
  for (int level = 0; level < kLevels; ++level) model.levels[static_cast<std::size_t>(level)] = make(level);
  Measure(model);
  return model;
}

RestingPart At(ModelId model, float x = 0, float y = 0, float z = 0, bool turned = false)
{
  return {model, Eigen::Translation3f(x, y, z) * Eigen::AngleAxisf(turned ? kPiF : 0, Eigen::Vector3f::UnitX()) *
                     Eigen::Isometry3f::Identity()};
}

}  // namespace

const std::vector<Model>& StandardModels()
{
  static const std::vector<Model> models = []
  {
    std::vector<Model> all;
    all.push_back(MakeModel("footbot_base", FootbotBaseMesh));
    all.push_back(MakeModel("footbot_turret", FootbotTurretMesh));
    all.push_back(MakeModel("footbot_jaw", FootbotJawMesh));
    all.push_back(MakeModel("eyebot_body", EyebotBodyMesh));
    all.push_back(MakeModel("eyebot_rotor", EyebotRotorMesh));
    all.push_back(MakeModel("handbot_body", HandbotBodyMesh));
    all.push_back(MakeModel("handbot_head", HandbotHeadMesh));
    all.push_back(MakeModel("handbot_arm", HandbotArmMesh));
    all.push_back(MakeModel("handbot_finger", HandbotFingerMesh));
    all.push_back(MakeModel("box", BoxMesh));
    all.push_back(MakeModel("cylinder", CylinderMesh));
    all.push_back(MakeModel("ball", BallMesh));
    all.push_back(MakeModel("disc", DiscMesh));
    all.push_back(MakeModel("rectangle", RectangleMesh));
    all.push_back(MakeModel("light_bulb", LightBulbMesh));
    all.push_back(MakeModel("sound_source", SoundSourceMesh));
    return all;
  }();
  return models;
}

std::vector<RestingPart> RestingParts(Mechanism robot)
{
  using J = RobotJoints;
  switch (robot)
  {
    case Mechanism::kTurretGripper:
      return {At(ModelId::kFootbotBase), At(ModelId::kFootbotTurret),
              At(ModelId::kFootbotJaw, J::kFootbotJawForward, J::kFootbotJawSide, J::kFootbotJawHeight),
              At(ModelId::kFootbotJaw, J::kFootbotJawForward, -J::kFootbotJawSide, J::kFootbotJawHeight, true)};
    case Mechanism::kPropellers:
    {
      std::vector<RestingPart> parts{At(ModelId::kEyebotBody)};
      const float reach = J::kEyebotRotorReach / std::numbers::sqrt2_v<float>;
      for (const float x : {reach, -reach})
        for (const float y : {reach, -reach}) parts.push_back(At(ModelId::kEyebotRotor, x, y, J::kEyebotRotorHeight));
      return parts;
    }
    case Mechanism::kArms:
    {
      std::vector<RestingPart> parts{At(ModelId::kHandbotBody),
                                     At(ModelId::kHandbotHead, J::kHandbotHeadForward, 0, J::kHandbotHeadHeight)};
      for (const float side : {1.0F, -1.0F})
      {
        const float y = side * J::kHandbotShoulder;
        const float x = J::kHandbotHeadForward;
        parts.push_back(At(ModelId::kHandbotArm, x, y, J::kHandbotHeadHeight));
        for (const float finger : {1.0F, -1.0F})
          parts.push_back(At(ModelId::kHandbotFinger, x + J::kHandbotArmLength, y + finger * J::kHandbotFingerSide,
                             J::kHandbotHeadHeight, finger < 0));
      }
      return parts;
    }
    case Mechanism::kNone:
      break;
  }
  return {};
}

}  // namespace swarmanoid
