// BehaviorWorld: a small world in which each robot runs one behaviour, tick by tick in one process.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <set>
#include <string>

#include "common/space/space.h"
#include "simulation/simulator.h"
#include "tests/world/experiment_text.h"
#include "tests/world/temporary_folder.h"

namespace swarmanoid::test
{

class BehaviorWorld
{
public:
  // `size`: the arena in m. In 2D, footbots and objects are on the ground, and eyebots on a plane at 1.5 m. In 3D all
  // are in one engine with a ceiling.
  explicit BehaviorWorld(const char* size = "10,10,3", bool three_dimensional = false)
      : three_dimensional_(three_dimensional)
  {
    text_.size = size;
  }

  // `behavior`: a name in probe_controllers.cpp. `heading`: in degrees.
  BehaviorWorld& Footbot(const std::string& id, const std::string& behavior, double x, double y, double heading = 0);
  BehaviorWorld& Eyebot(const std::string& id, const std::string& behavior, double x, double y, double z = 1.5);
  BehaviorWorld& Handbot(const std::string& id, const std::string& behavior, double x, double y);
  BehaviorWorld& Block(const std::string& id, const std::string& position, const std::string& size,
                       const std::string& more = "");
  BehaviorWorld& Prey(const std::string& id, double x, double y, const std::string& colour);
  BehaviorWorld& Light(const std::string& id, const std::string& position, double intensity = 1);
  BehaviorWorld& Patch(const std::string& id, double x, double y, const std::string& colour);
  BehaviorWorld& Functions(const std::string& tag, const std::string& library);
  // Adds walls along the edges of a square with this side; its corner is the origin.
  BehaviorWorld& Walls(double side);
  BehaviorWorld& Seed(int seed);

  // The first call of these functions starts the run.
  const CSwarmanoidSpace& Space();
  void Run(int ticks);
  // Runs, and calls `watch` at every tick.
  template <class Watch>
  void Run(int ticks, Watch watch)
  {
    for (int tick = 0; tick < ticks; ++tick)
    {
      Run(1);
      watch();
    }
  }
  Vector3 Place(const std::string& id) { return Space().FindEntity(id)->GetPosition(); }
  // Returns the distance on the ground, in m.
  double Distance(const std::string& a, const std::string& b) { return (Place(a) - Place(b)).head<2>().norm(); }
  // Ends the run. Returns the folder of its files, which is removed with the world.
  std::string End();
  double Attribute(const std::string& id, const std::string& name, int element = 0);

private:
  void Robot(const std::string& kind, const std::string& id, const std::string& behavior, const std::string& place);
  void Start();

  TemporaryFolder folder_;
  ExperimentText text_;
  bool three_dimensional_;
  int seed_ = 1;
  std::set<std::string> known_controllers_;
  std::string ground_;
  std::string sky_;
  std::unique_ptr<Experiment> experiment_;
  std::unique_ptr<CSimulator> simulator_;
};

}  // namespace swarmanoid::test
