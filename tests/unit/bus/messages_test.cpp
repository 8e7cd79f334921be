// Every message, with random contents, has the bytes of the type that is made from the IDL, both ways.
#include <gmock/gmock.h>

#include <limits>
#include <random>

#include "common/bus/message_type.h"
#include "swarmanoid.h"
#include "swarmanoidPubSubTypes.h"

namespace swarmanoid
{
namespace
{

constexpr int kRounds = 100;

class Random
{
public:
  explicit Random(unsigned seed) : engine_(seed) {}
  std::uint64_t Number() { return engine_(); }
  std::uint32_t Number32() { return static_cast<std::uint32_t>(engine_()); }
  std::size_t Length() { return engine_() % 6; }
  bool Flag() { return engine_() % 2 == 1; }
  double Real()
  {
    return std::ldexp(static_cast<double>(engine_() % 2000001) - 1e6, static_cast<int>(engine_() % 60) - 30);
  }
  std::string Text()
  {
    static const std::string kLetters[] = {"a", "Z", " ", "'", "é", "→", "𝄞", "0"};
    std::string text;
    for (std::size_t k = engine_() % 12; k > 0; --k) text += kLetters[engine_() % 8];
    return text;
  }
  std::vector<double> Reals()
  {
    std::vector<double> reals(Length());
    for (double& real : reals) real = Real();
    return reals;
  }
  std::vector<std::uint32_t> Ascending()
  {
    std::vector<std::uint32_t> numbers;
    std::uint32_t number = 0;
    for (std::size_t k = Length(); k > 0; --k)
      numbers.push_back(number += 1 + static_cast<std::uint32_t>(engine_() % 9));
    return numbers;
  }
  std::vector<char> Bytes()
  {
    std::vector<char> bytes(Length());
    for (char& byte : bytes) byte = static_cast<char>(engine_());
    return bytes;
  }

private:
  std::mt19937_64 engine_;
};

template <class Support, class Wire>
std::string GeneratedBytes(Wire& wire)
{
  static Support support;  // the largest size of a type takes long to count
  Payload payload(100000);
  EXPECT_TRUE(support.serialize(&wire, &payload));
  return {reinterpret_cast<const char*>(payload.data), payload.length};
}

template <class... Parts>
std::string OurBytes(const Parts&... parts)
{
  std::string bytes(PayloadSize(parts...), '?');
  WritePayload(bytes.data(), parts...);
  return bytes;
}

// What we write is what the generated type writes, and what we read of it is what we wrote.
template <class Support, class Message, class Wire>
void ExpectSame(const Message& message, Wire& wire)
{
  const std::string theirs = GeneratedBytes<Support>(wire);
  ASSERT_EQ(OurBytes(message), theirs);
  Message read;
  ReadPayload<Message>(theirs, read);
  EXPECT_EQ(OurBytes(read), theirs);
}

template <class Support, class Message, class Wire>
void ExpectSame(const MessageHeader& header, const Message& message, Wire& wire)
{
  wire.run(header.run);
  wire.tick(header.tick);
  wire.source(static_cast<std::uint16_t>(header.source));
  wire.incarnation(static_cast<std::uint16_t>(header.incarnation));
  const std::string theirs = GeneratedBytes<Support>(wire);
  ASSERT_EQ(OurBytes(header, message), theirs);
  MessageHeader seen;
  Message read;
  const auto choose = [&](const MessageHeader&) { return &read; };
  EXPECT_EQ(ReadTickPayload<Message>(theirs, seen, choose, [](const MessageHeader&, const Message&) {}), &read);
  EXPECT_EQ(OurBytes(seen, read), theirs);
}

MessageHeader RandomHeader(Random& random)
{
  return {random.Number(), random.Number(),           random.Number32() % 65536,
          random.Flag(),   random.Number32() % 65536, random.Flag()};
}

AttributeChanges RandomChanges(Random& random)
{
  AttributeChanges changes;
  for (const std::uint32_t slot : random.Ascending()) changes.Add(slot, random.Real());
  return changes;
}

std::uint32_t FlagsOf(bool first, bool repeated)
{
  return (first ? wire::FLAG_LAST : 0U) | (repeated ? wire::FLAG_REPEATED : 0U);
}

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

// Every set of columns that are the same for all entities; with all seven one goes whole, and with one entity none is
// shorter.
TEST(MessageBytes, OfPosesHaveUniformColumnsAsOneNumber)
{
  Random random(4);
  for (std::uint32_t uniform = 0; uniform < 128; ++uniform)
    for (const std::size_t entities : {0U, 1U, 2U, 5U})
    {
      UpdateMessage update;
      std::vector<double> sent;
      const std::uint32_t shortened = entities < 2 ? 0 : uniform == 127 ? 63 : uniform;
      for (std::uint32_t k = 0; k < 7; ++k)
      {
        const double same = k == 2 ? -0.0 : random.Real();
        for (std::size_t e = 0; e < entities; ++e)
        {
          update.poses.push_back(uniform >> k & 1U ? same : same + 1 + static_cast<double>(e * (4 - e)));
          if (e == 0 || (shortened >> k & 1U) == 0) sent.push_back(update.poses.back());
        }
      }
      const MessageHeader header = RandomHeader(random);
      wire::EngineUpdate wire_update;
      wire_update.poses(sent);
      wire_update.flags(FlagsOf(false, header.repeated) | shortened * wire::FLAG_UNIFORM_X);
      ExpectSame<wire::EngineUpdatePubSubType>(header, update, wire_update);
    }
}

// Zero and minus zero are two values.
TEST(MessageBytes, OfPosesTellTheSignOfZero)
{
  EXPECT_EQ(UniformColumns({0.0, -0.0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2}), 0b0111110U);
}

TEST(MessageBytes, OfPosesMustFitTheFlags)
{
  std::vector<double> numbers(9, 1.0);
  EXPECT_FALSE(SpreadColumns(numbers, 127));  // how many entities?
  EXPECT_FALSE(SpreadColumns(numbers, 0b1111000));
  EXPECT_TRUE(SpreadColumns(numbers, 0b0011111));
  EXPECT_EQ(numbers.size(), 14U);
  std::vector<double> few(3, 1.0);
  EXPECT_FALSE(SpreadColumns(few, 0b0000111));
}

TEST(MessageBytes, OfATickAreThoseOfTheIdl)
{
  Random random(1);
  for (int round = 0; round < kRounds; ++round)
  {
    const MessageHeader header = RandomHeader(random);
    SpaceState state;
    state.last = random.Flag();
    state.poses = random.Reals();
    state.attributes = RandomChanges(random);
    state.moved = random.Ascending();
    wire::SpaceState wire_state;
    wire_state.poses(state.poses);
    wire_state.flags(FlagsOf(state.last, header.repeated) | (header.save ? wire::FLAG_SAVE : 0U));
    wire_state.attribute_values(state.attributes.values);
    wire_state.attribute_slots(state.attributes.slots);
    wire_state.moved(state.moved);
    ExpectSame<wire::SpaceStatePubSubType>(header, state, wire_state);

    ControlCommands commands;
    commands.values = random.Reals();
    commands.attributes = RandomChanges(random);
    commands.faults.robots = random.Ascending();
    for (std::size_t k = 0; k < commands.faults.robots.size(); ++k)
      commands.faults.kinds.push_back(static_cast<FaultKind>(1 + k % 3));
    wire::ControlCommands wire_commands;
    wire_commands.values(commands.values);
    wire_commands.flags(FlagsOf(false, header.repeated));
    wire_commands.attribute_values(commands.attributes.values);
    wire_commands.attribute_slots(commands.attributes.slots);
    wire_commands.fault_robots(commands.faults.robots);
    for (const FaultKind kind : commands.faults.kinds)
      wire_commands.fault_kinds().push_back(static_cast<std::uint32_t>(kind));
    ExpectSame<wire::ControlCommandsPubSubType>(header, commands, wire_commands);

    UpdateMessage update;
    update.poses = random.Reals();
    update.attributes = RandomChanges(random);
    update.recorded = random.Reals();
    wire::EngineUpdate wire_update;
    wire_update.poses(update.poses);
    wire_update.flags(FlagsOf(false, header.repeated));
    wire_update.attribute_values(update.attributes.values);
    wire_update.attribute_slots(update.attributes.slots);
    wire_update.recorded(update.recorded);
    ExpectSame<wire::EngineUpdatePubSubType>(header, update, wire_update);

    SensorFrame frame;
    frame.values = random.Reals();
    wire::SensorFrame wire_frame;
    wire_frame.values(frame.values);
    ExpectSame<wire::SensorFramePubSubType>(header, frame, wire_frame);

    const auto expect_region =
        [&]<class Support, class Message, class Wire>(Support*, Message message, Wire wire_message)
    {
      message.epoch = random.Number32();
      message.number = random.Number32();
      for (std::uint32_t part = 0; part < random.Number32() % 4; ++part)
      {
        message.sizes.push_back(random.Number32() % 20);
        for (std::uint32_t k = 0; k < message.sizes.back(); ++k)
          message.bytes.push_back(static_cast<char>(random.Number32()));
      }
      wire_message.epoch(message.epoch);
      wire_message.number(message.number);
      wire_message.flags(FlagsOf(false, header.repeated));
      wire_message.sizes(message.sizes);
      wire_message.bytes({message.bytes.begin(), message.bytes.end()});
      ExpectSame<Support>(header, message, wire_message);
    };
    expect_region(static_cast<wire::RegionTaskPubSubType*>(nullptr), RegionTaskMessage(), wire::RegionTask());
    expect_region(static_cast<wire::RegionHaloPubSubType*>(nullptr), RegionHaloMessage(), wire::RegionHalo());
    expect_region(static_cast<wire::RegionResultPubSubType*>(nullptr), RegionResultMessage(), wire::RegionResult());

    const DrawnMessage drawn{random.Flag()};
    wire::Drawn wire_drawn;
    wire_drawn.flags(FlagsOf(drawn.terminate, header.repeated));
    ExpectSame<wire::DrawnPubSubType>(header, drawn, wire_drawn);
  }
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
        random.Number32(),
        random.Flag(),
        random.Real(),
        random.Number(),
        random.Bytes(),
        random.Flag(),
        std::vector<WorldEntity>(random.Length(), {random.Text(), random.Text(), random.Flag(), random.Number32()}),
        std::vector<WorldLibrary>(random.Length(), {random.Text(), random.Text()}),
        {random.Number(),
         std::vector<KnownFault>(random.Length(), {random.Number(), random.Number32(), FaultKind::kTooSlow})}};
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
    wire_world.hosts(world.hosts);
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
    for (const KnownFault& fault : world.known.faults)
    {
      wire_world.faults().emplace_back();
      wire_world.faults().back().tick(fault.tick);
      wire_world.faults().back().robot(fault.robot);
      wire_world.faults().back().kind(static_cast<std::uint32_t>(fault.kind));
    }
    ExpectSame<wire::WorldPubSubType>(world, wire_world);

