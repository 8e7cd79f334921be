// The main function of a simulation, for programs of users that wrap it: the same run as that of
// `swarmanoid run --single-process`, with the same options, output and exit code.
//
//   int main(int count, char** arguments) { return swarmanoid::RunSimulation(count, arguments); }
#pragma once

#include <functional>

#include "launcher/simulator.h"

namespace swarmanoid
{

// `watch`, where there is one, is called at tick 0 and after every tick.
int RunSimulation(int count, char** arguments, const std::function<void(CSimulator&)>& watch = {});

}  // namespace swarmanoid
