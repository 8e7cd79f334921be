// What becomes of a process that offers its machine to a run that ends before it has answered.
#include "common/bus/offered_machine.h"

#include <atomic>
#include <future>

#include <gmock/gmock.h>

#include "common/activity/exit_codes.h"
#include "common/bus/dds/for_tests.h"
#include "tests/eventually.h"
#include "tests/unit/bus/server_fixture.h"

namespace swarmanoid
{
namespace
{

using test::Eventually;
using testing::HasSubstr;

// A space server that hears offers and does what a test says.
class OfferToARun : public test::ServerFixture
{
protected:
  OfferToARun() : ServerFixture("offered")
  {
    world_.spread = true;
    server_.emplace(options_, "space server");
    leaves_.emplace(*server_, "offered");
    replies_.emplace(*server_, "offered");
    requests_.emplace(*server_, "offered",
                      [this](const ControlRequestMessage& request)
                      {
                        if (request.verb != "offer") return;
                        number_ = request.number;
                        ++heard_;
                      });
    worlds_.emplace(*server_, "offered");
    worlds_->Write(world_);
  }

  // Offers this machine, and lets `end` end the run once the offer was heard twice. The exit code.
  int Offer(const std::function<void()>& end)
  {
    std::future<int> offer = std::async(std::launch::async,
                                        [this]
                                        {
                                          WorkerSettings settings;
                                          settings.experiment = "offered";
                                          settings.offer = "beta";
                                          return OfferMachine(settings, options_);
                                        });
    EXPECT_TRUE(Eventually([&] { return heard_ >= 2; }));
    end();
    const int before = heard_;
    const int code = offer.get();
    // It is said four times a second: not for as long as the run would be waited for.
    EXPECT_LT(heard_ - before, 40);
    return code;
  }
  void Leave(const std::string& error) { leaves_->Write({world_.run, 7, "space server", "", error}); }

  const test::SeparateProcesses separate_;
  std::optional<Bus> server_;
  std::optional<Publisher<LeaveMessage>> leaves_;
  std::optional<Publisher<ControlReplyMessage>> replies_;
  std::optional<Publisher<WorldMessage>> worlds_;
  std::atomic<std::uint32_t> number_ = 0;
  std::atomic<int> heard_ = 0;
  std::optional<Subscription<ControlRequestMessage>> requests_;
};

TEST_F(OfferToARun, ThatEndsMeanwhileIsDone)
{
  testing::internal::CaptureStderr();
  const int code = Offer([this] { Leave(""); });
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("machine 'beta': the run has ended\n"));
  EXPECT_EQ(code, kExitDone);
}

TEST_F(OfferToARun, ThatAnswersWithItsEndIsDone)
{
  testing::internal::CaptureStderr();
  const int code = Offer(
      [this]
      {
        replies_->Write({ProcessId(), number_, false, 7, RunEndedText(7)});
        replies_->WaitUntilRead(test::kGenerous.count());
        Leave("");
      });
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("machine 'beta': the run has ended\n"));
  EXPECT_EQ(code, kExitDone);
}

TEST_F(OfferToARun, ThatFailsMeanwhileSaysWhy)
{
  try
  {
    Offer([this] { Leave("engine 'ground' failed at tick 7: out of paper"); });
    FAIL();
  }
  catch (const BusError& error)
  {
    EXPECT_STREQ(error.what(), "engine 'ground' failed at tick 7: out of paper");
  }
}

TEST_F(OfferToARun, WhoseServerDiesMeanwhileSaysSo)
{
  try
  {
    Offer(
        [this]
        {
          requests_.reset();
          worlds_.reset();
          replies_.reset();
          leaves_.reset();
          server_.reset();
        });
    FAIL();
  }
  catch (const BusError& error)
  {
    EXPECT_THAT(error.what(), HasSubstr("the space server has gone"));
  }
}

}  // namespace
}  // namespace swarmanoid
