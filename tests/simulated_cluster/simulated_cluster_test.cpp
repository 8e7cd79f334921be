// Random schedules of faults in small clusters. The program repeats one seed, or runs many:
//
//   build/bin/tests/simulated_cluster --schedules 1000000         runs so many, from --first on (0)
//   build/bin/tests/simulated_cluster --seed 17                   says what happens in that schedule
//   build/bin/tests/simulated_cluster --seed 17 --messages Region  and which messages of these topics are sent
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fcntl.h>
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <cstring>
#include <filesystem>

#include "common/plugin_descriptions/describe_builtins.h"
#include "common/plugins/library.h"
#include "controller_host/device.h"
#include "engine_worker/engine_worker.h"
#include "tests/simulated_cluster/simulated_cluster.h"

namespace swarmanoid::test
{
namespace
{

std::uint64_t schedules = 500;
std::uint64_t first = 0;
std::optional<std::uint64_t> only;
std::string messages;

std::string Experiment(const std::string& name, const std::string& engines, const std::string& places)
{
  return R"(<?xml version="1.0"?>
<ahss-config>
  <framework><clocktick>100</clocktick><maxclock>25</maxclock><seed>3</seed><canonical_period>5</canonical_period></framework>
  <controllers>
    <footbot_diffusion id="diffusion" library="footbot_diffusion">
      <actuators><footbot_wheels><implementation>dummy_footbot_wheels</implementation></footbot_wheels></actuators>
      <sensors><footbot_proximity><implementation>generic_footbot_proximity</implementation></footbot_proximity></sensors>
      <parameters><velocity>0.2</velocity><alpha>7.5</alpha><delta>0.1</delta></parameters>
    </footbot_diffusion>
  </controllers>
  <arena size="4, 2, 1" optimization="2D">
    <distribute quantity="4">
      <position method="uniform" min="0.3, 0.3, 0" max="1.6, 1.7, 0"/>
      <orientation method="uniform"/>
      <footbot id="left"><controller>diffusion</controller></footbot>
    </distribute>
    <distribute quantity="2">
      <position method="uniform" min="2.4, 0.3, 0" max="3.7, 1.7, 0"/>
      <orientation method="uniform"/>
      <footbot id="right"><controller>diffusion</controller></footbot>
    </distribute>
  </arena>
  <engines>)" +
         engines + "</engines>\n  <arena_physics>" + places + "</arena_physics>\n</ahss-config>\n<!-- " + name +
         " -->\n";
}

const std::string kPlane = "<perpendicular_axis>z</perpendicular_axis><distance>0</distance>";

std::string Folder() { return fmt::format("/dev/shm/swarmanoid-simulated-{}", getpid()); }

const std::vector<Scene>& Scenes()
{
  static const std::vector<Scene> scenes = []
  {
    std::vector<Scene> all;
    all.push_back(MakeScene("two_engines",
                            Experiment("two engines",
                                       "<dummy_engine id=\"ground\">" + kPlane +
                                           "</dummy_engine><dynamics2d id=\"other\">" + kPlane + "</dynamics2d>",
                                       "<engine id=\"ground\"><entity id=\"left_*\"/></engine>"
                                       "<engine id=\"other\"><entity id=\"right_*\"/></engine>"),
                            2, Folder()));
    all.push_back(
        MakeScene("regions",
                  Experiment("two regions", "<dummy_engine id=\"ground\" split=\"2x1\">" + kPlane + "</dummy_engine>",
                             "<engine id=\"ground\"><all/></engine>"),
                  1, Folder()));
    return all;
  }();
  return scenes;
}

ScheduleResult RunSeed(std::uint64_t seed, const Trace& trace = {})
{
  return RunSchedule(Scenes()[seed % Scenes().size()], seed, Folder(), trace);
}

// Discards the output of the processes, since there are thousands of them.
class Silence
{
public:
  Silence() : kept_(dup(STDERR_FILENO))
  {
    const int nothing = open("/dev/null", O_WRONLY);
    dup2(nothing, STDERR_FILENO);
    close(nothing);
  }
  ~Silence()
  {
    dup2(kept_, STDERR_FILENO);
    close(kept_);
  }

private:
  int kept_;
};

TEST(SimulatedCluster, EndsWithTheHashesOfOneProcessWhateverHappens)
{
  if (only)
  {
    const ScheduleResult result = RunSeed(*only, {true, messages});
    EXPECT_EQ(result.trouble, "");
    return;
  }
  ScheduleResult sum;
  const auto start = std::chrono::steady_clock::now();
  int failures = 0;
  Scenes();
  for (std::uint64_t seed = first; seed < first + schedules && failures < 5; ++seed)
  {
    ScheduleResult result;
    {
      const Silence silence;
      result = RunSeed(seed);
    }
    sum.steps += result.steps;
    sum.virtual_s += result.virtual_s;
    sum.kills += result.kills;
    sum.stops += result.stops;
    sum.cuts += result.cuts;
    sum.replaced += result.replaced;
    sum.restarts += result.restarts;
    if (result.trouble.empty()) continue;
    ++failures;
    ADD_FAILURE() << fmt::format("--seed {}: {}", seed, result.trouble);
  }
  fmt::print(
      "{} schedules in {:.1f} s: {} steps, {:.0f} s of virtual time, {} kills, {} stops, {} cuts; {} processes "
      "replaced, {} runs started again\n",
      schedules, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), sum.steps,
      sum.virtual_s, sum.kills, sum.stops, sum.cuts, sum.replaced, sum.restarts);
}

// A failing seed is useful only if it repeats its run exactly.
TEST(SimulatedCluster, RepeatsEachStepOfASeed)
{
  const Silence silence;
  for (std::uint64_t seed = 0; seed < 10; ++seed)
  {
    const ScheduleResult one = RunSeed(seed);
    const ScheduleResult two = RunSeed(seed);
    EXPECT_EQ(one.steps, two.steps) << seed;
    EXPECT_EQ(one.virtual_s, two.virtual_s) << seed;
    EXPECT_EQ(one.trouble, two.trouble) << seed;
  }
}

const char* WordAfter(int count, char** arguments, const char* option)
{
  for (int k = 1; k + 1 < count; ++k)
    if (std::strcmp(arguments[k], option) == 0) return arguments[k + 1];
  return nullptr;
}

std::uint64_t Number(const char* word) { return std::strtoull(word, nullptr, 10); }

}  // namespace
}  // namespace swarmanoid::test

int main(int count, char** arguments)
{
  using namespace swarmanoid;
  testing::InitGoogleTest(&count, arguments);
  if (const char* word = test::WordAfter(count, arguments, "--schedules")) test::schedules = test::Number(word);
  if (const char* word = test::WordAfter(count, arguments, "--first")) test::first = test::Number(word);
  if (const char* word = test::WordAfter(count, arguments, "--seed")) test::only = test::Number(word);
  if (const char* word = test::WordAfter(count, arguments, "--messages")) test::messages = word;
  DescribeBuiltins();
  RegisterBuiltinEngines();
  RegisterBuiltinDevices();
  return RUN_ALL_TESTS();
}
