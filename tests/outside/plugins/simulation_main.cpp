// A user's own simulator. It looks at every tick and collects its observations in variables of main. With
// OUTSIDE_CHANGES it changes the experiment through the editor. It fails by OUTSIDE_FAULT.
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "controllers/outside_faults/faults.h"

#include "simulation.h"
#include "space_server/experiment_functions.h"

using namespace swarmanoid;

int main(int count, char** arguments)
{
  const bool changes = std::getenv("OUTSIDE_CHANGES") != nullptr;
  int seen = 0;
  double way = 0;
  bool same_thread = true;
  const auto own_thread = std::this_thread::get_id();
  const int code =
      RunSimulation(count, arguments,
                    [&](CSimulator& simulator)
                    {
                      const CSwarmanoidSpace& space = simulator.GetSpace();
                      ++seen;
                      same_thread = same_thread && std::this_thread::get_id() == own_thread;
                      const Vector3 place = space.FindEntity("robot_one")->GetPosition();
                      way += place.x();
                      std::printf("watch %d %.17g %.17g\n", static_cast<int>(space.GetTick()), place.x(), place.y());
                      faults::FailIfAsked("watch", space.GetTick());
                      if (!changes || space.GetTick() % 5 != 0) return;
                      const double x = 1 + 0.1 * static_cast<double>(space.GetTick());
                      simulator.GetEditor().MoveEntity("robot_one", {Vector3(x, 2, 0), Quaternion::Identity()});
                    });
  std::printf("watched %d ticks, %.17g m, %s\n", seen, way, same_thread ? "in one thread" : "in several threads");
  return code;
}
