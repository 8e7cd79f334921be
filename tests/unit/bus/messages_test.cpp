// The messages of processes that join, leave and are replaced, constants and keys, are those of the IDL.
#include <gtest/gtest.h>

#include "tests/unit/bus/random_messages.h"

namespace swarmanoid
{
namespace
{

TEST(MessageConstants, AreThoseOfTheIdl)
{
  EXPECT_EQ(kProtocolVersion, wire::PROTOCOL_VERSION);
  EXPECT_EQ(kFlagLast, wire::FLAG_LAST);
  EXPECT_EQ(kFlagTerminate, wire::FLAG_TERMINATE);
  EXPECT_EQ(kFlagRepeated, wire::FLAG_REPEATED);
  EXPECT_EQ(kFlagSave, wire::FLAG_SAVE);
  const std::uint32_t uniform[] = {wire::FLAG_UNIFORM_X,  wire::FLAG_UNIFORM_Y,  wire::FLAG_UNIFORM_Z,
                                   wire::FLAG_UNIFORM_QX, wire::FLAG_UNIFORM_QY, wire::FLAG_UNIFORM_QZ,
                                   wire::FLAG_UNIFORM_QW};
  for (std::size_t k = 0; k < std::size(uniform); ++k) EXPECT_EQ(kFlagUniformX << k, uniform[k]);
  EXPECT_EQ(static_cast<std::uint32_t>(RunStatus::Phase::kWaiting), wire::PHASE_WAITING);
  EXPECT_EQ(static_cast<std::uint32_t>(RunStatus::Phase::kRunning), wire::PHASE_RUNNING);
  EXPECT_EQ(static_cast<std::uint32_t>(RunStatus::Phase::kPaused), wire::PHASE_PAUSED);
  EXPECT_EQ(static_cast<std::uint32_t>(RunStatus::Phase::kFinished), wire::PHASE_FINISHED);
}

TEST(MessageBytes, OfJoiningAndLeavingAreThoseOfTheIdl)
{
  Random random(2);
  for (int round = 0; round < kRounds; ++round)
  {
    const WorldMessage world{
        kProtocolVersion,
        random.Number(),
        random.Text(),
        random.Text(),
        random.Number32(),
        random.Text(),
        random.Text(),
        random.Text(),
        random.Number(),
        {random.Number32(), std::vector<std::uint32_t>(random.Length(), random.Number32())},
        random.Flag(),
        random.Real(),
        random.Number(),
        random.Bytes(),
        random.Flag(),
        std::vector<WorldEntity>(random.Length(), {random.Text(), random.Text(), random.Flag(), random.Number32()}),
        std::vector<WorldLibrary>(random.Length(), {random.Text(), random.Text()}),
        {random.Number(),
         std::vector<RecordedFault>(random.Length(), {random.Number(), random.Number32(), FaultKind::kTooSlow})}};
    wire::World wire_world;
    wire_world.protocol(world.protocol);
    wire_world.run(world.run);
    wire_world.experiment(world.experiment);
    wire_world.host(world.host);
    wire_world.pid(world.pid);
    wire_world.file(world.file);
    wire_world.folder(world.folder);
    wire_world.xml(world.xml);
    wire_world.seed(world.seed);
    wire_world.hosts(world.hosts.hosts);
    wire_world.host_of_robots(world.hosts.of_robots);
    wire_world.spread(world.spread);
    wire_world.tick_seconds(world.tick_seconds);
    wire_world.checkpoint_every(world.checkpoint_every);
    wire_world.checkpoint().assign(world.checkpoint.begin(), world.checkpoint.end());
    wire_world.recorded(world.recorded);
    for (const WorldEntity& entity : world.entities)
    {
      wire_world.entities().emplace_back();
      wire_world.entities().back().id(entity.id);
      wire_world.entities().back().kind(entity.kind);
      wire_world.entities().back().movable(entity.movable);
      wire_world.entities().back().first_slot(entity.first_slot);
    }
    for (const WorldLibrary& library : world.libraries)
    {
      wire_world.libraries().emplace_back();
      wire_world.libraries().back().name(library.name);
      wire_world.libraries().back().digest(library.digest);
    }
    wire_world.known_until(world.known.until);
    for (const RecordedFault& fault : world.known.faults)
    {
      wire_world.faults().emplace_back();
      wire_world.faults().back().tick(fault.tick);
      wire_world.faults().back().robot(fault.robot);
      wire_world.faults().back().kind(static_cast<std::uint32_t>(fault.kind));
    }
    ExpectSame<wire::WorldPubSubType>(world, wire_world);

    const JoinMessage join{random.Text(), kProtocolVersion,  random.Number(), random.Text(),
                           random.Flag(), random.Number32(), random.Text(),   0.25 * random.Number32()};
    wire::Join wire_join;
    wire_join.reach(join.reach);
    wire_join.process(join.process);
    wire_join.protocol(join.protocol);
    wire_join.run(join.run);
    wire_join.name(join.name);
    wire_join.ready(join.ready);
    wire_join.incarnation(join.incarnation);
    wire_join.machine(join.machine);
    ExpectSame<wire::JoinPubSubType>(join, wire_join);

    const LeaveMessage leave{random.Number(), random.Number(), random.Text(), random.Text(), random.Text()};
    wire::Leave wire_leave;
    wire_leave.run(leave.run);
    wire_leave.tick(leave.tick);
    wire_leave.name(leave.name);
    wire_leave.process(leave.process);
    wire_leave.error(leave.error);
    ExpectSame<wire::LeavePubSubType>(leave, wire_leave);

    const StatusMessage status{random.Number(), random.Number(), random.Text(), random.Text()};
    wire::Status wire_status;
    wire_status.run(status.run);
    wire_status.tick(status.tick);
    wire_status.name(status.name);
    wire_status.text(status.text);
    ExpectSame<wire::StatusPubSubType>(status, wire_status);

    const SavedStateMessage saved{random.Number(), random.Number(), random.Text(), random.Bytes()};
    wire::SavedState wire_saved;
    wire_saved.run(saved.run);
    wire_saved.tick(saved.tick);
    wire_saved.name(saved.name);
    wire_saved.state().assign(saved.state.begin(), saved.state.end());
    ExpectSame<wire::SavedStatePubSubType>(saved, wire_saved);

    const RecoveryRequestMessage request{random.Number(), random.Text(), random.Text(), random.Number32()};
    wire::RecoveryRequest wire_request;
    wire_request.run(request.run);
    wire_request.process(request.process);
    wire_request.name(request.name);
    wire_request.number(request.number);
    ExpectSame<wire::RecoveryRequestPubSubType>(request, wire_request);

    const RecoveryBlockMessage block{random.Number(), random.Text(), random.Number32(), random.Number32(),
                                     random.Bytes()};
    wire::RecoveryBlock wire_block;
    wire_block.run(block.run);
    wire_block.process(block.process);
    wire_block.number(block.number);
    wire_block.count(block.count);
    wire_block.block().assign(block.block.begin(), block.block.end());
    ExpectSame<wire::RecoveryBlockPubSubType>(block, wire_block);
  }
}

// Fast DDS of an earlier release and other vendors tell instances by the same hash.
TEST(MessageKeys, AreThoseOfTheIdl)
{
  InstanceHandle ours;
  InstanceHandle theirs;
  const JoinMessage join{"some-machine.example:12345", kProtocolVersion, 7, "engine 'ground'", true};
  ColdCall<JoinMessage> call;
  call.out = &join;
  ASSERT_TRUE(ColdType<JoinMessage>().KeyOf(&call, ours));
  wire::Join wire_join;
  wire_join.process(join.process);
  wire::JoinPubSubType join_type;
  ASSERT_TRUE(test::GeneratedKey(join_type, &wire_join, theirs));
  EXPECT_EQ(ours, theirs);

  const ViewRequestMessage request{"x:1", 7, 30, false, {}};
  ColdCall<ViewRequestMessage> client_request;
  client_request.out = &request;
  ASSERT_TRUE(ColdType<ViewRequestMessage>().KeyOf(&client_request, ours));
  wire::ViewRequest wire_request;
  wire_request.client("x:1");
  wire::ViewRequestPubSubType request_type;
  ASSERT_TRUE(test::GeneratedKey(request_type, &wire_request, theirs));
  EXPECT_EQ(ours, theirs);
  EXPECT_FALSE(test::IsKeyed(ColdType<LeaveMessage>()));
  EXPECT_FALSE(test::IsKeyed(wire::LeavePubSubType()));
}

}  // namespace
}  // namespace swarmanoid
