// A run in one process that is controlled through one of its visualisations, and the messages to the visualisation.
#include <gmock/gmock.h>

#include <chrono>
#include <functional>

#include "common/experiment/load_experiment.h"
#include "common/program/usage_error.h"
#include "simulation/register_all.h"
#include "simulation/single_process.h"
#include "test_folders.h"
#include "tests/world/message_of.h"
#include "tests/world/temporary_folder.h"
#include "visualiser/render.h"

namespace swarmanoid
{
namespace
{

using testing::HasSubstr;
using testing::StartsWith;

// Calls the function of the test at every call.
class CScriptedRender : public CRender
{
public:
  void Init(const RenderSetup& setup) override { setup_ = std::make_unique<RenderSetup>(setup); }
  void Draw() override
  {
    if (on_draw) on_draw(*setup_);
  }
  void Idle() override
  {
    if (on_idle) on_idle(*setup_);
  }
  bool Terminate() override { return terminate; }
  bool IsInteractive() const override { return interactive; }

  using Script = std::function<void(const RenderSetup&)>;
  static Script on_draw, on_idle;
  static bool terminate, interactive;

private:
  std::unique_ptr<RenderSetup> setup_;
};

CScriptedRender::Script CScriptedRender::on_draw, CScriptedRender::on_idle;
bool CScriptedRender::terminate = false, CScriptedRender::interactive = true;

class SteeringTest : public testing::Test
{
protected:
  void SetUp() override
  {
    RegisterBuiltins();
    static const bool registered = []
    {
      PluginRegistry<CRender>::Instance().Add({.label = "scripted_render"},
                                              [] { return std::make_unique<CScriptedRender>(); });
      return true;
    }();
    static_cast<void>(registered);
    CScriptedRender::on_draw = CScriptedRender::on_idle = nullptr;
    CScriptedRender::terminate = false;
    CScriptedRender::interactive = true;

    std::string text = test::TextOf(SWARMANOID_SOURCE_FOLDER "/configs/diffusion_10.xml");
    const std::size_t begin = text.find("<visualisations>");
    const std::string scripted = "<visualisations><scripted_render id='s'/></visualisations>";
    if (begin == std::string::npos)
      text.insert(text.rfind("</ahss-config>"), scripted);
    else
      text.replace(begin, text.find("</visualisations>") + 17 - begin, scripted);
    LoadOptions options;
    options.settings = {{"framework.maxclock", "40"}};
    LoadedExperiment loaded = LoadExperimentText(text, "scripted.xml", SWARMANOID_SOURCE_FOLDER "/configs", options);
    for (const Diagnostic& error : loaded.errors) ADD_FAILURE() << error.Text();
    experiment_ = std::move(loaded.experiment);
    options_.output_folder = folder_.Path();
  }

  std::string Read(const std::string& name) const { return folder_.Read(name); }

