// ControlClient: an order with an error is refused in the asking process, and never ends it. Who holds a grant waits
// for the run.
#include "common/bus/membership/control_client.h"

#include <gmock/gmock.h>

#include <limits>
#include <thread>

#include "common/bus/dds/for_tests.h"
#include "common/bus/guarded.h"
#include "common/messages/control_verbs.h"
#include "tests/eventually.h"
#include "tests/unit/bus/server_fixture.h"

namespace swarmanoid
{
namespace
{

class ControlClientTest : public test::ServerFixture
{
protected:
  ControlClientTest() : ServerFixture("control_client") {}
};

TEST_F(ControlClientTest, OrdersWithAnErrorAreRefusedByAReply)
{
  Bus bus(options_, "client");
  ControlClient client(bus, "control_client", 1);
  for (const ControlOrder& order :
       std::vector<ControlOrder>{{"dance"},
                                 {std::string(1025, 'v')},
                                 {"speed"},
                                 {"speed", {{"factor", std::numeric_limits<double>::quiet_NaN()}}},
                                 {"select", {{"entity", std::string(3000, 'x')}}},
                                 {"press", {{"key", std::string(1, '\0')}}},
                                 {"move", {{"entity", "\xff"}, {"pose", std::vector<double>{1, 2, 3}}}}})
  {
    const std::string error = OrderError(order);
    EXPECT_NE(error, "");
    EXPECT_EQ(client.Send(order), error);
    const auto reply = client.Ask(order, 0);
    ASSERT_TRUE(reply);
    EXPECT_FALSE(reply->ok);
    EXPECT_EQ(reply->text, error);
  }
  EXPECT_EQ(client.Send({"press", {{"key", "Up"}}}), "");
}

// On a busy machine the status of the run may come late. A request without the run is not for any run.
TEST_F(ControlClientTest, AHolderOfAGrantAsksAgainWhenItHearsWhichRunItIs)
{
  const test::SeparateProcesses separate;
  GrantChannel channel{"1a2b3c4d"};
  channel.key.emplace().fill(9);
  BusOptions of_holder = options_;
  of_holder.key.reset();
  of_holder.grant = channel;
  Bus server(options_, "space server");
  Guarded<std::vector<ControlRequestMessage>> heard;
  const Subscription<ControlRequestMessage> requests(
      server, "control_client", [&](const ControlRequestMessage& request) { heard.Lock()->push_back(request); },
      channel);
  Publisher<ControlReplyMessage> replies(server, "control_client", channel);
  Publisher<RunStatusMessage> statuses(server, "control_client", channel);
  Bus bus(of_holder, "client");
  ControlClient client(bus, "control_client", 0);
  std::optional<ControlReplyMessage> reply;
  std::jthread asking([&] { reply = client.Ask({"pause"}, 20); });
  const auto hears_of = [&](std::uint64_t run)
  {
    return test::Eventually(
        [&]
        {
          const auto all = heard.Lock();
          return !all->empty() && all->back().run == run;
        });
  };
  EXPECT_TRUE(hears_of(0));
  statuses.Write({world_.run, {.phase = RunStatus::Phase::kRunning}});
  EXPECT_TRUE(hears_of(world_.run));
  const ControlRequestMessage request = heard.Lock()->back();
  replies.Write({request.client, request.number, true, 0, "paused"});
  asking.join();
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->text, "paused");
}

}  // namespace
}  // namespace swarmanoid
