// How many controller hosts a run gets that is measured: as many as pay.
#include "launcher/processes/host_choice.h"

#include <gtest/gtest.h>

namespace swarmanoid
{
namespace
{

using namespace std::chrono_literals;

// A run that makes so many ticks a second with one host, with two, and so on.
class Measured
{
public:
  Measured(unsigned most, std::vector<double> rates) : choice_(most), rates_(std::move(rates)) {}

  // Until it has decided, or for a minute.
  unsigned Hosts()
  {
    for (int step = 0; step < 600 && !choice_.IsOver(); ++step)
    {
      now_ += 100ms;
      tick_ += rates_[hosts_ - 1] / 10;
      const auto next = choice_.Take(static_cast<std::uint64_t>(tick_), now_);
      if (!next) continue;
      hosts_ = *next;
      most_tried_ = std::max(most_tried_, hosts_);
      // Ticks of which nothing was saved are done again.
      tick_ -= rates_[hosts_ - 1] / 2;
      choice_.Disturbed();
    }
    return hosts_;
  }
  unsigned MostTried() const { return most_tried_; }
  HostChoice& Choice() { return choice_; }
  void Wait(std::chrono::milliseconds time) { now_ += time; }

private:
  HostChoice choice_;
  std::vector<double> rates_;
  HostChoice::Clock::time_point now_{};
  double tick_ = 1000;
  unsigned hosts_ = 1;
  unsigned most_tried_ = 1;
};

TEST(HostChoice, OneMoreAsLongAsItPays)
{
  Measured run(8, {800, 1200, 1500, 1550});
  EXPECT_EQ(run.Hosts(), 3U);
  EXPECT_EQ(run.MostTried(), 4U);
  EXPECT_TRUE(run.Choice().IsOver());
  EXPECT_EQ(run.Choice().Text(), "controller hosts: 3 (1500 ticks a second; 800 with 1, 1200 with 2, 1550 with 4)");
}

TEST(HostChoice, OneIfASecondOneCostsMoreThanItBrings)
{
  Measured run(8, {800, 700});
  EXPECT_EQ(run.Hosts(), 1U);
  EXPECT_EQ(run.Choice().Text(), "controller hosts: 1 (800 ticks a second; 700 with 2)");
}

TEST(HostChoice, NeverMoreThanCoresThatAreFree)
{
  Measured run(2, {800, 1500, 2000});
  EXPECT_EQ(run.Hosts(), 2U);
  EXPECT_EQ(run.MostTried(), 2U);
  HostChoice none(1);
  EXPECT_TRUE(none.IsOver());
  EXPECT_EQ(none.Text(), "controller hosts: 1, since no core is free for another one");
}

TEST(HostChoice, APauseIsNotMeasured)
{
  HostChoice choice(4);
  HostChoice::Clock::time_point now{};
  EXPECT_FALSE(choice.Take(0, now));
  EXPECT_FALSE(choice.Take(500, now += 500ms));
  choice.Disturbed();
  EXPECT_FALSE(choice.Take(500, now += 1h));
  EXPECT_FALSE(choice.Take(1000, now += 500ms));
  EXPECT_FALSE(choice.Take(2000, now += 1s));
  EXPECT_EQ(choice.Take(2500, now += 500ms), 2U);
  // No tick, no measurement.
  choice.Disturbed();
  EXPECT_FALSE(choice.Take(2500, now += 100ms));
  EXPECT_FALSE(choice.Take(2500, now += 1s));
  EXPECT_FALSE(choice.Take(2500, now += 1h));
  EXPECT_FALSE(choice.IsOver());
}

}  // namespace
}  // namespace swarmanoid
