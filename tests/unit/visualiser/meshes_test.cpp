#include "visualiser/scene/meshes.h"

#include <gmock/gmock.h>

#include <octomap/octomap.h>

#include <map>
#include <nlohmann/json.hpp>

#include "tests/world/temporary_folder.h"
#include "visualiser/scene/meshes_json.h"

namespace swarmanoid
{
namespace
{

using ::testing::HasSubstr;

std::size_t Triangles(ModelId id, int level) { return ModelOf(id).levels[static_cast<std::size_t>(level)].Triangles(); }

TEST(Meshes, TrianglesAreCounterClockwiseSeenAgainstTheirNormals)
{
  for (const Model& model : StandardModels())
    for (const Mesh& mesh : model.levels)
      for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
      {
        const MeshVertex& a = mesh.vertices[mesh.indices[i]];
        const MeshVertex& b = mesh.vertices[mesh.indices[i + 1]];
        const MeshVertex& c = mesh.vertices[mesh.indices[i + 2]];
        const Eigen::Vector3f cross = (b.position - a.position).cross(c.position - a.position);
        EXPECT_GT(cross.dot(a.normal + b.normal + c.normal), 0) << model.name << " triangle " << i / 3;
        EXPECT_EQ(a.material, b.material) << model.name;
        EXPECT_EQ(a.material, c.material) << model.name;
      }
}

TEST(Meshes, NormalsHaveUnitLength)
{
  for (const Model& model : StandardModels())
    for (const Mesh& mesh : model.levels)
      for (const MeshVertex& vertex : mesh.vertices) EXPECT_NEAR(vertex.normal.norm(), 1, 1e-4) << model.name;
}

TEST(Meshes, EachLevelHasFewerTrianglesThanTheOneBefore)
{
  for (const EntityKind robot : {EntityKind::kFootbot, EntityKind::kEyebot, EntityKind::kHandbot})
  {
    std::array<std::size_t, kLevels> triangles{};
    for (const RestingPart& part : RestingParts(DescriptionOf(robot).mechanism))
      for (int level = 0; level < kLevels; ++level)
        triangles[static_cast<std::size_t>(level)] += Triangles(part.model, level);
    EXPECT_LT(2 * triangles[1], triangles[0]);
    EXPECT_LT(3 * triangles[2], triangles[1]);
  }
  // Ten thousand of them are drawn by software.
  EXPECT_LE(Triangles(ModelId::kFootbotBase, 2) + Triangles(ModelId::kFootbotTurret, 2), 80U);
}

TEST(Meshes, FootbotHasTheSizeOfItsBodyAndStandsOnTheFloor)
{
  for (int level = 0; level < kLevels; ++level)
  {
    Eigen::AlignedBox3f box;
    for (const ModelId part : {ModelId::kFootbotBase, ModelId::kFootbotTurret})
      for (const MeshVertex& vertex : ModelOf(part).levels[static_cast<std::size_t>(level)].vertices)
        box.extend(vertex.position);
    EXPECT_NEAR(box.min().z(), 0, 1e-3);
    EXPECT_NEAR(box.max().z(), 0.2887, 5e-3);
    EXPECT_NEAR(box.max().y(), 0.085, 4e-3) << level;
  }
}

TEST(Meshes, LedsOfARingStandWhereTheDevicesPutThem)
{
  std::map<Material, std::pair<Eigen::Vector3f, int>> sums;
  for (const MeshVertex& vertex : ModelOf(ModelId::kFootbotTurret).levels[0].vertices)
    if (vertex.material >= Material::kLed0)
    {
      auto [entry, fresh] = sums.try_emplace(vertex.material, Eigen::Vector3f::Zero(), 0);
      entry->second.first += vertex.position;
      ++entry->second.second;
    }
  ASSERT_EQ(sums.size(), 12U);
  for (int led = 0; led < 12; ++led)
  {
    const auto& [sum, count] = sums.at(LedMaterial(led));
    const Eigen::Vector3f middle = sum / static_cast<float>(count);
    const double angle = (15 + 30 * led) * 3.14159265358979 / 180;
    EXPECT_NEAR(std::remainder(std::atan2(middle.y(), middle.x()) - angle, 2 * 3.14159265358979), 0, 1e-3);
    EXPECT_NEAR(middle.z(), 0.085, 1e-3);
  }
}

TEST(Meshes, HeightTerrainBecomesASmoothSurfaceWithASkirt)
{
  const HeightTerrain terrain({0.1, 0.2, 0.1, 0.3, 0.4, 0.3}, 3, 2, 2, 1);
  const Model model = TerrainModel(terrain, "hill");
  // Two cells of two triangles, six sides of two triangles.
  EXPECT_EQ(model.levels[0].Triangles(), 4U + 12U);
  Eigen::AlignedBox3f box;
  for (const MeshVertex& vertex : model.levels[0].vertices) box.extend(vertex.position);
  EXPECT_FLOAT_EQ(box.max().z(), 0.4F);
  EXPECT_FLOAT_EQ(box.min().z(), 0);
  EXPECT_FLOAT_EQ(box.max().x(), 2);
  EXPECT_FLOAT_EQ(box.max().y(), 1);
  // A side stands at the edge that it faces, from the lowest height up to the surface, and is seen from outside.
  const Mesh& mesh = model.levels[0];
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
  {
    const MeshVertex* corners[3];
    for (std::size_t k = 0; k < 3; ++k) corners[k] = &mesh.vertices[mesh.indices[i + k]];
    const Eigen::Vector3f cross =
        (corners[1]->position - corners[0]->position).cross(corners[2]->position - corners[0]->position);
    EXPECT_GT(cross.dot(corners[0]->normal), 0) << i / 3;
    if (corners[0]->normal.z() > 0) continue;
    for (const MeshVertex* corner : corners)
    {
      const Eigen::Vector3f edge(corner->normal.x() > 0 ? 2 : 0, corner->normal.y() > 0 ? 1 : 0, 0);
      EXPECT_FLOAT_EQ((corner->position - edge).dot(corner->normal), 0) << i / 3;
    }
  }
}

TEST(Meshes, VoxelTerrainShowsItsSurfaceAlone)
{
  const test::TemporaryFolder folder;
  const std::string path = folder / "beam.bt";
  octomap::OcTree tree(0.1);
  for (int x = 0; x < 6; ++x)
    tree.updateNode(octomap::point3d(0.05F + 0.1F * static_cast<float>(x), 0.05F, 0.05F), true);
  tree.writeBinary(path);
  const Model model = TerrainModel(VoxelTerrain(path), "beam");
  // There are six faces, each of one piece, at every level.
  for (const Mesh& mesh : model.levels) EXPECT_EQ(mesh.Triangles(), 12U);
  Eigen::AlignedBox3f box;
  for (const MeshVertex& vertex : model.levels[0].vertices) box.extend(vertex.position);
  EXPECT_LT((box.sizes() - Eigen::Vector3f(0.6F, 0.1F, 0.1F)).norm(), 1e-5);
}

TEST(Meshes, FileForPagesHoldsAllModelsAndRobots)
{
  const nlohmann::json file = nlohmann::json::parse(MeshesAsJson());
  EXPECT_EQ(file["materials"].size(), static_cast<std::size_t>(Material::kEnd));
  for (const Model& model : StandardModels())
  {
    const nlohmann::json& written = file["models"][model.name];
    ASSERT_EQ(written["levels"].size(), 3U) << model.name;
    EXPECT_EQ(written["levels"][0]["positions"].size(), 3 * model.levels[0].vertices.size());
    std::vector<std::uint32_t> indices;
    std::int64_t index = 0;
    for (const nlohmann::json& step : written["levels"][1]["index_steps"])
      indices.push_back(static_cast<std::uint32_t>(index += step.get<std::int64_t>()));
    EXPECT_EQ(indices, model.levels[1].indices) << model.name;
  }
  EXPECT_EQ(file["robots"]["footbot"].size(), 4U);
  EXPECT_EQ(file["robots"]["eyebot"][0]["model"], "eyebot_body");
}

}  // namespace
}  // namespace swarmanoid
