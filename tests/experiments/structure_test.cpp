// Connected entities, as experiment functions read and move them while an engine runs.

#include <functional>

#include "space_server/experiment_functions.h"
#include "tests/experiments/running_experiment.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid
{
namespace
{

class StructureScript : public CExperimentFunctions
{
public:
  static inline std::function<void(SpaceEditor&)> before_tick;
  void Init(const TConfigurationTree, SpaceEditor&) override {}
  void PreStep(SpaceEditor& space) override { before_tick(space); }
};

REGISTER_EXPERIMENT_FUNCTIONS(StructureScript, {.label = "structure_script", .brief = "for tests"})

// The gripped chain with these functions, in that engine.
std::unique_ptr<Experiment> ChainIn(const std::string& engine)
{
  std::string xml = test::TextOf(SWARMANOID_SOURCE_FOLDER "/configs/gripped_chain.xml");
  for (std::size_t at = 0; (at = xml.find("dynamics2d", at)) != std::string::npos; at += engine.size())
    xml.replace(at, 10, engine);
  if (engine == "dynamics3d")
    for (const std::string plane : {"<perpendicular_axis>z</perpendicular_axis>", "<distance>0</distance>"})
      xml.erase(xml.find(plane), plane.size());
  xml.insert(xml.rfind("</ahss-config>"),
             "<experiment_functions><structure_script id=\"script\"/></experiment_functions>");
  const test::TemporaryFolder folder;
  return ReadExperiment(folder.Write("chain.xml", xml));
}

TEST(Structure, ACompoundThatIsMovedKeepsItsShapeAndItsGrips)
{
  for (const std::string engine : {"dynamics2d", "dummy_engine", "dynamics3d"})
  {
    const auto experiment = ChainIn(engine);
    SimulatorOptions options;
    options.visualisations = false;
    StructureScript::before_tick = [](SpaceEditor&) {};
    CSimulator simulator(*experiment, options);
    const CSwarmanoidSpace& space = simulator.GetSpace();
    const auto index = [&](const char* id) { return space.FindEntity(id)->GetIndex(); };
    for (int tick = 0; tick < 50; ++tick) simulator.Step();

    // With masses each grips the next one, in the kinematic engine the last footbot has the prey alone.
    const bool all = engine != "dummy_engine";
    const Pose held = space.GetPose(index("fb_9")).Inverse().Compose(space.GetPose(index("prey")));
    const Pose first = space.GetPose(index("fb_0"));
    const Pose away{Vector3(1, 1.5, 0), QuaternionFromYaw(0.3)};
    StructureScript::before_tick = [&](SpaceEditor& editor)
    {
      const StructuralTree& structure = editor.GetStructure();
      EXPECT_EQ(structure.GetRoot(index("fb_9")), index("prey"));
      EXPECT_EQ(structure.GetRoot(index("fb_0")), index(all ? "prey" : "fb_0"));
      EXPECT_EQ(structure.GetHolders(index("prey")), std::vector<std::uint32_t>{index("fb_9")});
      const auto seen_from_robot = [&]
      { return space.GetPose(index("fb_9")).Inverse().Compose(space.GetPose(index("prey"))).position; };
      const Vector3 before = seen_from_robot();
      editor.MoveCompound("fb_9", away);
      // The grips have never ended meanwhile.
      EXPECT_EQ(structure.GetHolders(index("prey")), std::vector<std::uint32_t>{index("fb_9")});
      EXPECT_EQ(space.GetPose(index("fb_9")).position, away.position);
      EXPECT_LT((seen_from_robot() - before).norm(), 1e-14);
    };
    simulator.Step();
    StructureScript::before_tick = [](SpaceEditor&) {};
    EXPECT_LT((space.GetPose(index("fb_9")).position - away.position).norm(), 0.02) << engine;
    EXPECT_EQ((space.GetPose(index("fb_0")).position - first.position).norm() > 0.5, all) << engine;
    for (int tick = 0; tick < 20; ++tick) simulator.Step();
    EXPECT_EQ(space.FindEntity("fb_9")->GetAttribute("gripped"), 1 + index("prey")) << engine;
    EXPECT_EQ(space.FindEntity("fb_0")->GetAttribute("gripped"), all ? 1 + index("fb_1") : 0) << engine;
    const Pose now = space.GetPose(index("fb_9")).Inverse().Compose(space.GetPose(index("prey")));
    // Grips of the rigid-body engines give way a little to what pulls.
    EXPECT_LT((now.position - held.position).norm(), 8e-3) << engine;
  }
}

}  // namespace
}  // namespace swarmanoid
