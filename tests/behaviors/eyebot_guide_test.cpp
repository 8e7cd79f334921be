// Tests every transition of the behaviour diagram of the eyebot in the sample experiment.
#include "user/controllers/prey_retrieval/eyebot_guide.h"

#include <gtest/gtest.h>

#include "common/control_interface/ci_colour.h"
#include "tests/behaviors/diagram.h"

namespace swarmanoid::test
{
namespace
{

class EyebotDiagram : public Diagram<CCI_EyeBotState, CBTEyebotGuide>
{
protected:
  EyebotDiagram() : Diagram("eyebot")
  {
    robot_.AddSensor("eyebot_camera", &camera_);
    robot_.AddActuator("eyebot_propellers", &propellers_);
    robot_.AddActuator("eyebot_laser", &laser_);
    state_.Init();
  }
  bool Flies() const { return propellers_.velocity[0] != 0 || propellers_.velocity[1] != 0; }

  using Guide = CBTEyebotGuide;
  FakePropellers propellers_;
  FakeLaser laser_;
  const CCI_ColourBlob near_signal_ = Blob(CCI_Colour::BLUE, 0.2);
};

// Both preys in view: whichever was chosen is there.
std::vector<CCI_ColourBlob> BothPreys(double distance)
{
  return {Blob(CCI_Colour::YELLOW, distance), Blob(CCI_Colour::MAGENTA, distance)};
}

TEST_F(EyebotDiagram, FromTheSearchToTheNest)
{
  EXPECT_EQ(See({Blob(CCI_Colour::GREEN, 0.5)}), Guide::SEARCH_FOR_PREY);
  EXPECT_FALSE(laser_.on);
  EXPECT_TRUE(Flies());
  EXPECT_EQ(See(BothPreys(1)), Guide::GO_TO_PREY);
  EXPECT_TRUE(laser_.on);
  EXPECT_EQ(laser_.colour, CCI_Colour::RED);
  EXPECT_TRUE(Flies());
  EXPECT_EQ(See(BothPreys(0.05)), Guide::WAIT_FOR_FOOTBOT_GRIPPING);
  EXPECT_EQ(See(BothPreys(0.05), 100), Guide::WAIT_FOR_FOOTBOT_GRIPPING);
  EXPECT_FALSE(Flies());
  auto gripped = BothPreys(0.05);
  gripped.push_back(near_signal_);
  EXPECT_EQ(See(gripped), Guide::SEARCH_FOR_NEST);
  EXPECT_TRUE(laser_.on);
  EXPECT_TRUE(Flies());
}

TEST_F(EyebotDiagram, WaitsForAFootbotOutOfSight)
{
  See(BothPreys(1));
  See(BothPreys(0.05));
  auto gripped = BothPreys(0.05);
  gripped.push_back(near_signal_);
  See(gripped);
  EXPECT_EQ(See({}), Guide::SEARCH_FOR_NEST);
  EXPECT_FALSE(Flies());
  // For good it is not: after a minute the prey is looked for again.
  EXPECT_EQ(See({}, 500), Guide::SEARCH_FOR_NEST);
  EXPECT_EQ(See({}, 110), Guide::SEARCH_FOR_PREY);
  EXPECT_FALSE(laser_.on);
}

TEST_F(EyebotDiagram, HoldsAboveTheNestWithAFootbotNear)
{
  See(BothPreys(1));
  See(BothPreys(0.05));
  auto gripped = BothPreys(0.05);
  gripped.push_back(near_signal_);
  See(gripped);
  EXPECT_EQ(See({near_signal_, Blob(CCI_Colour::GREEN, 1)}), Guide::SEARCH_FOR_NEST);
  EXPECT_GT(propellers_.velocity[0], 0);  // straight ahead, towards the green
  See({near_signal_, Blob(CCI_Colour::GREEN, 0.01)});
  EXPECT_FALSE(Flies());
}

TEST_F(EyebotDiagram, APreyThatIsLostIsSearchedAgain)
{
  See(BothPreys(1));
  EXPECT_EQ(See({}), Guide::SEARCH_FOR_PREY);
  See(BothPreys(1));
  EXPECT_EQ(See(BothPreys(0.05)), Guide::WAIT_FOR_FOOTBOT_GRIPPING);
  EXPECT_EQ(See({}), Guide::SEARCH_FOR_PREY);
}

// Another footbot that signals nearer by holds the other prey: it is not led instead.
TEST_F(EyebotDiagram, TheFootbotWithItsPreyIsLed)
{
  const bool yellow = See({Blob(CCI_Colour::YELLOW, 0.01)}) != Guide::SEARCH_FOR_PREY;
  const std::uint32_t own = yellow ? CCI_Colour::YELLOW : CCI_Colour::MAGENTA;
  const std::uint32_t other = yellow ? CCI_Colour::MAGENTA : CCI_Colour::YELLOW;
  const std::vector<CCI_ColourBlob> another{Blob(other, 0.3), Blob(CCI_Colour::BLUE, 0.1)};
  const auto with_own = [&](double prey, double signal)
  {
    std::vector<CCI_ColourBlob> blobs = another;
    blobs.push_back(Blob(own, prey));
    if (signal > 0) blobs.push_back(Blob(CCI_Colour::BLUE, signal));
    return blobs;
  };
  EXPECT_EQ(See(with_own(0.6, 0), 3), Guide::GO_TO_PREY);
  EXPECT_EQ(See(with_own(0.05, 0.25)), Guide::WAIT_FOR_FOOTBOT_GRIPPING);
  EXPECT_EQ(See(with_own(0.05, 0.25)), Guide::SEARCH_FOR_NEST);
  See(with_own(0.2, 0.4));
  EXPECT_TRUE(Flies()) << "its footbot is near";
  See(with_own(1, 0.8));
  EXPECT_FALSE(Flies()) << "it waits for its footbot";
  See(another);
  EXPECT_TRUE(Flies()) << "without its prey in view the signal counts";
}

// It flies about for 200 s; then back along the way that it has flown since it saw the nest.
TEST_F(EyebotDiagram, ANestThatIsNotFoundIsGoneBackTo)
{
  // The target is 2 m ahead and 1 m to the left.
  CCI_ColourBlob nest = Blob(CCI_Colour::GREEN, std::sqrt(5.0));
  nest.angle_rad = std::atan2(1.0, 2.0);
  See({nest});
  double x = 2, y = 1, yaw = 0;  // relative to the nest from its earlier position, and to the eyebot
  const auto fly = [&](const std::vector<CCI_ColourBlob>& blobs)
  {
    const std::array<double, 4> velocity = propellers_.velocity;
    x -= 0.1 * (velocity[0] * std::cos(yaw) - velocity[1] * std::sin(yaw));
    y -= 0.1 * (velocity[0] * std::sin(yaw) + velocity[1] * std::cos(yaw));
    yaw += 0.1 * velocity[3];
    See(blobs);
  };
  const std::vector<CCI_ColourBlob> leading{Blob(CCI_Colour::BLUE, 0.1)};
  while (behavior_.GetStateID() != Guide::SEARCH_FOR_NEST)
    fly({Blob(CCI_Colour::YELLOW, 0.01), Blob(CCI_Colour::MAGENTA, 0.01), Blob(CCI_Colour::BLUE, 0.1)});
  for (int tick = 0; tick < 2002; ++tick) fly(leading);
  const double before = std::hypot(x, y);
  ASSERT_GT(before, 1) << "or the way back proves nothing";
  const int straight = static_cast<int>((before - 0.35) / 0.012);
  for (int tick = 0; tick < straight; ++tick) fly(leading);
  EXPECT_LT(std::hypot(x, y), 0.45);
  // It was there, and saw nothing: it flies about again.
  for (int tick = 0; tick < 600; ++tick) fly(leading);
  EXPECT_GT(std::hypot(x, y), 0.5);
}

}  // namespace
}  // namespace swarmanoid::test
