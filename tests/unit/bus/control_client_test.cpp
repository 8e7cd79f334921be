// ControlClient: an order with an error is refused in the asking process, and never ends it.
#include "common/bus/membership/control_client.h"

#include <gmock/gmock.h>

#include <limits>

#include "common/messages/control_verbs.h"
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

}  // namespace
}  // namespace swarmanoid
