// The main function of a simulation, for programs of users that wrap it: the same run as that of `swarmanoid run`, with
// the same options, output and exit code, as a cluster or, with --single-process, in this process.
//
//   int main(int count, char** arguments) { return swarmanoid::RunSimulation(count, arguments, Watch); }
#pragma once

#include <functional>

#include "simulation/simulator.h"

namespace swarmanoid
{

// `watch`, if given, is called at each tick from the first one on, before the state of the tick is written, drawn or
// sent. It is always called in this process and this thread: with `watch`, this process is the space server of the
// cluster.
int RunSimulation(int count, char** arguments, const std::function<void(CSimulator&)>& watch = {});

}  // namespace swarmanoid
