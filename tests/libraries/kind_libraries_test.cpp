// Kinds of entities in libraries: an experiment names them, and uses them as those of the simulator.
#include <gtest/gtest.h>

#include "common/experiment/load_experiment.h"
#include "common/plugins/registry.h"
#include "engine_worker/engine_worker.h"
#include "engine_worker/physics_engine.h"
#include "visualiser/scene/scene.h"

namespace swarmanoid
{
namespace
{

const std::string kFolder = LIBRARY_FOLDER;

LoadedExperiment Load(const std::string& kinds, const std::string& arena, const std::string& rest = "")
{
  RegisterBuiltinEngines();
  const std::string text = "<ahss-config>\n<framework plugin_path='" + kFolder + "'/>\n<entity_kinds>" + kinds +
                           "</entity_kinds>\n<arena size='2,2,1' optimization='2D'>" + arena + "</arena>\n" + rest +
                           "</ahss-config>";
  return LoadExperimentText(text, "f.xml", "/experiments");
}

std::string ErrorsOf(const LoadedExperiment& loaded)
{
  std::string errors;
  for (const Diagnostic& error : loaded.errors) errors += error.Text() + "\n";
  return errors;
}

TEST(KindLibraries, AddTagsToTheArenaAndToDistribute)
{
  const LoadedExperiment loaded =
      Load("<plain_robot library='plain_kinds'/><pillar library='plain_kinds'/><crate library='plain_kinds'/>",
           "<plain_robot id='r' position='0.5,0.5,0'/><pillar id='p' position='1,1,0' radius='0.1' height='0.3'/>"
           "<crate id='c' position='1.5,1.5,0' size='0.2,0.1,0.1' movable='true' mass='2'/>"
           "<distribute quantity='3'><crate id='more' size='0.1,0.1,0.1'/></distribute>");
  ASSERT_EQ(ErrorsOf(loaded), "");
  const auto& entities = loaded.experiment->entities;
  ASSERT_EQ(entities.size(), 6U);
  EXPECT_EQ(TagName(entities[0].kind), "plain_robot");
  EXPECT_EQ(entities[0].size, Vector3(0.1, 0.08, 0.05));
  EXPECT_TRUE(entities[0].movable);
  EXPECT_EQ(entities[1].size, Vector3(0.1, 0.1, 0.3));
  EXPECT_FALSE(entities[1].movable);
  EXPECT_TRUE(entities[2].movable);
  EXPECT_EQ(entities[2].mass_kg, 2);
  EXPECT_FALSE(entities[3].movable);
  // A process that gets the effective text loads the library too.
  EXPECT_NE(loaded.experiment->effective_xml.find("plain_kinds"), std::string::npos);
  ASSERT_EQ(loaded.experiment->entity_kinds.size(), 3U);
  EXPECT_EQ(loaded.experiment->entity_kinds[1].library, "plain_kinds");
}

TEST(KindLibraries, WithoutTheKindNameThoseThatTheyHave)
{
  EXPECT_EQ(ErrorsOf(Load("<pilar library='plain_kinds'/>", "")),
            "f.xml:3:15: the library " + kFolder +
                "/libplain_kinds.so registers no entity kind <pilar>; it registers: plain_robot, lantern, pillar, "
                "crate; did you "
                "mean 'pillar'?\n");
  EXPECT_EQ(ErrorsOf(Load("<pillar library='same_name_controller'/>", "")),
            "f.xml:3:15: the library " + kFolder +
                "/same_name_controller.so registers no entity kind <pillar>; it registers: none\n");
}

TEST(KindLibraries, ThatAreMissingOrWrongAreRefusedWithTheirPlace)
{
  EXPECT_EQ(ErrorsOf(Load("<pillar library='nowhere'/>", "")).substr(0, 50),
            "f.xml:3:23: the library 'nowhere' is not found; bu");
  EXPECT_EQ(ErrorsOf(Load("<hollow library='wrong_kind'/>", "")),
            "f.xml:3:23: the library " + kFolder +
                "/libwrong_kind.so: the entity kind 'hollow' is wrong: a robot or object needs a body: form is "
                "kNone\n");
  EXPECT_EQ(ErrorsOf(Load("<pillar library='plain_kinds'/><pillar library='plain_kinds'/>", "")),
            "f.xml:3:46: <pillar> is listed twice\n");
}

TEST(KindLibraries, OfWhichTwoRegisterOneKindAreRefused)
{
  ASSERT_EQ(ErrorsOf(Load("<pillar library='plain_kinds'/>", "")), "");
  EXPECT_EQ(ErrorsOf(Load("<pillar library='same_kinds'/>", "")),
            "f.xml:3:23: the library " + kFolder +
                "/libsame_kinds.so: it registers the entity kind 'pillar', which exists already; give one of them "
                "another name\n");
}

TEST(KindLibraries, UnknownTagsOfTheArenaAreNamed)
{
  const std::string errors = ErrorsOf(Load("<pillar library='plain_kinds'/>", "<piller id='p' position='1,1,0'/>"));
  EXPECT_EQ(errors.substr(0, 10), "f.xml:4:39") << errors;
  EXPECT_NE(errors.find("did you mean 'pillar'?"), std::string::npos) << errors;
}

class PlainEngine : public CPhysicsEngine
{
public:
  void Init(const EngineSetup&) override {}
  void AddEntity(const CSwarmanoidSpaceEntity&, EBinding) override {}
  void Start() override {}
  void Update(const EngineCommands&, EngineUpdate&, std::span<double>) override {}
  void EntityMoved(std::uint32_t) override {}
  void SaveState(ByteWriter&) const override {}
  void LoadState(ByteReader&) override {}
  void Canonicalise() override {}
};

// The engines of the simulator carry every kind by its row. A user's engine carries the kinds that it lists.
TEST(KindLibraries, KindsThatAnEngineCannotCarryAreNamed)
{
  PluginDescription description;
  description.label = "footbots_only";
  description.entity_tags = {"footbot"};
  PluginRegistry<CPhysicsEngine>::Instance().Add(description, [] { return std::make_unique<PlainEngine>(); });
  const std::string arena = "<pillar id='p' position='1,1,0' radius='0.1' height='0.3'/>";
  const auto with = [&](const std::string& engine)
  {
    return ErrorsOf(Load("<pillar library='plain_kinds'/>", arena,
                         "<engines><" + engine +
                             " id='e'/></engines>\n<arena_physics><engine id='e'>\n<entity id='p'/>"
                             "</engine></arena_physics>"));
  };
  for (const char* engine : {"dummy_engine", "kinematics2d", "dynamics2d", "dynamics3d"})
    EXPECT_EQ(with(engine), "") << engine;
  EXPECT_EQ(with("footbots_only"),
            "f.xml:7:9: the engine 'e' (footbots_only) cannot simulate the pillar 'p'; it can: footbot\n");
}

// Returns the items of an entity.
std::vector<SceneItem> ItemsOf(const Scene& scene, const CSwarmanoidSpace& space, const char* id)
{
  std::vector<SceneItem> items;
  for (const SceneItem& item : scene.Items())
    if (item.entity == space.FindEntity(id)->GetIndex()) items.push_back(item);
  return items;
}

TEST(KindsOfUsers, AreDrawnByTheirBodiesOrTheirMeshes)
{
  const LoadedExperiment loaded =
      Load("<plain_robot library='plain_kinds'/><pillar library='plain_kinds'/><lantern library='plain_kinds'/>",
           "<plain_robot id='r' position='0.5,0.5,0'/><lantern id='l' position='1,0.5,0'/>"
           "<pillar id='p' position='1,1,0' radius='0.1' height='0.3' colour='#ff0000'/>");
  ASSERT_EQ(ErrorsOf(loaded), "");
  CSwarmanoidSpace space(*loaded.experiment);
  Scene scene(space);
  space.FindEntity("l")->SetAttribute("led", 0x0000ff, 1);
  scene.Update({});

  const std::vector<SceneItem> robot = ItemsOf(scene, space, "r");
  ASSERT_EQ(robot.size(), 1U);
  const Eigen::AlignedBox3f& body = scene.Models()[robot[0].model].box;
  EXPECT_LT((body.sizes() - Eigen::Vector3f(0.1F, 0.08F, 0.05F)).norm(), 1e-5F) << "its body";
  EXPECT_EQ(body.min().z(), 0);
  EXPECT_EQ(robot[0].position, Eigen::Vector3f(0.5F, 0.5F, 0));

  const std::vector<SceneItem> pillar = ItemsOf(scene, space, "p");
  ASSERT_EQ(pillar.size(), 1U);
  EXPECT_EQ(pillar[0].scale, Eigen::Vector3f(0.1F, 0.1F, 0.3F));
  EXPECT_EQ(pillar[0].tint, Paint(0xff0000));

  // The kind has its own mesh: a ball of 2 cm about a point 5 cm high, in the colour of LED 1.
  const std::vector<SceneItem> lantern = ItemsOf(scene, space, "l");
  ASSERT_EQ(lantern.size(), 1U);
  const Model& model = scene.Models()[lantern[0].model];
  EXPECT_NEAR(model.box.max().z(), 0.07, 1e-5);
  EXPECT_FALSE(model.is_terrain);
  for (const MeshVertex& vertex : model.levels[0].vertices) ASSERT_EQ(vertex.material, LedMaterial(1));
  EXPECT_EQ(scene.Lights()[static_cast<std::size_t>(lantern[0].lights + 1)], 0x0000ffU);
  EXPECT_EQ(scene.Lights()[static_cast<std::size_t>(lantern[0].lights)], 0U);
}

}  // namespace
}  // namespace swarmanoid
