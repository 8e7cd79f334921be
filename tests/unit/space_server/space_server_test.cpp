#include "space_server/space_server.h"

#include <gmock/gmock.h>

#include "tests/world/message_of.h"
#include "tests/world/small_experiment.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;

EntityConfiguration Movable(const std::string& id, double x)
{
  return test::Entity(EntityKind::kFootbot, id, {x, 0, 0});
}

Experiment TwoEngines()
{
  Experiment experiment;
  experiment.arena_size = {10, 10, 1};
  experiment.max_clock = 3;
  experiment.entities = {Movable("a", 1), Movable("b", 2), Movable("c", 3)};
  experiment.engines.resize(2);
  experiment.engines[0].entities = {0, 2};
  experiment.engines[1].entities = {1};
  return experiment;
}

struct Assigned
{
  const Experiment experiment;
  const Assignment assignment = MakeAssignment(experiment, 1);
};

// It holds a space server with its own experiment.
struct TestServer : Assigned, SpaceServer
{
  explicit TestServer(const Experiment& of) : Assigned{of}, SpaceServer(experiment, assignment, ".") {}
};

EngineUpdate UpdateOf(std::uint32_t engine, std::uint64_t tick, const std::vector<double>& xs)
{
  EngineUpdate update;
  update.engine = engine;
  update.tick = tick;
  update.poses = xs;
  update.poses.resize(6 * xs.size(), 0);
  update.poses.resize(7 * xs.size(), 1);
  return update;
}

TEST(SpaceServer, UpdatesOfAllEnginesMakeTheNextState)
{
  TestServer server(TwoEngines());
  const EngineUpdate first = UpdateOf(0, 1, {1.5, 3.5});
  const EngineUpdate second = UpdateOf(1, 1, {2.5});
  const std::array<const EngineUpdate*, 2> updates{&first, &second};
  server.Advance(updates, {});
  const SpaceState& state = server.State();
  EXPECT_EQ(state.tick, 1U);
  EXPECT_FALSE(state.last);
  EXPECT_THAT(std::vector<double>(state.poses.begin(), state.poses.begin() + 3), ElementsAre(1.5, 2.5, 3.5));
}

// A role that does not read this space would draw other random numbers.
TEST(SpaceServer, ARunBeginsAgainInOneProcessAloneAndIsNotSavedThen)
{
  const Experiment experiment = TwoEngines();
  const Assignment assignment = MakeAssignment(experiment, 1);
  SpaceServer of_cluster(experiment, assignment, ".");
  EXPECT_THROW(of_cluster.Editor().BeginAgain(1, 0), std::logic_error);
  EXPECT_EQ(of_cluster.Space().FirstTick(), 0U);

  SpaceServer server(experiment, assignment, ".");
  server.ShareSpace();
  ByteWriter saved;
  EXPECT_NO_THROW(server.SaveState(saved));
  server.Editor().BeginAgain(1, 0);
  EXPECT_EQ(server.Space().FirstTick(), 1U);
  EXPECT_THROW(server.SaveState(saved), std::runtime_error);
}

TEST(SpaceServer, OnlyAttributesThatChangedTravel)
{
  TestServer server(TwoEngines());
  const std::uint32_t slot = server.Space().FindEntity("b")->SlotOf("beacon");
  ControlCommands commands;
  commands.attributes.Add(slot, 0xff0000);
  commands.attributes.Add(slot + 1, server.Space().Attributes()[slot + 1]);  // no change
  const std::array<const ControlCommands*, 1> from_hosts{&commands};
  server.Advance({}, from_hosts);
  EXPECT_THAT(server.State().attributes.slots, ElementsAre(slot));
  EXPECT_THAT(server.State().attributes.values, ElementsAre(0xff0000));
  server.Advance({}, {});
  EXPECT_TRUE(server.State().attributes.slots.empty());
}

TEST(SpaceServer, AnEngineHasTheLastWordOnAnAttribute)
{
  TestServer server(TwoEngines());
  const std::uint32_t slot = server.Space().FindEntity("b")->SlotOf("turret_angle");
  ControlCommands commands;
  commands.attributes.Add(slot, 1);
  EngineUpdate update = UpdateOf(1, 1, {2});
  update.attributes.Add(slot, 2);
  const std::array<const ControlCommands*, 1> from_hosts{&commands};
  const std::array<const EngineUpdate*, 1> from_engines{&update};
  server.Advance(from_engines, from_hosts);
  EXPECT_EQ(server.Space().Attributes()[slot], 2);
}

