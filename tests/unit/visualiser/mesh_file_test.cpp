// Meshes of users' files: what of them is drawn, where, in which colours, and that no file ends the program.
#include "visualiser/scene/mesh_file.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "common/configuration/regular_file.h"
#include "common/configuration/xml_reader.h"
#include "test_folders.h"
#include "tests/unit/visualiser/small_world.h"
#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"
#include "visualiser/scene/kind_model.h"
#include "visualiser/scene/meshes_json.h"
#include "visualiser/scene/object_model.h"
#include "visualiser/scene/scene.h"
#include "visualiser/scene/simplify_mesh.h"

namespace swarmanoid
{
namespace
{

using ::testing::HasSubstr;

const std::string kConfigs = SWARMANOID_SOURCE_FOLDER "/configs";

std::string BytesOf(const std::string& path) { return ReadRegularFile(path, kMostMeshBytes); }

class MeshFileTest : public ::testing::Test
{
protected:
  // Each test has another name for its file, since what was read once is not read again.
  std::string Write(const std::string& bytes, const std::string& ending)
  {
    static int files = 0;
    return folder_.Write(std::to_string(++files) + ending, bytes);
  }
  std::string Mistake(const std::string& bytes, const std::string& ending)
  {
    return test::MessageOf<FileError>([&] { ReadMeshFile(Write(bytes, ending)); }, "none");
  }

  test::TemporaryFolder folder_;
};

// Returns a triangle a metre in front, to the left and above: glTF's z, x and y. `node` and `more` are members of its
// JSON.
nlohmann::json Triangle()
{
  // These are 0 0 1, 1 0 0, 0 1 0 as floats, in base64.
  return nlohmann::json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAIA/AACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]}]})");
}

TEST_F(MeshFileTest, OfGltfHasZUpAndLooksAlongX)
{
  const auto file = LoadMeshFile(Write(Triangle().dump(), ".gltf"));
  const Mesh& mesh = file->levels[0];
  ASSERT_EQ(mesh.Triangles(), 1U);
  const auto corner = [&](std::size_t k) { return mesh.vertices[mesh.indices[k]].position; };
  EXPECT_TRUE(corner(0).isApprox(Eigen::Vector3f(1, 0, 0))) << corner(0).transpose();  // its front
  EXPECT_TRUE(corner(1).isApprox(Eigen::Vector3f(0, 1, 0))) << corner(1).transpose();  // its left
  EXPECT_TRUE(corner(2).isApprox(Eigen::Vector3f(0, 0, 1))) << corner(2).transpose();  // up
  const Eigen::Vector3f outside = Eigen::Vector3f::Ones().normalized();
  for (const MeshVertex& vertex : mesh.vertices)
  {
    EXPECT_TRUE(vertex.normal.isApprox(outside, 1e-4F)) << vertex.normal.transpose();
    EXPECT_EQ(vertex.material, Material::kTint) << "a file without materials takes the colour of its entity";
  }
}

TEST_F(MeshFileTest, StandsWhereItsNodesPutItAndStaysOutsideOutIfTheyMirrorIt)
{
  nlohmann::json gltf = Triangle();
  gltf["nodes"] = {{{"children", {1}}, {"translation", {0, 2, 0}}}, {{"mesh", 0}, {"scale", {-2, 2, 2}}}};
  const auto file = LoadMeshFile(Write(gltf.dump(), ".gltf"));
  EXPECT_TRUE(file->box.min().isApprox(Eigen::Vector3f(0, -2, 2))) << file->box.min().transpose();
  EXPECT_TRUE(file->box.max().isApprox(Eigen::Vector3f(2, 0, 4))) << file->box.max().transpose();
  const Mesh& mesh = file->levels[0];
  const auto corner = [&](std::size_t k) { return mesh.vertices[mesh.indices[k]].position; };
  const Eigen::Vector3f seen = (corner(1) - corner(0)).cross(corner(2) - corner(0));
  EXPECT_GT(seen.dot(mesh.vertices[mesh.indices[0]].normal), 0);
  EXPECT_GT(mesh.vertices[0].normal.x(), 0);
}

TEST_F(MeshFileTest, HasTheBaseColoursOfItsMaterialsAndTwoSides)
{
  nlohmann::json gltf = Triangle();
  // 0.5 is linear: 0xbc of 0xff in sRGB.
  gltf["materials"] = {{{"doubleSided", true}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 0.5, 0, 1}}}}}};
  gltf["meshes"][0]["primitives"][0]["material"] = 0;
  const auto file = LoadMeshFile(Write(gltf.dump(), ".gltf"));
  EXPECT_EQ(file->levels[0].Triangles(), 2U);
  for (const MeshVertex& vertex : file->levels[0].vertices)
  {
    EXPECT_EQ(vertex.material, Material::kPainted);
    EXPECT_EQ(vertex.colour, 0xffbc00U);
  }
}

