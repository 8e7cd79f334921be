// What users ask and what is shown to them has the bytes of the types that are made from the IDL.
#include <gtest/gtest.h>

#include "tests/unit/bus/random_messages.h"

namespace swarmanoid
{
namespace
{

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

TEST(MessageBytes, OfUsersRequestsAreThoseOfTheIdl)
{
  Random random(3);
  for (int round = 0; round < kRounds; ++round)
  {
    ControlRequestMessage request{{random.Text()}, random.Text(), random.Number32(), random.Text(), random.Number()};
    wire::ControlRequest wire_request;
    wire_request.client(request.client);
    wire_request.number(request.number);
    wire_request.verb(request.verb);
    for (const ControlValue& value :
         {ControlValue(random.Text()), ControlValue(-static_cast<std::int64_t>(random.Number32())),
          ControlValue(random.Real()), ControlValue(random.Reals())})
    {
      request.arguments.push_back({random.Text(), value});
      wire::ControlArgument argument;
      argument.name(request.arguments.back().name);
      if (const auto* name = std::get_if<std::string>(&value)) argument.value().name(*name);
      if (const auto* whole = std::get_if<std::int64_t>(&value)) argument.value().whole(*whole);
      if (const auto* number = std::get_if<double>(&value)) argument.value().number(*number);
      if (const auto* pose = std::get_if<std::vector<double>>(&value)) argument.value().pose(*pose);
      wire_request.arguments().push_back(argument);
    }
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
    view.snapshot.drawing = random.Drawn();
    wire::View wire_view;
    wire_view.run(view.run);
    wire_view.tick(view.snapshot.tick);
    wire_view.source(0);
    wire_view.poses(view.snapshot.poses);
    wire_view.flags(FlagsOf(view.snapshot.last, false));
    wire_view.attributes(view.snapshot.attributes);
    wire_view.real_time_factor(view.snapshot.real_time_factor);
    SetDrawing(view.snapshot.drawing, wire_view);
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

}  // namespace
}  // namespace swarmanoid