TEST(SpaceServer, TheLastTickIsMarked)
{
  TestServer server(TwoEngines());
  for (int tick = 0; tick < 3; ++tick)
  {
    EXPECT_FALSE(server.State().last);
    server.Advance({}, {});
  }
  EXPECT_TRUE(server.State().last);
}

TEST(SpaceServer, AMoveIsToldOnceWithItsPose)
{
  TestServer server(TwoEngines());
  server.Move({2, {{9, 9, 0}, Quaternion::Identity()}});
  server.Move({0, {{8, 8, 0}, Quaternion::Identity()}});
  server.Move({2, {{7, 7, 0}, Quaternion::Identity()}});
  EXPECT_THAT(server.State().moved, ElementsAre(0, 2));
  EXPECT_EQ(server.State().poses[2], 7);
  server.Advance({}, {});
  EXPECT_TRUE(server.State().moved.empty());
}

// A checkpoint has the server's own state beside the snapshot.
TEST(SpaceServer, ARestoredOneKnowsItsEndAndWhoWasMoved)
{
  const Experiment experiment = TwoEngines();
  const Assignment assignment = MakeAssignment(experiment, 1);
  for (const bool ends : {false, true})
  {
    SpaceServer first(experiment, assignment, ".");
    first.Advance({}, {});
    first.Move({2, {{9, 9, 0}, Quaternion::Identity()}});
    if (ends) first.Finish();
    SpaceSnapshot snapshot;
    first.WriteSnapshot(snapshot);
    ByteWriter written;
    first.SaveState(written);

    SpaceServer restored(experiment, assignment, ".");
    ByteReader state(written.Bytes());
    restored.LoadState(snapshot, state);
    EXPECT_TRUE(state.AtEnd());
    EXPECT_EQ(restored.IsLast(), ends);
    EXPECT_FALSE(restored.HasFailed());
    EXPECT_THAT(restored.State().moved, ElementsAre(2));
    EXPECT_EQ(restored.State().tick, 1U);
    EXPECT_EQ(restored.Space().Hash(), first.Space().Hash());
  }
}

Experiment Limited(BeyondLimit policy)
{
  Experiment experiment = TwoEngines();
  experiment.limit_m = 50;
  experiment.beyond_limit = policy;
  return experiment;
}

// The engine of a and c takes them to these places.
void AdvanceTo(SpaceServer& server, double a, double c)
{
  const EngineUpdate update = UpdateOf(0, server.Space().GetTick() + 1, {a, c});
  server.Check(update);
  const std::array<const EngineUpdate*, 1> updates{&update};
  server.Advance(updates, {});
}

TEST(SpaceServer, WhoIsTakenBeyondTheLimitStopsTheRunByName)
{
  TestServer server(Limited(BeyondLimit::kStop));
  AdvanceTo(server, 60, -50);
  EXPECT_EQ(test::MessageOf<std::runtime_error>([&] { AdvanceTo(server, 60, -50.5); }),
            "engine '' at tick 1: the footbot 'c' left the world: it is at -50.5, 0, 0, more than 50 m outside the "
            "arena, which reaches from 0, 0, 0 to 10, 10, 1; give <arena> a larger limit, or a beyond_limit of hold "
            "or remove");
}

TEST(SpaceServer, WhoIsTakenBeyondTheLimitIsHeldWhereItWas)
{
  TestServer server(Limited(BeyondLimit::kHold));
  AdvanceTo(server, 1.5, 59);
  for (int tick = 0; tick < 2; ++tick)
  {
    AdvanceTo(server, 2.5, 1e300);
    EXPECT_EQ(server.Space().GetPose(2).position.x(), 59);
    EXPECT_EQ(server.Space().GetPose(0).position.x(), 2.5);
    EXPECT_THAT(server.State().moved, ElementsAre(2)) << "its engine is told";
  }
}

TEST(SpaceServer, WhoIsTakenBeyondTheLimitLeavesTheArena)
{
  TestServer server(Limited(BeyondLimit::kRemove));
  AdvanceTo(server, 1.5, 61);
  EXPECT_FALSE(server.Space().IsPresent(2));
  EXPECT_EQ(server.Space().GetPose(2).position, WaitingPose(server.experiment.entities[2], 2).position);
  const SpaceState& state = server.State();
  EXPECT_THAT(state.moved, ElementsAre(2));
  EXPECT_THAT(state.attributes.slots, ElementsAre(server.Space().PresenceSlot(2)));
  CSwarmanoidSpace replica(server.experiment);
  replica.Apply(state);
  EXPECT_THAT(replica.Absent(), ElementsAre(2));
  EXPECT_EQ(replica.Hash(), server.Space().Hash());
  server.Move({2, {{5, 5, 0}, Quaternion::Identity()}});
  EXPECT_TRUE(server.Space().IsPresent(2));
}

