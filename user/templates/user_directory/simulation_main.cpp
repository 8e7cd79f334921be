// A simulator of your own: it runs an experiment like `swarmanoid run`, with the same options, and calls Watch at every
// tick, here in this process. Measure there what you want to know of a run.
//
//   ./build.sh && simulation_build/simulation experiments/sample_footbot.xml
//   simulation_build/simulation experiments/sample_footbot.xml --single-process    the same, and no other processes
#include <cstdio>

#include "simulation.h"

using namespace swarmanoid;

namespace
{

void Watch(CSimulator& simulator)
{
  const CSwarmanoidSpace& space = simulator.GetSpace();
  if (space.GetTick() % 100 != 0) return;
  for (const std::uint32_t i : space.Movable())
  {
    if (!space.IsPresent(i)) continue;
    const CSwarmanoidSpaceEntity& entity = space.GetEntity(i);
    const Vector3 place = entity.GetPosition();
    std::printf("%6.1f s  %-8s  %7.3f %7.3f %7.3f\n", space.GetTime(), entity.GetId().c_str(), place.x(), place.y(),
                place.z());
  }
}

}  // namespace

int main(int count, char** arguments) { return RunSimulation(count, arguments, Watch); }

// To run an experiment many times, as when parameters are searched for:
//
//   for (int seed = 1; seed <= 10; ++seed)
//   {
//     const auto experiment = ReadExperiment("experiments/mine.xml", {{"framework.seed", std::to_string(seed)}});
//     CSimulator simulator(*experiment, {.visualisations = false});
//     while (simulator.Step()) …
//     simulator.Finish();
//   }