    const JoinMessage join{random.Text(), kProtocolVersion,  random.Number(), random.Text(),
                           random.Flag(), random.Number32(), random.Text()};
    wire::Join wire_join;
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

TEST(MessageBytes, OfWorkersOnOfferedMachinesAreThoseOfTheIdl)
{
  Random random(5);
  for (int round = 0; round < kRounds; ++round)
  {
    const WorkerRequestMessage request{
        random.Text(), random.Number(), random.Text(),     random.Text(),    {random.Text(), random.Text()},
        random.Real(), random.Number(), random.Number32(), random.Number32()};
    wire::WorkerRequest wire_request;
    wire_request.client(request.client);
    wire_request.run(request.run);
    wire_request.machine(request.machine);
    wire_request.program(request.program);
    wire_request.words(request.words);
    wire_request.step_timeout(request.step_timeout_s);
    wire_request.memory_limit(request.memory_limit);
    wire_request.signal(request.signal);
    wire_request.taken(request.taken);
    ExpectSame<wire::WorkerRequestPubSubType>(request, wire_request);

    const WorkerReportMessage report{random.Text(),     random.Number(),   random.Text(), random.Number32(),
                                     random.Bytes(),    random.Bytes(),    random.Text(), random.Flag(),
                                     random.Number32(), random.Number32(), random.Bytes()};
    wire::WorkerReport wire_report;
    wire_report.client(report.client);
    wire_report.run(report.run);
    wire_report.process(report.process);
    wire_report.number(report.number);
    wire_report.output().assign(report.output.begin(), report.output.end());
    wire_report.errors().assign(report.errors.begin(), report.errors.end());
    wire_report.refusal(report.refusal);
    wire_report.ended(report.ended);
    wire_report.exit_code(report.exit_code);
    wire_report.signal(report.signal);
    wire_report.activity().assign(report.activity.begin(), report.activity.end());
    ExpectSame<wire::WorkerReportPubSubType>(report, wire_report);
  }
}

TEST(MessageBytes, OfUsersRequestsAreThoseOfTheIdl)
{
  Random random(3);
  for (int round = 0; round < kRounds; ++round)
  {
    const ControlRequestMessage request{random.Text(),  random.Number32(), random.Text(),  random.Text(),
                                        random.Reals(), random.Text(),     random.Number()};
    wire::ControlRequest wire_request;
    wire_request.client(request.client);
    wire_request.number(request.number);
    wire_request.verb(request.verb);
    wire_request.entity(request.entity);
    wire_request.numbers(request.numbers);
    wire_request.user(request.user);
    wire_request.run(request.run);
    ExpectSame<wire::ControlRequestPubSubType>(request, wire_request);

    const ControlReplyMessage reply{random.Text(), random.Number32(), random.Flag(), random.Number(), random.Text()};
    wire::ControlReply wire_reply;
    wire_reply.client(reply.client);
    wire_reply.number(reply.number);
    wire_reply.ok(reply.ok);
    wire_reply.tick(reply.tick);
    wire_reply.text(reply.text);
    ExpectSame<wire::ControlReplyPubSubType>(reply, wire_reply);

    const ViewRequestMessage view_request{random.Text(), random.Number(), random.Real(), random.Flag(),
                                          random.Ascending()};
    wire::ViewRequest wire_view_request;
    wire_view_request.client(view_request.client);
    wire_view_request.run(view_request.run);
    wire_view_request.views(view_request.views);
    wire_view_request.every_tick(view_request.every_tick);
    wire_view_request.robots(view_request.robots);
    ExpectSame<wire::ViewRequestPubSubType>(view_request, wire_view_request);
  }
}

std::vector<DeviceStatus> RandomDevices(Random& random, std::vector<wire::Device>& wire)
{
  std::vector<DeviceStatus> devices(random.Length());
  for (DeviceStatus& device : devices)
  {
    device.type = random.Text();
    wire.emplace_back();
    wire.back().type(device.type);
    for (std::size_t k = random.Length(); k > 0; --k)
    {
      device.readings.push_back({random.Text(), random.Text(), random.Flag() ? HUGE_VAL : random.Real()});
      wire.back().readings().emplace_back();
      wire.back().readings().back().name(device.readings.back().name);
      wire.back().readings().back().unit(device.readings.back().unit);
      wire.back().readings().back().value(device.readings.back().value);
    }
  }
  return devices;
}

TEST(MessageBytes, OfWhatIsShownAreThoseOfTheIdl)
{
  Random random(4);
  for (int round = 0; round < kRounds; ++round)
  {
    ViewMessage view;
    view.run = random.Number();
    view.snapshot.tick = random.Number();
    view.snapshot.last = random.Flag();
    view.snapshot.real_time_factor = random.Real();
    view.snapshot.poses = random.Reals();
    view.snapshot.attributes = random.Reals();
    wire::View wire_view;
    wire_view.run(view.run);
    wire_view.tick(view.snapshot.tick);
    wire_view.source(0);
    wire_view.poses(view.snapshot.poses);
    wire_view.flags(FlagsOf(view.snapshot.last, false));
    wire_view.attributes(view.snapshot.attributes);
    wire_view.real_time_factor(view.snapshot.real_time_factor);
    ExpectSame<wire::ViewPubSubType>(view, wire_view);

    RunStatusMessage status;
    status.run = random.Number();
    status.status.tick = random.Number();
    status.status.phase = random.Flag() ? RunStatus::Phase::kPaused : RunStatus::Phase::kFinished;
    status.status.speed_wanted = random.Real();
    status.status.real_time_factor = random.Real();
    status.status.ticks_per_second = random.Real();
    status.status.ended = random.Text();
    wire::RunStatus wire_status;
    wire_status.run(status.run);
    wire_status.tick(status.status.tick);
    wire_status.phase(status.status.phase == RunStatus::Phase::kPaused ? wire::PHASE_PAUSED : wire::PHASE_FINISHED);
    wire_status.speed_wanted(status.status.speed_wanted);
    wire_status.real_time_factor(status.status.real_time_factor);
    wire_status.ticks_per_second(status.status.ticks_per_second);
    wire_status.ended(status.status.ended);
    for (std::size_t k = random.Length(); k > 0; --k)
    {
      const ProcessStatus process{random.Text(), random.Text(), random.Number(), random.Real(), random.Text()};
      status.status.processes.push_back(process);
      wire_status.processes().emplace_back();
      wire_status.processes().back().name(process.name);
      wire_status.processes().back().process(process.process);
      wire_status.processes().back().tick(process.tick);
      wire_status.processes().back().late_s(process.late_s);
      wire_status.processes().back().doing(process.doing);
    }
    ExpectSame<wire::RunStatusPubSubType>(status, wire_status);

    RobotStatusMessage robots;
    robots.run = random.Number();
    robots.tick = random.Number();
    robots.source = random.Number32();
    wire::RobotStatus wire_robots;
    wire_robots.run(robots.run);
    wire_robots.tick(robots.tick);
    wire_robots.source(robots.source);
    for (std::size_t k = random.Length(); k > 0; --k)
    {
      RobotStatus robot;
      wire::Robot wire_robot;
      robot.entity = random.Number32();
      robot.controller = random.Text();
      robot.text = random.Text();
      robot.state = random.Text();
      robot.sensors = RandomDevices(random, wire_robot.sensors());
      robot.actuators = RandomDevices(random, wire_robot.actuators());
      wire_robot.entity(robot.entity);
      wire_robot.controller(robot.controller);
      wire_robot.text(robot.text);
      wire_robot.state(robot.state);
      robots.robots.push_back(robot);
      wire_robots.robots().push_back(wire_robot);
    }
    ExpectSame<wire::RobotStatusPubSubType>(robots, wire_robots);
    RobotStatusMessage read;
    ReadPayload<RobotStatusMessage>(OurBytes(robots), read);
    for (const RobotStatus& robot : read.robots) EXPECT_EQ(robot.tick, robots.tick);
  }
}

// Fast DDS of an earlier release and other vendors tell instances by the same hash.
TEST(MessageKeys, AreThoseOfTheIdl)
{
  eprosima::fastrtps::rtps::InstanceHandle_t ours;
  eprosima::fastrtps::rtps::InstanceHandle_t theirs;
  const JoinMessage join{"some-machine.example:12345", kProtocolVersion, 7, "engine 'ground'", true};
  ColdCall<JoinMessage> call;
  call.out = &join;
  ASSERT_TRUE(ColdType<JoinMessage>().getKey(&call, &ours, false));
  wire::Join wire_join;
  wire_join.process(join.process);
  wire::JoinPubSubType join_type;
  ASSERT_TRUE(join_type.getKey(&wire_join, &theirs, false));
  EXPECT_EQ(ours, theirs);

  const ViewRequestMessage request{"x:1", 7, 30, false, {}};
  ColdCall<ViewRequestMessage> client_request;
  client_request.out = &request;
  ASSERT_TRUE(ColdType<ViewRequestMessage>().getKey(&client_request, &ours, false));
  wire::ViewRequest wire_request;
  wire_request.client("x:1");
  wire::ViewRequestPubSubType request_type;
  ASSERT_TRUE(request_type.getKey(&wire_request, &theirs, false));
  EXPECT_EQ(ours, theirs);
  EXPECT_FALSE(ColdType<LeaveMessage>().m_isGetKeyDefined);
  EXPECT_FALSE(wire::LeavePubSubType().m_isGetKeyDefined);
}

}  // namespace
}  // namespace swarmanoid