TEST(SpaceServer, WhatCannotBePartOfTheStateChangesNothing)
{
  TestServer server(TwoEngines());
  const std::uint64_t before = server.Space().Hash();
  const double nan = __builtin_nan("");
  EXPECT_THROW(server.Move({0, {{nan, 1, 0}, Quaternion::Identity()}}), std::invalid_argument);
  EXPECT_THROW(server.Move({0, {{1, 1, 0}, Quaternion(2, 0, 0, 0)}}), std::invalid_argument);
  EXPECT_THROW(server.SetAttribute(0, nan), std::invalid_argument);
  EXPECT_THROW(server.SetAttribute(1000000, 1), std::invalid_argument);
  EXPECT_THROW(server.SetAttribute(server.Space().PresenceSlot(0), 0), std::invalid_argument);
  ControlCommands commands;
  commands.attributes.Add(0x7ffffff0, 1);
  EXPECT_THROW(server.Check(commands), std::runtime_error);
  EXPECT_THROW(server.Check(UpdateOf(0, 1, {1})), std::runtime_error);
  EXPECT_THROW(server.Check(UpdateOf(77, 1, {1})), std::runtime_error);
  EXPECT_EQ(server.Space().Hash(), before);
  EXPECT_TRUE(server.State().moved.empty());
}

// Functions that write down their calls, move an entity and end the run at tick 2.
class Recorder : public CExperimentFunctions
{
public:
  static inline std::string calls;
  static inline Outcome outcome_at_2 = Outcome::kDone;
  static inline std::string reason;
  static inline bool throw_in_post_step = false;

  void Init(const TConfigurationTree, SpaceEditor& space) override { Note("Init", space); }
  void PreStep(SpaceEditor& space) override { Note("Pre", space); }
  void PostStep(SpaceEditor& space) override
  {
    Note("Post", space);
    if (throw_in_post_step) throw std::runtime_error("no luck");
    space.MoveEntity("b", {{5, 5, 0}, Quaternion::Identity()});
    space.SetAttribute("a", "beacon", 0x00ff00);
  }
  Outcome IsFinished(const SpaceEditor& space) override
  {
    if (space.GetSpace().GetTick() != 2) return Outcome::kRunning;
    return reason.empty() ? outcome_at_2 : Failed(reason);
  }
  void Destroy(SpaceEditor& space) override { Note("Destroy", space); }

private:
  static void Note(const std::string& call, const SpaceEditor& space)
  {
    calls += call + std::to_string(space.GetSpace().GetTick()) + " ";
  }
};

REGISTER_EXPERIMENT_FUNCTIONS(Recorder, {.label = "recorder"})

Experiment WithRecorder()
{
  Experiment experiment = TwoEngines();
  experiment.max_clock = 100;
  experiment.functions = {{"recorder", "goal", {}, {}}};
  Recorder::calls.clear();
  Recorder::outcome_at_2 = CExperimentFunctions::Outcome::kDone;
  Recorder::reason.clear();
  Recorder::throw_in_post_step = false;
  return experiment;
}

TEST(ExperimentFunctions, RunAroundTheStepsAndEndTheExperiment)
{
  TestServer server(WithRecorder());
  while (!server.IsLast()) server.Advance({}, {});
  server.Destroy();
  server.Destroy();
  EXPECT_EQ(Recorder::calls, "Init0 Pre0 Post1 Pre1 Post2 Destroy2 ");
  EXPECT_FALSE(server.HasFailed());
}

TEST(ExperimentFunctions, WhatTheyChangeTravels)
{
  TestServer server(WithRecorder());
  server.Advance({}, {});
  EXPECT_THAT(server.State().moved, ElementsAre(1));
  EXPECT_THAT(server.State().attributes.values, ElementsAre(0x00ff00));
}

TEST(ExperimentFunctions, TheyCanDeclareFailure)
{
  TestServer server(WithRecorder());
  Recorder::outcome_at_2 = CExperimentFunctions::Outcome::kFailed;
  while (!server.IsLast()) server.Advance({}, {});
  EXPECT_TRUE(server.HasFailed());
  EXPECT_EQ(server.Failure(), "experiment functions 'goal' gave no reason");
}

