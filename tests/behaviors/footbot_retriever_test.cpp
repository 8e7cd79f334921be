// Every transition of the behaviour diagram of footbots in the sample experiment.
#include "user/controllers/prey_retrieval/footbot_retriever.h"

#include <gtest/gtest.h>

#include "common/control_interface/ci_colour.h"
#include "tests/behaviors/diagram.h"

namespace swarmanoid::test
{
namespace
{

class FootbotDiagram : public Diagram<CCI_FootBotState, CBTFootbotRetriever>
{
protected:
  FootbotDiagram() : Diagram("footbot")
  {
    robot_.AddSensor("footbot_omnidirectional_camera", &camera_);
    robot_.AddSensor("footbot_gripper", &gripper_sensor_);
    robot_.AddSensor("footbot_proximity", &proximity_);
    robot_.AddActuator("footbot_wheels", &wheels_);
    robot_.AddActuator("footbot_gripper", &gripper_);
    robot_.AddActuator("footbot_leds", &leds_);
    state_.Init();
  }

  using Retriever = CBTFootbotRetriever;
  FakeGripperSensor gripper_sensor_;
  FakeProximity proximity_;
  FakeWheels wheels_;
  FakeGripper gripper_;
  FakeLeds leds_;
  const CCI_ColourBlob far_laser_ = Blob(CCI_Colour::RED, 1);
  const CCI_ColourBlob near_laser_ = Blob(CCI_Colour::RED, 0.3);
  const CCI_ColourBlob prey_ = Blob(CCI_Colour::YELLOW, 0.3);
  const CCI_ColourBlob signal_ = Blob(CCI_Colour::BLUE, 0.5);
};

TEST_F(FootbotDiagram, FromTheSearchToTheNest)
{
  EXPECT_EQ(See({}), Retriever::SEARCH_FOR_LASER);
  EXPECT_EQ(See({prey_}), Retriever::SEARCH_FOR_LASER);  // alone it cannot know whether that is the one
  EXPECT_EQ(See({far_laser_}), Retriever::GO_TO_LASER);
  EXPECT_EQ(See({far_laser_, prey_}), Retriever::GO_TO_LASER);
  EXPECT_EQ(leds_.colour, CCI_Colour::BLACK);
  EXPECT_EQ(See({near_laser_, prey_}), Retriever::GRIP_PREY);
  EXPECT_EQ(gripper_.closed, 0);
  See({near_laser_, Blob(CCI_Colour::YELLOW, 0.2)});  // straight ahead and in reach
  EXPECT_EQ(gripper_.closed, 1);
  gripper_sensor_.gripping = true;
  EXPECT_EQ(See({near_laser_, prey_}), Retriever::GO_TO_NEST);
  EXPECT_EQ(leds_.colour, CCI_Colour::BLUE);
  EXPECT_EQ(gripper_.closed, 1);
  See({far_laser_});  // follows it
  EXPECT_GT(wheels_.left, 0);
  EXPECT_GT(wheels_.right, 0);
  See({});  // waits
  EXPECT_EQ(wheels_.left, 0);
  EXPECT_EQ(wheels_.right, 0);
  EXPECT_EQ(behavior_.GetStateID(), Retriever::GO_TO_NEST);
}

TEST_F(FootbotDiagram, ALaserThatIsLostIsSearchedAgain)
{
  EXPECT_EQ(See({far_laser_}), Retriever::GO_TO_LASER);
  EXPECT_EQ(See({}), Retriever::SEARCH_FOR_LASER);
}

TEST_F(FootbotDiagram, APreyThatIsLostSendsItBackToTheSearch)
{
  See({near_laser_, prey_});
  EXPECT_EQ(See({near_laser_, prey_}), Retriever::GRIP_PREY);
  EXPECT_EQ(See({near_laser_}), Retriever::SEARCH_FOR_LASER);
  See({near_laser_, prey_});
  See({near_laser_, prey_});
  gripper_sensor_.gripping = true;
  EXPECT_EQ(See({near_laser_, prey_}), Retriever::GO_TO_NEST);
  gripper_sensor_.gripping = false;
  EXPECT_EQ(See({near_laser_, prey_}), Retriever::SEARCH_FOR_LASER);
  EXPECT_EQ(leds_.colour, CCI_Colour::BLACK);
}

TEST_F(FootbotDiagram, TheSignalOfAnotherOneIsAvoidedFromEveryStateBeforeTheGrip)
{
  EXPECT_EQ(See({signal_}), Retriever::AVOID_GRIPPING_FOOTBOT);
  // Straight ahead: it turns on the spot, away from the signaller.
  EXPECT_LT(wheels_.left * wheels_.right, 0);
  EXPECT_EQ(See({far_laser_, prey_}, 30), Retriever::AVOID_GRIPPING_FOOTBOT);  // it reacts to neither laser nor prey
  EXPECT_EQ(See({}, 40), Retriever::SEARCH_FOR_LASER);
  See({far_laser_});
  EXPECT_EQ(See({far_laser_, signal_}), Retriever::AVOID_GRIPPING_FOOTBOT);
  EXPECT_EQ(See({}, 70), Retriever::SEARCH_FOR_LASER);
  See({near_laser_, prey_});
  EXPECT_EQ(See({near_laser_, prey_}), Retriever::GRIP_PREY);
  EXPECT_EQ(See({near_laser_, prey_, signal_}), Retriever::AVOID_GRIPPING_FOOTBOT);
}

// A wall that holds the prey lets it not turn to the spot: it drives back, once it has tried for several times what a
// turn takes, and tries again.
TEST_F(FootbotDiagram, APreyThatAWallHoldsIsPulledBack)
{
  See({near_laser_, prey_});
  See({near_laser_, prey_});
  gripper_sensor_.gripping = true;
  ASSERT_EQ(See({near_laser_, prey_}), Retriever::GO_TO_NEST);
  CCI_ColourBlob aside = near_laser_;
  aside.angle_rad = 1.5;
  const auto drives_back = [&] { return wheels_.left < 0 && wheels_.left == wheels_.right; };
  See({aside}, 39);
  EXPECT_FALSE(drives_back());
  See({aside}, 3);
  EXPECT_TRUE(drives_back());
  See({aside}, 20);
  EXPECT_FALSE(drives_back()) << "it tries to turn again";
  // A spot straight ahead, or one that is reached at any angle, stops no robot.
  CCI_ColourBlob below = aside;
  below.distance_m = 0.01;
  for (const CCI_ColourBlob& spot : {near_laser_, below})
    for (int tick = 0; tick < 100; ++tick)
    {
      See({spot});
      ASSERT_FALSE(drives_back()) << tick;
    }
}

}  // namespace
}  // namespace swarmanoid::test
