// The sample experiment does what its documentation describes, over several seeds, measured from outside.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "common/control_interface/ci_colour.h"
#include "simulation/simulator.h"
#include "test_folders.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid::test
{
namespace
{

const std::array<std::string, 3> kFootbots{"fb_1", "fb_2", "fb_3"};

// The events of one run.
struct Story
{
  bool done = false;
  std::string prey;    // the prey in the nest
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

// LEDs and laser show the states that the documentation describes.
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
    // The sensor reports a grip and its loss one tick later.
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
  const test::TemporaryFolder folder;
  options.output_folder = folder.Path();
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

}  // namespace
}  // namespace swarmanoid::test