TEST(ExperimentFunctions, TheyCanSayWhyTheyFailed)
{
  TestServer server(WithRecorder());
  EXPECT_EQ(server.Failure(), "");
  Recorder::reason = "3 of 10 preys";
  while (!server.IsLast()) server.Advance({}, {});
  EXPECT_TRUE(server.HasFailed());
  EXPECT_EQ(server.Failure(), "experiment functions 'goal' say: 3 of 10 preys");
}

TEST(ExperimentFunctions, AnExceptionIsReportedWithNameAndTick)
{
  TestServer server(WithRecorder());
  Recorder::throw_in_post_step = true;
  EXPECT_THAT([&] { server.Advance({}, {}); },
              testing::ThrowsMessage<std::runtime_error>(
                  "experiment functions 'goal' (recorder): PostStep at tick 1 failed: no luck"));
}

// a holds b, b holds c, all in one engine; a shelf d.
class SpaceServerHolds : public testing::Test
{
protected:
  static Experiment Chain()
  {
    Experiment experiment = TwoEngines();
    experiment.engines.resize(1);
    experiment.engines[0].entities = {0, 1, 2};
    return experiment;
  }
  SpaceServerHolds()
  {
    EngineUpdate update = UpdateOf(0, 1, {1, 2, 3});
    update.attributes.Add(Slot("a"), 1 + 1);
    update.attributes.Add(Slot("b"), 1 + 2);
    server.Check(update);
    const std::array<const EngineUpdate*, 1> updates{&update};
    server.Advance(updates, {});
    server.State();
  }
  std::uint32_t Slot(const char* id) const { return server.Space().FindEntity(id)->SlotOf("gripped"); }
  double Held(const char* id) const { return server.Space().Attributes()[Slot(id)]; }
  static MoveRequest To(std::uint32_t entity, double x, bool present = true)
  {
    return {entity, {{x, 5, 0}, Quaternion::Identity()}, present};
  }

  TestServer server{Chain()};
};

TEST_F(SpaceServerHolds, WhoIsMovedAloneLetsGoAndIsLetGo)
{
  server.Move(To(1, 5));
  EXPECT_EQ(Held("a"), 0);
  EXPECT_EQ(Held("b"), 0);
  EXPECT_THAT(server.State().attributes.slots, testing::UnorderedElementsAre(Slot("a"), Slot("b")));
}

TEST_F(SpaceServerHolds, ThoseWhoAreMovedTogetherGoOnToHoldOneAnother)
{
  const std::array<MoveRequest, 2> moves{To(1, 5), To(2, 6)};
  server.Move(moves);
  EXPECT_EQ(Held("a"), 0);
  EXPECT_EQ(Held("b"), 1 + 2);
  EXPECT_THAT(server.State().moved, ElementsAre(1, 2));
}

TEST_F(SpaceServerHolds, WhoLeavesTheArenaLetsGoAndIsLetGoThoughTheOthersAreMoved)
{
  const std::array<MoveRequest, 3> moves{To(0, 4), To(1, -5, false), To(2, 6)};
  server.Move(moves);
  EXPECT_EQ(Held("a"), 0);
  EXPECT_EQ(Held("b"), 0);
}

TEST_F(SpaceServerHolds, AMistakeInOneMoveMovesNobody)
{
  const std::array<MoveRequest, 2> moves{To(1, 5), To(2, 1e9)};
  EXPECT_THROW(server.Move(moves), std::invalid_argument);
  EXPECT_EQ(server.Space().GetPose(1).position.x(), 2);
  EXPECT_EQ(Held("a"), 1 + 1);
}

TEST_F(SpaceServerHolds, FunctionsMayEndAHoldAndMakeNone)
{
  server.SetAttribute(Slot("a"), 0);
  EXPECT_EQ(Held("a"), 0);
  EXPECT_EQ(Held("b"), 1 + 2);
  EXPECT_THAT(server.State().moved, ElementsAre(0)) << "the engine hears of it";
  EXPECT_THROW(server.SetAttribute(Slot("a"), 1 + 2), std::invalid_argument);
  EXPECT_EQ(Held("a"), 0);
}

TEST_F(SpaceServerHolds, HostsAndLoopsAreRefused)
{
  ControlCommands commands;
  commands.attributes.Add(Slot("c"), 0);
  EXPECT_THROW(server.Check(commands), std::runtime_error);
  EngineUpdate update = UpdateOf(0, 2, {1, 2, 3});
  update.attributes.Add(Slot("c"), 1 + 0);
  EXPECT_THROW(server.Check(update), std::runtime_error);
}

}  // namespace
}  // namespace swarmanoid
