// The drawings of experiment functions, and the keys and selections that they get.
#include <gmock/gmock.h>

#include <filesystem>

#include "space_server/run_control.h"
#include "space_server/space_server.h"
#include "tests/world/message_of.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The record of the functions below.
struct Told
{
  int draws = 0;
  std::uint32_t colour = 0xff0000;
  std::size_t segments = 1;
  bool wrong = false;
  std::vector<std::string> inputs;
};
Told told;

class CPictureFunctions : public CExperimentFunctions
{
public:
  void Init(const TConfigurationTree, SpaceEditor&) override {}
  void Draw(const SpaceEditor& editor, Drawing& drawing) override
  {
    ++told.draws;
    // The draw is from this step alone, so it changes no number of other steps.
    editor.GetRandom().Uniform();
    for (std::size_t k = 0; k < told.segments; ++k) drawing.Segment({0, 0, 0}, {1, 0, 0}, {told.colour});
    drawing.InFrameOf(told.wrong ? 7 : 0);
    drawing.Text({0, 0, 0.3}, "tick " + std::to_string(editor.GetSpace().GetTick()));
  }
  void Input(const UserInput& input, SpaceEditor& space) override
  {
    static constexpr const char* kKinds[] = {"press", "release", "select", "deselect"};
    told.inputs.push_back(std::string(kKinds[static_cast<int>(input.kind)]) + " " +
                          (input.entity == nullptr ? input.key : input.entity->GetId()));
    if (input.key == "M") space.MoveEntity("fb", {{2, 2, 0}, Quaternion::Identity()});
  }
  bool HasState() const override { return true; }
};

REGISTER_EXPERIMENT_FUNCTIONS(CPictureFunctions, {.label = "picture_functions"})

class Drawings : public ::testing::Test
{
protected:
  Drawings()
  {
    told = {};
    experiment_.arena_size = {5, 5, 1};
    for (const char* id : {"fb", "other"})
      experiment_.entities.push_back(test::Entity(EntityKind::kFootbot, id, {1, id[0] == 'f' ? 1.0 : 4.0, 0}));
  }
  void AddFunctions(const std::string& id)
  {
    experiment_.functions.push_back(
        {"picture_functions", id, TConfigurationTree(std::make_shared<ConfigurationNode>()), {}});
  }
  SpaceServer& Server()
  {
    if (server_ == nullptr) server_ = std::make_unique<SpaceServer>(experiment_, assignment_, ".");
    return *server_;
  }

  Experiment experiment_;
  Assignment assignment_;
  std::unique_ptr<SpaceServer> server_;
};

TEST_F(Drawings, AreMadeOnceForAStateThatSomebodyLooksAt)
{
  AddFunctions("a");
  SpaceServer& server = Server();
  server.Advance({}, {});
  server.Advance({}, {});
  EXPECT_EQ(told.draws, 0) << "no viewer";
  EXPECT_TRUE(server.Space().GetDrawing().IsEmpty());
  server.Draw();
  server.Draw();
  EXPECT_EQ(told.draws, 1);
  EXPECT_THAT(server.Space().GetDrawing().texts, ElementsAre("tick 2"));
  EXPECT_EQ(server.Space().GetDrawing().shapes[1].frame, 1U) << "of the first entity";
  server.Editor().MoveEntity("fb", {{3, 3, 0}, Quaternion::Identity()});
  server.Draw();
  EXPECT_EQ(told.draws, 2) << "it was moved";
  server.Advance({}, {});
  server.Draw();
  EXPECT_THAT(server.Space().GetDrawing().texts, ElementsAre("tick 3"));
}

TEST_F(Drawings, OfSeveralFunctionsAreOne)
{
  AddFunctions("a");
  AddFunctions("b");
  Server().Draw();
  // The second ones begin in the space again.
  std::vector<std::uint32_t> frames;
  for (const DrawnShape& shape : Server().Space().GetDrawing().shapes) frames.push_back(shape.frame);
  EXPECT_THAT(frames, ElementsAre(0, 1, 0, 1));
}

TEST_F(Drawings, ChangeNeitherTheHashNorNumbersOfTheProgram)
{
  AddFunctions("a");
  std::vector<std::uint64_t> hashes;
  std::vector<double> numbers;
  for (const bool looks : {false, true})
  {
    server_.reset();
    SpaceServer& server = Server();
    for (int tick = 0; tick < 3; ++tick)
    {
      server.Advance({}, {});
      numbers.push_back(server.Editor().GetRandom().Uniform());
      if (looks) server.Draw();
      numbers.push_back(server.Editor().GetRandom().Uniform());
      hashes.push_back(server.Space().Hash());
    }
  }
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(hashes[k], hashes[k + 3]);
  for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(numbers[k], numbers[k + 6]) << k;
}

TEST_F(Drawings, GoIntoStatesOnlyIfVisualisersAreWaitedFor)
{
  AddFunctions("a");
  Server().Draw();
  EXPECT_TRUE(Server().State().drawing.IsEmpty());
  Server().SetDrawsIntoStates();
  EXPECT_EQ(Server().State().drawing, Server().Space().GetDrawing());
  SpaceSnapshot snapshot;
  Server().WriteSnapshot(snapshot);
  EXPECT_TRUE(snapshot.drawing.IsEmpty()) << "checkpoints and journals have none";
}

