// Bad messages on the wire: those of strangers are dropped and counted, and one of a member ends the run with the
// member's name.
#include <functional>
#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/eventually.h"
#include "tests/unit/bus/server_fixture.h"
#include "tests/unit/bus/stranger.h"

namespace swarmanoid
{
namespace
{

using test::Eventually;
using testing::HasSubstr;

class Strangers : public test::ServerFixture
{
protected:
  Strangers() : ServerFixture("strangers") {}
};

// A reader of updates as that of the space server, which refuses each update as if its array were too short.
struct BadUpdates
{
  explicit BadUpdates(ServerSession& session)
      : scope(session.Scope(1000, 1)),
        updates(
            session.GetBus(), scope,
            {[this](const MessageHeader&) { return &place; },
             [](const MessageHeader&, EngineUpdate&) { FAIL() << "a bad message was received"; },
             [](const MessageHeader&, const EngineUpdate&) { throw BadMessage("poses: it has 3 numbers, not 70"); }})
  {
  }
  // Returns whether the condition was met while `sender` wrote them.
  bool ComeUntil(const std::function<bool()>& met, Bus& sender, std::uint64_t run)
  {
    HotPublisher<EngineUpdate> publisher(sender, scope);
    if (!Eventually([&] { return publisher.Readers() == 1 && updates.Writers() == 1; })) return false;
    const EngineUpdate update;
    return Eventually(
        [&]
        {
          publisher.Write({run, 17, 0, false}, update);
          return met();
        });
  }

  HotScope scope;
  EngineUpdate place;
  const HotSubscription<EngineUpdate> updates;
};

TEST_F(Strangers, AreDroppedAndCountedWhateverTheySend)
{
  ServerSession session(options_, world_, {"engine 'ground'"}, {[](const auto&) {}, [] {}, [](const auto&) {}});
  session.Open();
  test::Stranger stranger(options_.domain, "strangers");
  std::mt19937 random(1);
  std::uint64_t sent = 0;
  for (const char* topic : {"Join", "Status", "Leave", "ControlRequest"})
  {
    std::vector<std::string> payloads{"", std::string("\0\1\0", 3), std::string("\0\1\0\0", 4)};
    for (int k = 0; k < 20; ++k)
    {
      std::string payload(4 + random() % 60, '\0');
      for (char& byte : payload) byte = static_cast<char>(random());
      payload[0] = '\0';
      payload[1] = '\1';
      payloads.push_back(payload);
      const std::uint32_t length = 0xfffffff0U;
      if (payload.size() > 24) std::memcpy(payloads.back().data() + 20, &length, 4);
    }
    ASSERT_TRUE(stranger.Send(topic, payloads)) << topic;
    sent += payloads.size();
  }
  // Only the newest of one instance is kept by a reader that is slow.
  EXPECT_TRUE(Eventually([&] { return session.GetBus().Dropped() >= sent / 4; })) << session.GetBus().Dropped();
  EXPECT_FALSE(session.Failure().has_value()) << *session.Failure();
}

TEST_F(Strangers, AMemberOfTheRunEndsItByName)
{
  ServerSession session(options_, world_, {"engine 'ground'"}, {[](const auto&) {}, [] {}, [](const auto&) {}});
  session.Open();
  Bus engine(options_, "engine 'ground'");
  Publisher<JoinMessage> join(engine, "strangers");
  join.Write({ProcessId(), kProtocolVersion, world_.run, "engine 'ground'", true});
  ASSERT_TRUE(Eventually([&] { return session.Missing().empty(); }));

  BadUpdates updates(session);
  EXPECT_TRUE(updates.ComeUntil([&] { return session.Failure().has_value(); }, engine, world_.run));
  EXPECT_EQ(session.Failure(), "engine 'ground' sent a bad EngineUpdate at tick 17: poses: it has 3 numbers, not 70");
  EXPECT_EQ(session.GetBus().Dropped(), 0U);
}

// Observers have the key, too.
TEST_F(Strangers, WhoHoldsTheKeyAndIsNoMemberIsDropped)
{
  ServerSession session(options_, world_, {"engine 'ground'"}, {[](const auto&) {}, [] {}, [](const auto&) {}});
  session.Open();
  Bus watcher(options_, "visualiser 'web'");
  BadUpdates updates(session);
  EXPECT_TRUE(updates.ComeUntil([&] { return session.GetBus().Dropped() > 0; }, watcher, world_.run));
  EXPECT_FALSE(session.Failure().has_value()) << *session.Failure();
}

}  // namespace
}  // namespace swarmanoid