TEST_F(MeshFileTest, OfObjIsTakenAsItIsWithTheColoursOfItsMaterials)
{
  const auto barrel = LoadMeshFile(kConfigs + "/meshes/barrel.obj");
  EXPECT_TRUE(barrel->box.min().isApprox(Eigen::Vector3f(-0.1F, -0.1F, 0), 1e-4F)) << barrel->box.min().transpose();
  EXPECT_TRUE(barrel->box.max().isApprox(Eigen::Vector3f(0.1F, 0.1F, 0.3F), 1e-4F)) << barrel->box.max().transpose();
  std::map<Colour, int> vertices;
  for (const MeshVertex& vertex : barrel->levels[0].vertices) ++vertices[vertex.colour];
  EXPECT_EQ(vertices.size(), 2U);
  EXPECT_TRUE(vertices.contains(0x9e6b3d)) << "wood";
}

TEST_F(MeshFileTest, OfStlIsRoundWhereItIsAlmostSmooth)
{
  // Two triangles meet at 20 degrees: the edge that they share has one normal.
  const std::string stl =
      "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex -1 0 -0.36\nendloop\nendfacet\nendsolid s\n";
  const Mesh mesh = LoadMeshFile(Write(stl, ".stl"))->levels[0];
  EXPECT_EQ(mesh.Triangles(), 2U);
  EXPECT_EQ(mesh.vertices.size(), 4U);
}

TEST_F(MeshFileTest, RefusesWhatIsNoMeshWithTheReason)
{
  EXPECT_THAT(Mistake("", ".glb"), HasSubstr("it is no glTF file"));
  EXPECT_THAT(Mistake("hello", ".gltf"), HasSubstr("it is no glTF file"));
  EXPECT_THAT(Mistake("glTF\2\0\0\0", ".glb"), HasSubstr("ends in its header"));
  EXPECT_THAT(Mistake(BytesOf(kConfigs + "/meshes/rock.glb").substr(0, 300), ".glb"), HasSubstr("cut off"));
  EXPECT_THAT(Mistake("v 0 0 0\n", ".obj"), ::testing::Not("none"));
  EXPECT_THAT(Mistake("v 0 0 0\nv 1 0 0\nv 0 20000 0\nf 1 2 3\n", ".obj"), HasSubstr("meshes are in metres"));
  nlohmann::json old = Triangle();
  old["asset"]["version"] = "1.0";
  EXPECT_THAT(Mistake(old.dump(), ".gltf"), HasSubstr("not of version 2"));
  nlohmann::json lacks = Triangle();
  lacks["buffers"][0]["uri"] = "elsewhere.bin";
  EXPECT_THAT(Mistake(lacks.dump(), ".gltf"), HasSubstr("elsewhere.bin"));
}