  test::TemporaryFolder folder_;
  std::unique_ptr<Experiment> experiment_;
  SingleProcessOptions options_;
};

TEST_F(SteeringTest, AResetEndsTheRunAndSaysHowItIsToBeginAgain)
{
  CScriptedRender::on_draw = [](const RenderSetup& setup)
  {
    if (setup.space.GetTick() != 6) return;
    setup.control->SetSpeed(1000);
    setup.control->Reset();
  };
  options_.may_reset = true;
  options_.event_log = (folder_ / "events.csv").string();
  const RunSummary summary = RunSingleProcess(*experiment_, options_);
  EXPECT_EQ(summary.ticks, 7U);
  ASSERT_TRUE(summary.reset);
  EXPECT_EQ(summary.reset->seed, experiment_->seed);
  EXPECT_FALSE(summary.reset->paused);
  EXPECT_EQ(summary.reset->real_time_factor, 1000);
  EXPECT_THAT(Read("events.csv"), HasSubstr("7,reset,1,"));
}

TEST_F(SteeringTest, AResetIsRefusedWhereNobodyWouldBeginAgain)
{
  std::string refused;
  CScriptedRender::on_draw = [&](const RenderSetup& setup)
  {
    if (setup.space.GetTick() == 6) setup.control->Reset();
    for (const RunNote& note : setup.monitor->Notes()) refused = note.text;
  };
  const RunSummary summary = RunSingleProcess(*experiment_, options_);
  EXPECT_EQ(summary.ticks, 40U);
  EXPECT_FALSE(summary.reset);
  EXPECT_THAT(refused, HasSubstr("nothing would start this run again"));
}

TEST_F(SteeringTest, RequestsBeyondTheLimitsOfAMessageAreRefusedAndNotWrittenDown)
{
  std::vector<std::string> notes;
  CScriptedRender::on_draw = [&](const RenderSetup& setup)
  {
    if (setup.space.GetTick() == 6)
    {
      setup.control->PressKey(std::string(1, '\0'), true);
      setup.control->SelectEntity(std::string(3000, 'x'));
      setup.control->RemoveEntity("fb_3\n9,stop,,,,0,");
    }
    notes.clear();
    for (const RunNote& note : setup.monitor->Notes()) notes.push_back(note.text);
  };
  options_.event_log = (folder_ / "events.csv").string();
  EXPECT_EQ(RunSingleProcess(*experiment_, options_).ticks, 40U);
  EXPECT_THAT(notes, testing::ElementsAre(HasSubstr("press: the key '?'"), HasSubstr("has 3000 bytes"),
                                          HasSubstr("remove: the entity 'fb_3?9,stop")));
  EXPECT_EQ(Read("events.csv"), "");
}

TEST_F(SteeringTest, MovesAreWrittenDownAndRepeatedWithTheSameHashes)
{
  const std::uint64_t undisturbed = RunSingleProcess(*experiment_, options_).hash;

  CScriptedRender::on_draw = [](const RenderSetup& setup)
  {
    if (setup.space.GetTick() != 6) return;
    Pose pose = setup.space.FindEntity("fb_3")->GetPose();
    pose.position += Vector3(0.1234567890123, -0.05, 0);
    setup.control->MoveEntity("fb_3", pose);
    setup.control->MoveEntity("none", pose);
  };
  options_.event_log = (folder_ / "events.csv").string();
  options_.hash_log = (folder_ / "first").string();
  const std::uint64_t moved = RunSingleProcess(*experiment_, options_).hash;
  EXPECT_NE(moved, undisturbed);
  EXPECT_THAT(Read("events.csv"), StartsWith("tick,request,entity,numbers,from,number,when,check\n7,move,fb_3,"));
  EXPECT_THAT(Read("events.csv"), Not(HasSubstr("none")));

  CScriptedRender::on_draw = nullptr;
  options_.events = options_.event_log;
  options_.event_log = (folder_ / "again.csv").string();
  options_.hash_log = (folder_ / "second").string();
  EXPECT_EQ(RunSingleProcess(*experiment_, options_).hash, moved);
  EXPECT_EQ(Read("second"), Read("first"));
  EXPECT_EQ(Read("again.csv"), Read("events.csv"));
}

TEST_F(SteeringTest, EntitiesAreRemovedAndAddedAndThatIsRepeatedWithTheSameHashes)
{
  std::vector<std::size_t> present;
  std::vector<std::string> notes;
  CScriptedRender::on_draw = [&](const RenderSetup& setup)
  {
    const CSwarmanoidSpace& space = setup.space;
    present.push_back(space.IsPresent(space.FindEntity("fb_3")->GetIndex()) ? 1 : 0);
    notes.clear();
    for (const RunNote& note : setup.monitor->Notes()) notes.push_back(note.text);
    const Pose taken = space.FindEntity("fb_4")->GetPose();
    if (space.GetTick() == 4) setup.control->RemoveEntity("fb_3");
    if (space.GetTick() == 9)
    {
      setup.control->MoveEntity("fb_3", taken);
      setup.control->AddEntity("fb_3", taken);
      setup.control->RemoveEntity("wall_west");
    }
    if (space.GetTick() == 14) setup.control->AddEntity("fb_3", {{1, 1, 0}, Quaternion::Identity()});
  };
  options_.event_log = (folder_ / "events.csv").string();
  options_.hash_log = (folder_ / "first").string();
  const std::uint64_t changed = RunSingleProcess(*experiment_, options_).hash;
  for (std::size_t tick = 0; tick < present.size(); ++tick)
    EXPECT_EQ(present[tick], tick < 5 || tick > 14 ? 1U : 0U) << "at tick " << tick;
  EXPECT_THAT(notes,
              testing::ElementsAre("removed 'fb_3' at tick 5", "move: entity 'fb_3' is not in the arena",
                                   testing::AllOf(StartsWith("add: 'fb_3' does not fit at "),
                                                  HasSubstr(": the footbot 'fb_4' stands there, at ")),
                                   HasSubstr("remove: the block 'wall_west' never moves"), "added 'fb_3' at tick 15"));
  EXPECT_THAT(Read("events.csv"), testing::AllOf(HasSubstr("\n5,remove,fb_3,,"), HasSubstr("\n15,add,fb_3,1 1 0")));

  CScriptedRender::on_draw = nullptr;
  options_.events = options_.event_log;
  options_.event_log = (folder_ / "again.csv").string();
  options_.hash_log = (folder_ / "second").string();
  EXPECT_EQ(RunSingleProcess(*experiment_, options_).hash, changed);
  EXPECT_EQ(Read("second"), Read("first"));
}

TEST_F(SteeringTest, TheEndByAVisualisationIsRepeatedToo)
{
  CScriptedRender::on_draw = [](const RenderSetup& setup) { CScriptedRender::terminate = setup.space.GetTick() == 11; };
  options_.event_log = (folder_ / "events.csv").string();
  const RunSummary ended = RunSingleProcess(*experiment_, options_);
  EXPECT_EQ(ended.ticks, 11U);
  EXPECT_THAT(Read("events.csv"), HasSubstr("11,stop,,,visualiser 's',0,,"));

  CScriptedRender::on_draw = nullptr;
  CScriptedRender::terminate = false;
  options_.events = options_.event_log;
  options_.event_log.clear();
  const RunSummary again = RunSingleProcess(*experiment_, options_);
  EXPECT_EQ(again.ticks, 11U);
  EXPECT_EQ(again.hash, ended.hash);
}

TEST_F(SteeringTest, APausedRunLivesOnAndStepsAsAsked)
{
  std::vector<std::uint64_t> drawn;
  std::vector<std::string> phases;
  CScriptedRender::on_draw = [&](const RenderSetup& setup) { drawn.push_back(setup.space.GetTick()); };
  int idle = 0;
  CScriptedRender::on_idle = [&](const RenderSetup& setup)
  {
    EXPECT_EQ(setup.monitor->Status().phase, RunStatus::Phase::kPaused);
    ++idle;
    if (idle == 1)
    {
      EXPECT_TRUE(drawn.empty());
      setup.control->MoveEntity("fb_0", Pose{{1.5, 1.25, 0}, Quaternion::Identity()});
      setup.control->Step(3);
    }
    if (idle == 2)
    {
      // Tick 3 is made, but not shown yet.
      EXPECT_EQ(drawn, (std::vector<std::uint64_t>{0, 1, 2}));
      EXPECT_EQ(setup.monitor->Status().tick, 3U);
      setup.control->Stop();
    }
  };
  options_.paused = true;
  const RunSummary summary = RunSingleProcess(*experiment_, options_);
  EXPECT_EQ(idle, 2);
  EXPECT_EQ(summary.ticks, 3U);
  EXPECT_EQ(drawn.back(), 3U);
}

TEST_F(SteeringTest, NotesSayWhatCameOfARequest)
{
  std::vector<std::string> notes;
  CScriptedRender::on_draw = [&](const RenderSetup& setup)
  {
    if (setup.space.GetTick() == 1) setup.control->MoveEntity("none", {});
    notes.clear();
    for (const RunNote& note : setup.monitor->Notes())
      notes.push_back(fmt::format("{} {} {}", note.tick, note.done, note.text));
  };
  RunSingleProcess(*experiment_, options_);
  EXPECT_THAT(notes, testing::ElementsAre("2 false move: there is no entity 'none'"));
}

TEST_F(SteeringTest, KeepsThePaceThatAVisualisationAsksFor)
{
  using Clock = std::chrono::steady_clock;
  CScriptedRender::on_draw = [](const RenderSetup& setup)
  {
    if (setup.space.GetTick() == 0) setup.control->SetSpeed(20);
    if (setup.space.GetTick() == 40)
    {
      EXPECT_EQ(setup.monitor->Status().speed_wanted, 20);
      EXPECT_GT(setup.monitor->Status().real_time_factor, 0);
      EXPECT_LT(setup.monitor->Status().real_time_factor, 35);
    }
    else
      setup.monitor->Status();
  };
  const auto start = Clock::now();
  EXPECT_EQ(RunSingleProcess(*experiment_, options_).ticks, 40U);
  // At 20 times real time, 39 intervals of 100 ms pass.
  EXPECT_GT(Clock::now() - start, std::chrono::milliseconds(190));
}

TEST_F(SteeringTest, WatchedRobotsShowTheirReadingsAndCommands)
{
  bool seen = false;
  CScriptedRender::on_draw = [&](const RenderSetup& setup)
  {
    const std::uint32_t robot = setup.space.FindEntity("fb_2")->GetIndex();
    EXPECT_EQ(setup.monitor->Robot(robot + 1), nullptr);
    const std::vector<std::uint32_t> watched{robot};
    setup.monitor->Watch(watched);
    if (setup.space.GetTick() != 10) return;
    const RobotStatus* status = setup.monitor->Robot(robot);
    ASSERT_NE(status, nullptr);
    EXPECT_EQ(status->tick, 9U);
    EXPECT_EQ(status->controller, "diffusion");
    ASSERT_EQ(status->sensors.size(), 1U);
    EXPECT_EQ(status->sensors[0].type, "footbot_proximity");
    EXPECT_EQ(status->sensors[0].readings.size(), 24U);
    ASSERT_EQ(status->actuators.size(), 1U);
    ASSERT_EQ(status->actuators[0].readings.size(), 2U);
    EXPECT_EQ(status->actuators[0].readings[0].name, "left");
    EXPECT_EQ(status->actuators[0].readings[0].unit, "rad/s");
    seen = true;
  };
  const std::uint64_t watched = RunSingleProcess(*experiment_, options_).hash;
  EXPECT_TRUE(seen);
  CScriptedRender::on_draw = nullptr;
  EXPECT_EQ(RunSingleProcess(*experiment_, options_).hash, watched);
}

TEST_F(SteeringTest, APauseThatNobodyCouldEndIsRefused)
{
  CScriptedRender::interactive = false;
  options_.paused = true;
  EXPECT_THROW(RunSingleProcess(*experiment_, options_), UsageError);
}

TEST_F(SteeringTest, WrongEventsAreToldWithTheirLine)
{
  const auto error_of = [&](const std::string& line)
  {
    options_.events =
        folder_.Write("wrong.csv", "tick,request,entity,numbers,from\n3,move,fb_0,1 1 0,\n" + line + "\n");
    return test::MessageOf<ConfigurationError>([&] { RunSingleProcess(*experiment_, options_); }, "no error");
  };
  EXPECT_THAT(error_of("2,move,fb_0,1 1 0,"), HasSubstr("wrong.csv:3: tick 2 comes after tick 3"));
  EXPECT_THAT(error_of("4,move,fb_x,1 1 0,"), HasSubstr("wrong.csv:3: the experiment has no entity 'fb_x'"));
  EXPECT_THAT(error_of("4,move,wall_west,1 1 0,"), HasSubstr("cannot move"));
  EXPECT_THAT(error_of("4,move,fb_0,1 one,"), HasSubstr("is no place of three or six numbers"));
  EXPECT_THAT(error_of("4,move,fb_0,1,"), HasSubstr("are no place of three or six numbers"));
  EXPECT_THAT(error_of("4,add,fb_0,,"), HasSubstr("add: 'pose' is missing"));
  EXPECT_THAT(error_of("4,add,fb_0,1 1 0,"), HasSubstr("wrong.csv:3: add: entity 'fb_0' is in the arena already"));
  EXPECT_THAT(error_of("4,remove,fb_x,,"), HasSubstr("wrong.csv:3: the experiment has no entity 'fb_x'"));
  EXPECT_THAT(error_of("4,fly,fb_0,,"), HasSubstr("no request 'fly'"));
  EXPECT_THAT(error_of("x,stop,,,"), HasSubstr("'x' is no tick"));
  EXPECT_THAT(error_of("4,move,fb_0,100 1 0,"), HasSubstr("wrong.csv:3: move: 100, 1, 0 is outside the arena"));
}

}  // namespace
}  // namespace swarmanoid
