// When observers at a run get a view of it.
#include "space_server/cluster/view_publisher.h"

#include <atomic>

#include "tests/eventually.h"
#include "tests/unit/bus/server_fixture.h"

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;
using test::Eventually;

class ViewPublisherTest : public test::ServerFixture
{
protected:
  ViewPublisherTest()
      : ServerFixture("viewed"),
        session_(options_, world_, {}, {[](const auto&) {}, [] {}, [](const auto&) {}}),
        grants_(session_, options_, {[](const auto&) {}, [](const auto&) {}, [] {}}),
        views_(session_, grants_, [this] { ++woken_; })
  {
  }

  // Returns true if a view is due at the time now_, and sends it.
  bool Sends(std::uint64_t tick = 0)
  {
    if (!views_.ViewIsDue(tick, now_)) return false;
    SpaceSnapshot snapshot;
    snapshot.tick = tick;
    views_.SendView(snapshot, now_);
    return true;
  }
  // Views that are sent while so much time passes, in which nothing happens.
  int SentWithin(std::chrono::milliseconds time)
  {
    int sent = 0;
    for (const auto until = now_ + time; now_ < until; now_ += 10ms) sent += Sends() ? 1 : 0;
    return sent;
  }

  ServerSession session_;
  AccessGrants grants_;
  std::atomic<int> woken_ = 0;
  ViewPublisher views_;
  ViewPublisher::Clock::time_point now_ = ViewPublisher::Clock::now();
};

TEST_F(ViewPublisherTest, WhatDoesNotChangeIsSentToNewcomersOnly)
{
  EXPECT_EQ(SentWithin(1s), 0);
  Bus looker(options_, "visualiser 'v'");
  std::atomic<int> heard = 0;
  const Subscription<ViewMessage> views(looker, "viewed", [&](const ViewMessage&) { ++heard; });
  ASSERT_TRUE(Eventually([&] { return Sends(); }));
  // A view may be lost on its way to a reader that was just matched, so more are sent for some time.
  EXPECT_TRUE(Eventually(
      [&]
      {
        now_ += 1ms;
        Sends();
        return heard > 0;
      }));
  EXPECT_GT(SentWithin(10s), 100);
  EXPECT_EQ(SentWithin(60s), 0);
  // The server sleeps meanwhile: a run that is paused before observers takes no time of the processor.
  EXPECT_GT(views_.Next(now_), now_);

  const Subscription<ViewMessage> another(looker, "viewed", [](const ViewMessage&) {});
  EXPECT_TRUE(Eventually([&] { return Sends(); }));
}

TEST_F(ViewPublisherTest, WhatChangesIsSentAtThePaceThatIsAskedFor)
{
  Bus looker(options_, "visualiser 'v'");
  const Subscription<ViewMessage> views(looker, "viewed", [](const ViewMessage&) {});
  ASSERT_TRUE(Eventually([&] { return Sends(); }));
  SentWithin(60s);
  // A user was answered, and waits for a view that is newer than the answer.
  views_.Renew();
  EXPECT_GT(SentWithin(10s), 100);
  EXPECT_EQ(SentWithin(60s), 0);
  // A tick passed.
  EXPECT_TRUE(Sends(1));
  EXPECT_FALSE(Sends(1));
  // Sooner than after a thirtieth of a second there is no other one.
  now_ += 20ms;
  EXPECT_FALSE(Sends(2));
  now_ += 1s;
  EXPECT_TRUE(Sends(2));
}

// So do they if the pace is slow.
TEST_F(ViewPublisherTest, WhoeverAskedGetsSeveralViewsHoweverSeldom)
{
  Bus looker(options_, "visualiser 'v'");
  const Subscription<ViewMessage> views(looker, "viewed", [](const ViewMessage&) {});
  views_.Requested({"host:2", world_.run, 0.01, false, {}});
  ASSERT_TRUE(Eventually([&] { return Sends(); }));
  now_ += 1h;
  int sent = 0;
  views_.Renew();
  for (int k = 0; k < 10; ++k, now_ += 1h) sent += Sends() ? 1 : 0;
  EXPECT_GE(sent, 3);
  EXPECT_LT(sent, 10);
}

TEST_F(ViewPublisherTest, OneViewASecondIsNotMore)
{
  Bus looker(options_, "visualiser 'v'");
  const Subscription<ViewMessage> views(looker, "viewed", [](const ViewMessage&) {});
  views_.Requested({"host:2", world_.run, 1, false, {}});
  ASSERT_TRUE(Eventually([&] { return Sends(); }));
  int sent = 0;
  for (std::uint64_t tick = 1; tick <= 250; ++tick, now_ += 10ms) sent += Sends(tick) ? 1 : 0;
  EXPECT_GE(sent, 2);
  EXPECT_LE(sent, 4);
}

// One came as another one went: there are as many readers as before.
TEST_F(ViewPublisherTest, WhoeverAsksForTheFirstTimeIsANewcomer)
{
  Bus looker(options_, "visualiser 'v'");
  const Subscription<ViewMessage> views(looker, "viewed", [](const ViewMessage&) {});
  ASSERT_TRUE(Eventually([&] { return Sends(); }));
  SentWithin(60s);
  const ViewRequestMessage request{"host:2", world_.run, 30, false, {}};
  views_.Requested(request);
  EXPECT_EQ(woken_, 1);
  EXPECT_TRUE(Sends());
  SentWithin(60s);
  views_.Requested(request);
  EXPECT_EQ(SentWithin(60s), 0);
}

}  // namespace
}  // namespace swarmanoid
