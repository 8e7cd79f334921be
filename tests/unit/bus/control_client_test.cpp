// ControlClient: what is beyond the limits of a message is refused where it is asked, and never ends the asker.
#include "common/bus/membership/control_client.h"

#include <gmock/gmock.h>

#include <limits>

#include "common/messages/request_limits.h"
#include "tests/unit/bus/server_fixture.h"

namespace swarmanoid
{
namespace
{

using testing::HasSubstr;

struct Refused
{
  std::string verb;
  std::string entity;
  std::vector<double> numbers;
  std::string why;
};

const std::vector<Refused>& RefusedRequests()
{
  static const std::vector<Refused> requests{
      {"press", std::string(1, '\0'), {}, "press: the key '?' must be one line of UTF-8 text"},
      {"select", std::string(3000, 'x'), {}, "' has 3000 bytes; it must have at most 1024"},
      {"select", "a\nb", {}, "select: the name 'a?b' must be one line"},
      {"move", "\xff", {1, 2, 3}, "move: the name '?'"},
      {"move", "fb_0", std::vector<double>(7, 0.0), "move: there are 7 numbers; at most 6 can be given"},
      {"speed", "", {std::numeric_limits<double>::quiet_NaN()}, "speed: a number is not finite"},
      {std::string(1025, 'v'), "", {}, "has 1025 bytes"}};
  return requests;
}

class ControlClientTest : public test::ServerFixture
{
protected:
  ControlClientTest() : ServerFixture("control_client") {}
};

TEST_F(ControlClientTest, RequestsBeyondTheLimitsOfAMessageAreRefusedByAReply)
{
  Bus bus(options_, "client");
  ControlClient client(bus, "control_client", 1);
  for (const Refused& request : RefusedRequests())
  {
    EXPECT_THAT(client.Send(request.verb, request.entity, request.numbers), HasSubstr(request.why));
    const auto reply = client.Ask(request.verb, request.entity, request.numbers, 0);
    ASSERT_TRUE(reply);
    EXPECT_FALSE(reply->ok);
    EXPECT_THAT(reply->text, HasSubstr(request.why));
  }
  EXPECT_EQ(client.Send("press", "Up", {}), "");
}

TEST(RequestLimits, NamesOfTheLargestSizeAndOtherAlphabetsAreWithinThem)
{
  ControlRequestMessage request;
  request.verb = "select";
  for (const std::string& name : {std::string(1024, 'x'), std::string("über 𝄞"), std::string()})
  {
    request.entity = name;
    EXPECT_EQ(RequestLimitError(request), "");
  }
}

}  // namespace
}  // namespace swarmanoid
