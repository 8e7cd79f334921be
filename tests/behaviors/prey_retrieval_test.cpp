// The sample experiment is the one that the documentation tells: what is seen from outside, over several seeds, and
// every transition of the two behaviour diagrams.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "common/control_interface/ci_colour.h"
#include "launcher/simulator.h"
#include "test_folders.h"
#include "user/controllers/prey_retrieval/eyebot_guide.h"
#include "user/controllers/prey_retrieval/footbot_retriever.h"

namespace swarmanoid::test
{
namespace
{

const std::array<std::string, 3> kFootbots{"fb_1", "fb_2", "fb_3"};

// What happened in one run.
struct Story
{
  bool done = false;
  std::string prey;    // that stands in the nest
  std::string marked;  // the one nearest to the eyebot when a footbot first gripped
  bool laser_at_start = true;
  std::uint64_t laser_on = 0;  // tick
  std::uint64_t gripped = 0;   // tick
  std::string mistakes;
};

double GroundDistance(const CSwarmanoidSpaceEntity& a, const CSwarmanoidSpaceEntity& b)
{
  return (a.GetPosition() - b.GetPosition()).head<2>().norm();
}

// LEDs and laser say what the text says that they say.
void LookAtSignals(const CSwarmanoidSpace& space, std::array<int, 3>& dark_for, Story& story)
{
  const auto mistake = [&](const std::string& what)
  { story.mistakes += "tick " + std::to_string(space.GetTick()) + ": " + what + "\n"; };
  for (std::size_t i = 0; i < kFootbots.size(); ++i)
  {
    const CSwarmanoidSpaceEntity& robot = *space.FindEntity(kFootbots[i]);
    const bool grips = robot.GetAttribute("gripped") > 0;
    const auto leds = static_cast<std::uint32_t>(robot.GetAttribute("led"));
    if (leds != CCI_Colour::BLUE && leds != CCI_Colour::BLACK) mistake("LEDs of a colour that means nothing");
    // The sensor tells of a grip a tick later, and of its loss likewise.
    dark_for[i] = grips == (leds == CCI_Colour::BLUE) ? 0 : dark_for[i] + 1;
    if (dark_for[i] > 3) mistake(kFootbots[i] + (grips ? " grips without a signal" : " signals and grips nothing"));
  }
  const CSwarmanoidSpaceEntity& eyebot = *space.FindEntity("eb");
  if (eyebot.GetAttribute("laser") > 0 && eyebot.GetAttribute("laser_colour") != CCI_Colour::RED)
    mistake("the laser is not red");
}

Story Watch(int seed)
{
  const auto experiment = ReadExperiment(SWARMANOID_SOURCE_FOLDER "/configs/prey_retrieval.xml",
                                         {{"framework.seed", std::to_string(seed)}});
  SimulatorOptions options;
  options.visualisations = false;
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("swarmanoid_retrieval_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  options.output_folder = folder.string();
  CSimulator simulator(*experiment, options);
  const CSwarmanoidSpace& space = simulator.GetSpace();
  Story story;
  std::array<int, 3> dark_for{};
  while (simulator.Step())
  {
    LookAtSignals(space, dark_for, story);
    const CSwarmanoidSpaceEntity& eyebot = *space.FindEntity("eb");
    const bool laser = eyebot.GetAttribute("laser") > 0;
    if (space.GetTick() == 1) story.laser_at_start = laser;
    if (laser && story.laser_on == 0) story.laser_on = space.GetTick();
    bool gripped = false;
    for (const std::string& id : kFootbots) gripped |= space.FindEntity(id)->GetAttribute("gripped") > 0;
    if (!gripped || story.gripped != 0) continue;
    story.gripped = space.GetTick();
    const bool yellow = GroundDistance(*space.FindEntity("prey_yellow"), eyebot) <
                        GroundDistance(*space.FindEntity("prey_magenta"), eyebot);
    story.marked = yellow ? "prey_yellow" : "prey_magenta";
  }
  for (const char* prey : {"prey_yellow", "prey_magenta"})
    if (GroundDistance(*space.FindEntity(prey), *space.FindEntity("nest")) < 0.75) story.prey = prey;
  story.done = !simulator.Finish().failed;
  std::filesystem::remove_all(folder);
  return story;
}

TEST(PreyRetrieval, IsTheStoryThatIsTold)
{
  std::set<std::string> chosen;
  for (int seed = 1; seed <= 12; ++seed)
  {
    const Story story = Watch(seed);
    EXPECT_TRUE(story.done) << "seed " << seed;
    EXPECT_EQ(story.mistakes, "") << "seed " << seed;
    // The eyebot searches with the laser off, marks its prey, and a footbot grips what is marked: that comes to the
    // nest.
    EXPECT_FALSE(story.laser_at_start) << "seed " << seed;
    EXPECT_GT(story.laser_on, 1U) << "seed " << seed;
    EXPECT_GT(story.gripped, story.laser_on) << "seed " << seed;
    EXPECT_EQ(story.prey, story.marked) << "seed " << seed;
    chosen.insert(story.prey);
  }
  EXPECT_EQ(chosen, (std::set<std::string>{"prey_yellow", "prey_magenta"}));
  EXPECT_EQ(Watch(1).prey, Watch(1).prey);
}

// ---- the behaviour diagrams: robots whose sensors the test sets

class FakeCamera : public CCI_ColourBlobSensor
{
public:
  std::span<const CCI_ColourBlob> GetAllBlobs() const override { return blobs; }
  std::vector<CCI_ColourBlob> blobs;
};

class FakeGripperSensor : public CCI_FootBotGripperSensor
{
public:
  bool IsGripping() const override { return gripping; }
  double GetAperture() const override { return 0; }
  bool gripping = false;
};

class FakeProximity : public CCI_FootBotProximitySensor
{
public:
  std::span<const double, NUM_SENSORS> GetAllSensorReadings() const override { return readings; }
  std::array<double, NUM_SENSORS> readings{};
};

class FakeWheels : public CCI_FootBotWheelsActuator
{
public:
  void SetFootBotWheelsAngularVelocity(double l, double r) override
  {
    left = l;
    right = r;
  }
  double left = 0;
  double right = 0;
};

class FakeGripper : public CCI_FootBotGripperActuator
{
public:
  void SetGripper(double value) override { closed = value; }
  double closed = 0;
};

class FakeLeds : public CCI_FootBotLedsActuator
{
public:
  void SetColour(unsigned, std::uint32_t value) override { colour = value; }
  void SetAllColours(std::uint32_t value) override { colour = value; }
  std::uint32_t colour = 0;
};

class FakePropellers : public CCI_EyeBotPropellersActuator
{
public:
  void SetVelocity(double x, double y, double z, double yaw) override { velocity = {x, y, z, yaw}; }
  void SetPosition(const swarmanoid::Vector3&, double) override {}
  std::array<double, 4> velocity{};
};

class FakeLaser : public CCI_EyeBotLaserActuator
{
public:
  void SwitchOn() override { on = true; }
  void SwitchOff() override { on = false; }
  void SetColour(std::uint32_t value) override { colour = value; }
  void SetDirection(double, double) override {}
  bool on = false;
  std::uint32_t colour = 0;
};

CCI_ColourBlob Blob(std::uint32_t colour, double distance)
{
  CCI_ColourBlob blob;
  blob.colour = colour;
  blob.distance_m = distance;
  return blob;
}

class FootbotDiagram : public testing::Test
{
protected:
  FootbotDiagram()
  {
    robot_.AddSensor("footbot_omnidirectional_camera", &camera_);
    robot_.AddSensor("footbot_gripper", &gripper_sensor_);
    robot_.AddSensor("footbot_proximity", &proximity_);
    robot_.AddActuator("footbot_wheels", &wheels_);
    robot_.AddActuator("footbot_gripper", &gripper_);
    robot_.AddActuator("footbot_leds", &leds_);
    state_.Init();
  }
  // The state after so many ticks with this in view.
  unsigned See(const std::vector<CCI_ColourBlob>& blobs, int ticks = 1)
  {
    camera_.blobs = blobs;
    for (int i = 0; i < ticks; ++i)
    {
      robot_.BeginStep(tick_, 0.1, RandomStream(1, 1, 0, static_cast<std::uint32_t>(tick_)));
      ++tick_;
      state_.ReadSensors();
      behavior_.Step(state_);
      state_.WriteActuators();
    }
    return behavior_.GetStateID();
  }

  using Retriever = CBTFootbotRetriever;
  CCI_Robot robot_{"fb", "footbot"};
  FakeCamera camera_;
  FakeGripperSensor gripper_sensor_;
  FakeProximity proximity_;
  FakeWheels wheels_;
  FakeGripper gripper_;
  FakeLeds leds_;
  CCI_FootBotState state_{&robot_};
  Retriever behavior_;
  std::uint64_t tick_ = 0;

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
  EXPECT_EQ(See({far_laser_, prey_}, 30), Retriever::AVOID_GRIPPING_FOOTBOT);  // neither laser nor prey counts
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
  // A spot ahead, and one that is reached, at whatever angle, hold nobody back.
  CCI_ColourBlob below = aside;
  below.distance_m = 0.01;
  for (const CCI_ColourBlob& spot : {near_laser_, below})
    for (int tick = 0; tick < 100; ++tick)
    {
      See({spot});
      ASSERT_FALSE(drives_back()) << tick;
    }
}

class EyebotDiagram : public testing::Test
{
protected:
  EyebotDiagram()
  {
    robot_.AddSensor("eyebot_camera", &camera_);
    robot_.AddActuator("eyebot_propellers", &propellers_);
    robot_.AddActuator("eyebot_laser", &laser_);
    state_.Init();
  }
  unsigned See(const std::vector<CCI_ColourBlob>& blobs, int ticks = 1)
  {
    camera_.blobs = blobs;
    for (int i = 0; i < ticks; ++i)
    {
      robot_.BeginStep(tick_, 0.1, RandomStream(1, 1, 0, static_cast<std::uint32_t>(tick_)));
      ++tick_;
      state_.ReadSensors();
      behavior_.Step(state_);
      state_.WriteActuators();
    }
    return behavior_.GetStateID();
  }
  bool Flies() const { return propellers_.velocity[0] != 0 || propellers_.velocity[1] != 0; }

  using Guide = CBTEyebotGuide;
  CCI_Robot robot_{"eb", "eyebot"};
  FakeCamera camera_;
  FakePropellers propellers_;
  FakeLaser laser_;
  CCI_EyeBotState state_{&robot_};
  Guide behavior_;
  std::uint64_t tick_ = 0;

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
  // 2 m ahead and 1 m to the left.
  CCI_ColourBlob nest = Blob(CCI_Colour::GREEN, std::sqrt(5.0));
  nest.angle_rad = std::atan2(1.0, 2.0);
  See({nest});
  double x = 2, y = 1, yaw = 0;  // of the nest from where it was, and of the eyebot
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