TEST_F(Drawings, TooManyAreToldOnceAndCutOff)
{
  AddFunctions("a");
  std::vector<std::string> warnings;
  Server().SetWarningHandler([&](const std::string& text) { warnings.push_back(text); });
  told.segments = Drawing::kMostNumbers / 6 + 1;
  for (int tick = 0; tick < 2; ++tick)
  {
    Server().Advance({}, {});
    Server().Draw();
  }
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings[0], HasSubstr("more at tick 1 than is shown"));
  EXPECT_LE(Server().Space().GetDrawing().numbers.size(), Drawing::kMostNumbers);
  EXPECT_EQ(Server().Space().GetDrawing().Mistake(1), "");
}

TEST_F(Drawings, MistakesNameTheFunctions)
{
  AddFunctions("a");
  told.colour = 0x1ffffff;
  const std::string mistake = test::MessageOf<std::exception>([&] { Server().Draw(); });
  EXPECT_THAT(mistake, HasSubstr("experiment functions 'a'"));
  EXPECT_THAT(mistake, HasSubstr("Draw"));
  EXPECT_THAT(mistake, HasSubstr("the colour is 0x1ffffff"));
  told = {};
  told.wrong = true;
  Server().Advance({}, {});
  EXPECT_THROW(Server().Draw(), std::runtime_error) << "there is no eighth entity";
}

TEST_F(Drawings, NumbersThatCannotBeDrawnAreRefused)
{
  Drawing drawing;
  const double nan = std::nan("");
  EXPECT_THROW(drawing.Point({nan, 0, 0}), std::invalid_argument);
  EXPECT_THROW(drawing.Segment({0, 0, 0}, {1e30, 0, 0}), std::invalid_argument);
  EXPECT_THROW(drawing.Circle({}, -1), std::invalid_argument);
  EXPECT_THROW(drawing.Box({{0, 0, 0}, Quaternion(2, 0, 0, 0)}, {1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(drawing.Text({0, 0, 0}, "text", {0, 1.5}), std::invalid_argument);
  EXPECT_THROW(drawing.Segment({0, 0, 0}, {1, 0, 0}, {0, 1, -1}), std::invalid_argument);
  const Vector3 two[] = {{0, 0, 0}, {1, 0, 0}};
  EXPECT_THROW(drawing.Polygon(two), std::invalid_argument);
  EXPECT_TRUE(drawing.IsEmpty());
  // The text is cut between two characters.
  std::string text(Drawing::kLongestText - 1, 'a');
  drawing.Text({0, 0, 0}, text + "é");
  EXPECT_EQ(drawing.texts[0], text);
}

TEST_F(Drawings, KeysAndSelectionsComeInTheirOrder)
{
  AddFunctions("a");
  Server().PressKey("I", true);
  Server().Select("fb");
  Server().Select("fb");
  Server().PressKey("I", false);
  Server().Select("other");
  Server().Select("");
  Server().Select("");
  EXPECT_THAT(told.inputs,
              ElementsAre("press I", "select fb", "release I", "deselect fb", "select other", "deselect other"));
  EXPECT_THROW(Server().PressKey("i", true), std::invalid_argument);
  EXPECT_THROW(Server().PressKey("", true), std::invalid_argument);
  EXPECT_THROW(Server().Select("none"), std::invalid_argument);
}

TEST_F(Drawings, WithoutFunctionsThereIsNobodyForKeys)
{
  EXPECT_THROW(Server().PressKey("I", true), std::invalid_argument);
  EXPECT_THROW(Server().Select("fb"), std::invalid_argument);
}

class Asked : public Drawings
{
protected:
  void Ask(RunControl& control, const ControlOrder& order)
  {
    control.Ask({order});
    control.Work(Server());
  }
  RunControl::Answer Answers()
  {
    return [this](const ControlRequestMessage&, bool done, std::uint64_t, const std::string& text)
    { (done ? done_ : refused_).push_back(text); };
  }

  std::vector<std::string> done_, refused_;
};

TEST_F(Asked, KeysAreEventsThatCanBeRepeated)
{
  AddFunctions("a");
  const std::string log = "/tmp/drawings_test_" + std::to_string(getpid()) + ".csv";
  RunControlSetup setup;
  setup.event_log = log;
  {
    RunControl control(experiment_, setup, Answers());
    Ask(control, {"press", {{"key", "M"}}});
    Ask(control, {"select", {{"entity", "fb"}}});
    Ask(control, {"press", {{"key", "nothing"}}});
    Ask(control, {"select", {{"entity", "none"}}});
    Ask(control, {"deselect"});
  }
  EXPECT_THAT(done_, ElementsAre("key M pressed at tick 0", "selected 'fb' at tick 0", "selected none at tick 0"));
  ASSERT_EQ(refused_.size(), 2U);
  EXPECT_THAT(refused_[0], HasSubstr("there is no key 'nothing'"));
  const std::vector<std::string> first = told.inputs;
  const std::uint64_t hash = Server().Space().Hash();
  EXPECT_THAT(first, ElementsAre("press M", "select fb", "deselect fb"));

  told = {};
  server_.reset();
  RunControlSetup again;
  again.repeated = ReadEvents(log, experiment_);
  RunControl control(experiment_, again, Answers());
  control.Work(Server());
  EXPECT_EQ(told.inputs, first);
  EXPECT_EQ(Server().Space().Hash(), hash) << "the key moved the robot";
  std::filesystem::remove(log);
}

TEST_F(Asked, KeysAreRefusedWithoutFunctions)
{
  RunControl control(experiment_, {}, Answers());
  Ask(control, {"press", {{"key", "I"}}});
  EXPECT_THAT(done_, IsEmpty());
  ASSERT_EQ(refused_.size(), 1U);
  EXPECT_THAT(refused_[0], HasSubstr("no <experiment_functions>"));
}

}  // namespace
}  // namespace swarmanoid