TEST_F(MeshFileTest, RefusesWhatWouldTakeAssimpThroughTheEndOfTheStack)
{
  EXPECT_THAT(Mistake(R"({"asset": )" + std::string(2'000'000, '['), ".gltf"), HasSubstr("more than 32 levels"));
  nlohmann::json chain = Triangle();
  chain["nodes"] = nlohmann::json::array();
  for (int node = 0; node < 100'000; ++node) chain["nodes"].push_back({{"children", {node + 1}}});
  chain["nodes"].push_back({{"mesh", 0}});
  EXPECT_THAT(Mistake(chain.dump(), ".gltf"), HasSubstr("nodes hang on each other"));
  nlohmann::json ring = Triangle();
  ring["nodes"] = {{{"children", {1}}}, {{"children", {0}}}};
  EXPECT_THAT(Mistake(ring.dump(), ".gltf"), ::testing::Not("none"));
}

TEST_F(MeshFileTest, ReadsOrRefusesFilesThatAreCutOffAnywhere)
{
  const std::string stl = std::string(80, ' ') + std::string("\1\0\0\0", 4) + std::string(50, '\0');
  const std::vector<std::pair<std::string, std::string>> files{{BytesOf(kConfigs + "/urdf/scout.glb"), ".glb"},
                                                               {Triangle().dump(), ".gltf"},
                                                               {BytesOf(kConfigs + "/meshes/barrel.obj"), ".obj"},
                                                               {stl, ".stl"}};
  for (const auto& [bytes, ending] : files)
  {
    int refused = 0;
    for (std::size_t part = 0; part < 60; ++part)
      refused += Mistake(bytes.substr(0, bytes.size() * part / 60), ending) != "none";
    EXPECT_GT(refused, ending == ".obj" ? 5 : 55) << ending;  // a part of a text may be a smaller mesh
  }
}

// Returns a ball of many triangles.
Mesh Ball(int segments)
{
  Mesh mesh;
  const auto at = [&](int row, int column)
  {
    const float latitude = (static_cast<float>(row) / static_cast<float>(segments) - 0.5F) * 3.14159F;
    const float longitude = 2 * 3.14159F * static_cast<float>(column) / static_cast<float>(segments);
    return Eigen::Vector3f(std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
                           std::sin(latitude));
  };
  for (int row = 0; row <= segments; ++row)
    for (int column = 0; column <= segments; ++column)
      mesh.vertices.push_back({at(row, column), at(row, column), Material::kPainted, 1, row < segments / 2 ? 1U : 2U});
  for (int row = 0; row < segments; ++row)
    for (int column = 0; column < segments; ++column)
    {
      const auto a = static_cast<std::uint32_t>(row * (segments + 1) + column);
      const auto b = a + static_cast<std::uint32_t>(segments) + 1;
      mesh.indices.insert(mesh.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
  return mesh;
}

TEST_F(MeshFileTest, FinerMeshesAreSimplifiedAndKeepTheirSizeAndTheirOutside)
{
  const Mesh ball = Ball(120);
  for (const std::size_t most : {5'000U, 1'000U, 150U})
  {
    const Mesh simple = Simplified(ball, most);
    EXPECT_LE(simple.Triangles(), most);
    EXPECT_GT(simple.Triangles(), most / 4);
    Eigen::AlignedBox3f box;
    for (const MeshVertex& vertex : simple.vertices) box.extend(vertex.position);
    EXPECT_GT(box.sizes().minCoeff(), most < 1'000 ? 1.6F : 1.9F);
    int inwards = 0;
    for (std::size_t i = 0; i < simple.indices.size(); i += 3)
    {
      const Eigen::Vector3f& a = simple.vertices[simple.indices[i]].position;
      const Eigen::Vector3f& b = simple.vertices[simple.indices[i + 1]].position;
      const Eigen::Vector3f& c = simple.vertices[simple.indices[i + 2]].position;
      inwards += (b - a).cross(c - a).dot(a + b + c) <= 0;
    }
    EXPECT_EQ(inwards, 0) << most;
  }
  EXPECT_EQ(Simplified(ball, ball.Triangles()).indices, ball.indices);
}

TEST_F(MeshFileTest, OnlyVerticesOfOneCellBecomeOne)
{
  // Two triangles far from each other, and a third as small as a cell, which vanishes.
  Mesh mesh;
  for (const Eigen::Vector3f& corner : {Eigen::Vector3f(0, 0, 0),
                                        {1, 0, 0},
                                        {0, 1, 0},
                                        {9, 0, 0},
                                        {9, 1, 0},
                                        {8, 0, 0},
                                        {4, 0, 0},
                                        {4, 1e-4F, 0},
                                        {4, 0, 1e-4F}})
  {
    mesh.indices.push_back(static_cast<std::uint32_t>(mesh.vertices.size()));
    mesh.vertices.push_back({corner, Eigen::Vector3f::UnitZ()});
  }
  const Mesh simple = Simplified(mesh, 2);
  ASSERT_EQ(simple.Triangles(), 2U);
  for (std::size_t i = 0; i < simple.indices.size(); ++i)
    EXPECT_EQ(simple.vertices[simple.indices[i]].position, mesh.vertices[i].position) << i;
}

// It is a space with one entity of an own mesh.
class WithMesh : public MeshFileTest
{
protected:
  SmallWorld& World(EntityKind kind, const Vector3& size, const std::string& attributes)
  {
    world_.AddBody(kind, "thing", {1, 1, 0.5}, size);
    world_.GetExperiment().folder = kConfigs;
    world_.GetExperiment().entities.back().tree =
        TConfigurationTree(ReadXml("<block id=\"thing\" " + attributes + "/>", "test.xml"));
    return world_;
  }
  const EntityConfiguration& Entity() { return world_.GetExperiment().entities.back(); }

  SmallWorld world_{{3, 3, 1}};
};

Eigen::AlignedBox3f FilledBy(const Scene& scene, const SceneItem& item)
{
  Eigen::AlignedBox3f box;
  for (const MeshVertex& vertex : scene.Models()[item.model].levels[0].vertices)
    box.extend(item.position + item.orientation * vertex.position.cwiseProduct(item.scale));
  return box;
}

TEST_F(WithMesh, AnObjectIsDrawnAsItAloneAndFillsItsBody)
{
  Scene scene(World(EntityKind::kBlock, {0.4, 0.2, 0.1}, "mesh=\"meshes/rock.glb\"").Space());
  scene.Update({});
  ASSERT_EQ(scene.Items().size(), 2U) << "the floor, and the mesh in place of the box";
  const Eigen::AlignedBox3f box = FilledBy(scene, scene.Items()[1]);
  EXPECT_TRUE(box.min().isApprox(Eigen::Vector3f(0.8F, 0.9F, 0.45F), 1e-4F)) << box.min().transpose();
  EXPECT_TRUE(box.max().isApprox(Eigen::Vector3f(1.2F, 1.1F, 0.55F), 1e-4F)) << box.max().transpose();
}

TEST_F(WithMesh, OfWhichOnlyTheFullDetailIsFineIsStretchedByIt)
{
  // A ball of so many triangles that what is drawn from afar is simpler, and so smaller.
  const Mesh ball = Ball(60);
  std::string file;
  for (const MeshVertex& vertex : ball.vertices)
    file += fmt::format("v {} {} {}\n", vertex.position.x(), vertex.position.y(), vertex.position.z());
  for (std::size_t i = 0; i < ball.indices.size(); i += 3)
    file += fmt::format("f {} {} {}\n", ball.indices[i] + 1, ball.indices[i + 1] + 1, ball.indices[i + 2] + 1);
  Scene scene(World(EntityKind::kBlock, {0.4, 0.2, 0.1}, "mesh=\"" + Write(file, ".obj") + "\"").Space());
  scene.Update({});
  const Eigen::AlignedBox3f box = FilledBy(scene, scene.Items()[1]);
  EXPECT_TRUE(box.min().isApprox(Eigen::Vector3f(0.8F, 0.9F, 0.45F), 1e-4F)) << box.min().transpose();
  EXPECT_TRUE(box.max().isApprox(Eigen::Vector3f(1.2F, 1.1F, 0.55F), 1e-4F)) << box.max().transpose();
}

TEST_F(WithMesh, APreyStandsOnItsBase)
{
  Scene scene(World(EntityKind::kCylindricPrey, {0.1, 0.1, 0.3}, "mesh=\"meshes/barrel.obj\"").Space());
  scene.Update({});
  const Eigen::AlignedBox3f box = FilledBy(scene, scene.Items()[1]);
  EXPECT_TRUE(box.min().isApprox(Eigen::Vector3f(0.9F, 0.9F, 0.5F), 1e-4F)) << box.min().transpose();
  EXPECT_TRUE(box.max().isApprox(Eigen::Vector3f(1.1F, 1.1F, 0.8F), 1e-4F)) << box.max().transpose();
}

TEST_F(WithMesh, TurnsInItsBodyAsTheFileSays)
{
  // A wedge that is high at its y = 1: turned by 90 degrees about x, that end is up.
  const std::string wedge = Write("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n", ".obj");
  World(EntityKind::kBlock, {1, 1, 1}, "mesh=\"" + wedge + "\" mesh_orientation=\"90, 0, 0\"");
  const Model model = ObjectModel(Entity(), kConfigs);
  float highest = -1;
  for (const MeshVertex& vertex : model.levels[0].vertices)
    if (vertex.position.z() > 0.4F) highest = std::max(highest, vertex.position.x());
  EXPECT_NEAR(highest, -0.5F, 1e-4F);
  EXPECT_NE(ObjectModelName(Entity(), kConfigs), "");
}

TEST_F(WithMesh, WhatCannotBeReadIsToldWithThePlaceInTheExperiment)
{
  World(EntityKind::kBlock, {1, 1, 1}, "mesh=\"urdf/rover.glb\"");
  const std::string mistake = test::MessageOf<ConfigurationError>([&] { ObjectModel(Entity(), kConfigs); });
  EXPECT_THAT(mistake, HasSubstr("test.xml:1:"));
  EXPECT_THAT(mistake, HasSubstr("configs/urdf/rover.glb': there is no such file"));
}

TEST_F(WithMesh, PartsOfAKindStandWhereTheRowSaysInItsColours)
{
  EntityKindDescription row;
  row.tag = "cart";
  row.size = {0.2, 0.2, 0.1};
  MeshPart part{.form = MeshPart::Form::kFile, .from = {1, 2, 3}, .paint = MeshPart::Paint::kOwn, .colour = 0x123456};
  part.file = Write(Triangle().dump(), ".gltf");
  part.scale = {2, 1, 1};
  part.orientation = QuaternionFromYaw(DegreesToRadians(90));
  row.mesh = {part};
  const Model model = KindModel(row, world_.GetExperiment());
  // Its front, 2 m ahead, is to the left after the turn.
  EXPECT_TRUE(model.box.min().isApprox(Eigen::Vector3f(0, 2, 3), 1e-4F)) << model.box.min().transpose();
  EXPECT_TRUE(model.box.max().isApprox(Eigen::Vector3f(1, 4, 4), 1e-4F)) << model.box.max().transpose();
  const auto json = nlohmann::json::parse(ModelAsJson(model));
  EXPECT_EQ(json["levels"][0]["colours"][0], 0x123456);
  EXPECT_EQ(model.levels[0].vertices[0].material, Material::kPainted);
}

}  // namespace
}  // namespace swarmanoid
