// A worker builds its world from the space server's description, and checks all parts of it.
#include "common/bus/membership/worker_world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/bus/bus.h"
#include "simulation/register_all.h"

namespace swarmanoid
{
namespace
{

using testing::HasSubstr;
using testing::ThrowsMessage;

// Three robots of one controller, whose library no test loads.
WorldMessage World()
{
  RegisterBuiltins();
  WorldMessage world;
  world.file = "three.xml";
  world.folder = ".";
  world.xml = R"(<ahss-config>
  <framework><clocktick>100</clocktick><maxclock>10</maxclock></framework>
  <controllers><c id="c" library="c"><actuators/><sensors/><parameters/></c></controllers>
  <arena size="4,4,1" optimization="2D">
    <footbot id="fb_0"><position>1,1,0</position><orientation>0,0,0</orientation><controller>c</controller></footbot>
    <footbot id="fb_1"><position>2,1,0</position><orientation>0,0,0</orientation><controller>c</controller></footbot>
    <footbot id="fb_2"><position>3,1,0</position><orientation>0,0,0</orientation><controller>c</controller></footbot>
  </arena>
  <engines><dummy_engine id="ground"/></engines>
  <arena_physics><engine id="ground"><all/></engine></arena_physics>
  <visualisations/>
</ahss-config>)";
  LoadOptions options;
  options.check_files = false;
  const auto experiment = LoadWorld(world, options);
  world.entities = DescribeWorld(CSwarmanoidSpace(*experiment), 1, "three.xml", {}).entities;
  return world;
}

TEST(WorkerWorld, HasTheHostsThatTheSpaceServerSays)
{
  WorldMessage world = World();
  world.hosts = {2, {1, 0, 1}};
  const WorkerWorld replica(world, false);
  EXPECT_EQ(replica.assignment.table, world.hosts);
  EXPECT_EQ(HostNameOf(replica.assignment, 1), "controller host 0");
}

TEST(WorkerWorld, RefusesATableOfOtherRobots)
{
  WorldMessage world = World();
  for (const HostTable& table :
       {HostTable{2, {1, 0}}, HostTable{2, {1, 0, 2}}, HostTable{0, {0, 0, 0}}, HostTable{4'000'000'000U, {1, 0, 2}}})
  {
    world.hosts = table;
    EXPECT_THAT([&] { WorkerWorld(world, false); }, ThrowsMessage<BusError>(HasSubstr("a table of controller hosts")));
  }
}

// Its robots may differ, too, so the mistake is reported first.
TEST(WorkerWorld, RefusesAWorldOfOtherEntities)
{
  WorldMessage world = World();
  world.entities.pop_back();
  EXPECT_THAT([&] { WorkerWorld(world, false); }, ThrowsMessage<BusError>(HasSubstr("use programs of one build")));
}

}  // namespace
}  // namespace swarmanoid
