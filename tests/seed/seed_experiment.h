// Small experiments for the listings: one footbot with a controller of the library of listings.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "simulation/simulator.h"

namespace swarmanoid::test
{

struct SeedExperiment
{
  std::string controller;
  double arena_m = 2;  // side of the square arena
  bool walled = true;  // whether walls close the arena
  std::string start = "1, 1, 0";
  int ticks = 300;
};

// Runs the experiment, and calls `watch` at every tick from 0 on. Returns the hash of the final state.
std::uint64_t RunSeedExperiment(const SeedExperiment& experiment,
                                const std::function<void(const CSwarmanoidSpace&)>& watch = {});

}  // namespace swarmanoid::test
