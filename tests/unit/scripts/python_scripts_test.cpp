// Controllers in Python: arrays with a row for each robot, random numbers, parameters, and state that is saved.
#include <gmock/gmock.h>

#include <filesystem>

#include "common/math/elementary.h"
#include "common/math/random.h"
#include "test_folders.h"
#include "tests/unit/scripts/scripted_robots.h"

namespace swarmanoid
{
namespace
{

using testing::ElementsAre;
using testing::HasSubstr;

// A build may have no controllers in Python.
class PythonScripts : public testing::Test
{
protected:
  void SetUp() override
  {
    if (!std::filesystem::exists(SWARMANOID_BUILD_FOLDER "/lib/swarmanoid/libpython.so")) GTEST_SKIP();
  }
  static ScriptText Python(const std::string& script, const std::string& parameters = "")
  {
    return {.script = "stateless = True\n" + script, .parameters = parameters, .file = "walk.py"};
  }
  static ScriptText WithState(const std::string& script) { return {.script = script, .file = "walk.py"}; }
  // The wheel commands of both robots at a tick, by a script's step.
  static std::vector<double> Wheels(const std::string& step, std::uint64_t tick = 0, const std::string& parameters = "")
  {
    Scripted scripted(Python(step, parameters));
    EXPECT_EQ(scripted.Mistakes(), "") << step;
    if (scripted.host == nullptr) return {};
    return scripted.Tick(tick).values;
  }
};

TEST_F(PythonScripts, HaveTheRobotsAsRows)
{
  const std::string wheels = "  wheels = robots.actuators['footbot_wheels']\n";
  EXPECT_THAT(
      Wheels("def step(robots):\n" + wheels +
                 "  wheels[:, 0] = [len(robots), robots.ids.index('b')]\n  wheels[:, 1] = [robots.tick, robots.time]\n",
             7),
      ElementsAre(2, 7, 1, testing::DoubleNear(0.7, 1e-12)));
  EXPECT_THAT(Wheels("def step(robots):\n" + wheels +
                     "  wheels[0] = [n / 10 for n in robots.sensors['footbot_proximity'].shape]\n  wheels[1] = "
                     "robots.tick_seconds, "
                     "len(robots.columns['footbot_proximity']) / 10\n"),
              ElementsAre(0.2, 2.4, 0.1, 2.4));
  // A row that stays as it is leaves the actuator alone.
  Scripted scripted(Python("def step(robots):\n" + wheels + "  if robots.tick == 0:\n    wheels[1] = 3, 4\n"));
  scripted.Tick(0);
  EXPECT_THAT(scripted.Tick(1).values, ElementsAre(0, 0, 3, 4));
  // Sensors are read at each step.
  Scripted near(Python("def step(robots):\n" + wheels +
                       "  wheels[:, 0] = robots.sensors['footbot_proximity'].sum(axis=1) > 0\n  wheels[:, 1] = 0\n"));
  EXPECT_THAT(near.Tick(0).values, ElementsAre(0, 0, 0, 0));
  near.space->SetPose(1, {{1.2, 1, 0}, Quaternion::Identity()});
  EXPECT_THAT(near.Tick(1).values, ElementsAre(1, 0, 1, 0));
}

TEST_F(PythonScripts, DrawTheNumbersOfEachRobotAndItsStep)
{
  Scripted scripted(
      Python("def step(robots):\n  wheels = robots.actuators['footbot_wheels']\n  wheels[:, 0] = "
             "robots.uniform(2, 4)\n  wheels[:, 1] = robots.gaussian(1, 0.5, columns=2)[:, 1]\n"));
  for (const std::uint64_t tick : {0U, 5U})
  {
    const std::vector<double> drawn = scripted.Tick(tick).values;
    std::vector<double> expected;
    for (const char* id : {"a", "b"})
    {
      RandomStream random(7, StreamName(id), kControlStepStream, tick);
      expected.push_back(random.Uniform(2, 4));
      random.Gaussian(1, 0.5);
      expected.push_back(random.Gaussian(1, 0.5));
    }
    EXPECT_EQ(drawn, expected);
  }
}

TEST_F(PythonScripts, HaveTypedParameters)
{
  const std::string script =
      "p = parameters(speed={'default': 5, 'unit': 'rad/s', 'maximum': 20}, name='x', fast=False, count={'default': 3, "
      "'type': 'integer'}, red={'default': 'red', 'type': 'colour'})\n"
      "def step(robots):\n  robots.actuators['footbot_wheels'][0] = p.speed, p.count\n  "
      "robots.actuators['footbot_wheels'][1] = p.fast is True, ((p.name == 'y') + (p.red == 0xff0000) * 2 + "
      "isinstance(p.count, int) * 4 + isinstance(p.speed, float) * 8) / 2\n";
  EXPECT_THAT(Wheels(script), ElementsAre(5, 3, 0, 7));
  EXPECT_THAT(Wheels(script, 0, "<speed>6.5</speed><name>y</name><fast>true</fast><count>-2</count><red>blue</red>"),
              ElementsAre(6.5, -2, 1, 6.5));
}

TEST_F(PythonScripts, TellMistakesWithFileAndLine)
{
  const std::string step = "def step(robots):\n";
  struct Mistake
  {
    std::string script, parameters, text;
  };
  for (const Mistake& mistake : std::vector<Mistake>{
           {"x = = 1\n", "", "walk.py:2: invalid syntax"},
           {"x = 1\n", "", "walk.py: the script has no function step(robots)"},
           {step + "  nothing\n", "", "walk.py:3: NameError: name 'nothing' is not defined"},
           {step + "  robots.actuators['footbot_wheels'] = [[1, 2, 3]]\n", "",
            "the actuator 'footbot_wheels' takes an array of 2 robots and 2 columns"},
           {step + "  robots.actuators['footbot_wheels'][1] = 1, float('inf')\n", "",
            "column 1 of the actuator 'footbot_wheels' of the robot 'b' is not finite"},
           {step + "  robots.actuators['footbot_wheels'][0, 0] = 1\n", "",
            "column 1 of the actuator 'footbot_wheels' of the robot 'a' is not finite"},
           {step + "  robots.actuators['wheels']\n", "",
            "the robots have no actuator 'wheels'; they have: footbot_wheels"},
           {step + "  robots.sensors['wheels']\n", "",
            "walk.py:3: KeyError: the robots have no sensor 'wheels'; they have: footbot_proximity"},
           {step + "  robots.rows('footbot_proximity')\n", "", "the sensor 'footbot_proximity' has no rows"},
           {step + "  robots.log(2, 'x')\n", "", "there is no robot 2"},
           {"parameters(speed={'default': 5, 'maximum': 20})\n" + step + "  pass\n", "<speed>30</speed>",
            "it must be at most 20"},
           {"parameters(speed=5)\n" + step + "  pass\n", "<sped>3</sped>", "did you mean 'speed'?"},
           {"p = parameters(a=3 + len('x'))\n", "", "walk.py:2: the parameter 'a' must be declared by numbers"},
           {"p = parameters(3)\n", "", "walk.py:2: parameters(name=…) takes a declaration for each name"},
           {"p = parameters(a={'defalt': 3})\n", "", "the parameter 'a' has no field 'defalt'"}})
    EXPECT_THAT(FailureOf(Python(mistake.script, mistake.parameters)), HasSubstr(mistake.text)) << mistake.script;
}

TEST_F(PythonScripts, GoOnFromASavedState)
{
  const ScriptText text = WithState(
      "import numpy as np\n"
      "def init(robots):\n  robots.state.count = 0\n  robots.state.seen = np.zeros((len(robots), 3))\n  "
      "robots.state.on = "
      "False\n"
      "def step(robots):\n  s = robots.state\n  s.count = s.count + 1\n  s.seen[:, 1] += robots.uniform()\n  s.on = "
      "~s.on\n  robots.actuators['footbot_wheels'][:, 0] = s.count + s.on * 5\n  "
      "robots.actuators['footbot_wheels'][:, "
      "1] = s.seen.sum(axis=1)\n");
  Scripted whole(text), other(text);
  whole.StatusAfter(3);
  const std::vector<char> saved = whole.Saved();
  other.StatusAfter(5);
  other.Load(saved);
  EXPECT_EQ(other.Saved(), saved);
  for (std::uint64_t tick = 3; tick < 6; ++tick)
  {
    const std::vector<double> wheels = whole.Tick(tick).values;
    EXPECT_EQ(other.Tick(tick).values, wheels);
    EXPECT_EQ(wheels[0], static_cast<double>(tick + 1) + (tick % 2 == 0 ? 5 : 0));
  }
  std::vector<char> cut = saved;
  cut.resize(saved.size() - 1);
  EXPECT_THROW(other.Load(cut), std::runtime_error);
}

TEST_F(PythonScripts, TellWhatWouldNotBeSaved)
{
  const std::string step = "def step(robots):\n  pass\n";
  const auto failure = [](const ScriptText& text)
  {
    return test::MessageOf<std::runtime_error>(
        [&]
        {
          Scripted scripted(text);
          if (scripted.host == nullptr) throw std::runtime_error(scripted.Mistakes());
          scripted.StatusAfter(2);
          scripted.Saved();
        });
  };
  EXPECT_THAT(failure(WithState(step)), HasSubstr("its controller cannot be saved"));
  EXPECT_EQ(failure(Python(step)), "");
  EXPECT_THAT(failure(Python("k = [0]\ndef step(robots):\n  k[0] += 1\n")),
              HasSubstr("walk.py: the global variable 'k' has changed since the start of the script"));
  EXPECT_THAT(failure(WithState("def init(robots):\n  robots.state.f = print\n" + step)),
              HasSubstr("the state 'f' has the type object; it must have numbers or booleans"));
  EXPECT_THAT(failure(WithState("def init(robots):\n  robots.state.f = [1, 2]\n" + step)),
              HasSubstr("the state 'f' has 2 rows for 1 robots"));
  EXPECT_THAT(failure(WithState("def init(robots):\n  if robots.ids == ['b']:\n    robots.state.f = 1\n" + step)),
              HasSubstr("the robot 'b' has other names in its state than others"));
}

}  // namespace
}  // namespace swarmanoid
